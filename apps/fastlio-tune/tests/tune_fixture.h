// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file tune_fixture.h A search whose runs are all finished: the store has their outcomes. */
#pragma once

#include "../trials.h"
#include "temporary_folder.h"
#include <fastlio/config/config_yaml.h>

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <string>

namespace fastlio::testing
{
class Tune : public ::testing::Test
{
 protected:
  Tune()
  {
    command_.runner.store = folder_.file("store.sqlite");
    command_.runner.jobs = 0;
    inputs_.id = "search";
    inputs_.measure = "ape";
    inputs_.recordings = {{"/a.rawlog", "/a.gt.tum"}, {"/b.rawlog", "/b.gt.tum"}};
    for (const char* key : {"lidar.min_range", "map.voxel_size"})
    {
      SearchKey searched;
      searched.key = key;
      searched.values = {"0.5", "1"};
      inputs_.space.push_back(searched);
    }
  }

  /** The outcome of every run that is open, by its parameters and recording. */
  void finishRuns(const std::function<RunOutcome(const Config&, const std::string&)>& outcome)
  {
    JobStore store(command_.runner.store, Durability::Process);
    const Worker worker{thisProcess(), 0};
    while (const auto job = store.claim(worker, {programVersion(), inputs_.id}, 60.0))
      store.finish(worker, *job, outcome(configOf(job->parameters), job->recording));
  }

  Config configOf(const std::string& parameters) const
  {
    if (parameters.empty()) return {};
    std::ofstream(folder_.file("parameters.yaml")) << parameters;
    return loadConfigFromFile(folder_.file("parameters.yaml"));
  }

  static RunOutcome outcomeOf(double error, double duration)
  {
    return {RunState::Complete, {{"ape", error}, {"duration", duration}}, "", 0.5};
  }

  TemporaryFolder folder_;
  TuneCommand command_;
  SearchInputs inputs_;
};

}  // namespace fastlio::testing
