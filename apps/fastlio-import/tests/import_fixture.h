// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file import_fixture.h Runs fastlio-import in a folder of its own. */
#pragma once

#include "bag_writers.h"
#include "bridge_recording.h"
#include "process.h"
#include "test_files.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace fastlio::testing
{
class ImportFixture : public ::testing::Test
{
 protected:
  ProcessResult import(std::vector<std::string> arguments)
  {
    arguments.insert(arguments.begin(), FASTLIO_IMPORT_PROGRAM);
    return Process(arguments, folder_.file("log.txt")).wait();
  }

  std::string file(const std::string& name, const std::string& bytes)
  {
    write(folder_.file(name), bytes);
    return folder_.file(name);
  }

  /** Clouds at 10 Hz with the time field that is asked for, and an IMU. */
  static std::vector<TopicMessage> messages(const TimeField& time = {}, Wire wire = Wire::Ros1)
  {
    return messagesOf(recording(30), wire, time);
  }

  std::string out(const std::string& name = "out.rawlog") { return folder_.file(name); }

  TemporaryFolder folder_;
};

}  // namespace fastlio::testing
