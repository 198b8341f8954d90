// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rawlog_reading.h Common parts of the tests of the rawlog source. */
#pragma once

#include "test_files.h"
#include <fastlio/rawlog/rawlog_source.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace fastlio::testing
{
/** All that a source delivers. */
struct Reading
{
  std::vector<double> seconds;  //!< stamps since kStart
  std::vector<std::string> labels;
  std::vector<fastlio::ReadProblem> problems;
};

Reading readAll(
    const std::vector<std::string>& files, const fastlio::RawlogSourceOptions& options = {});

/** Inertial samples at 200 Hz. */
std::vector<Object> samples(int count);

/** Has a folder for rawlogs. */
class RawlogTest : public ::testing::Test
{
 protected:
  /** The name of a file with these bytes. */
  std::string fileOf(const std::string& bytes)
  {
    std::string name = folder_.file("log.rawlog");
    write(name, bytes);
    return name;
  }

  TemporaryFolder folder_;
};

}  // namespace fastlio::testing
