// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file bridge_recording.h A recording in memory and on disk for tests of the bridge. */
#pragma once

#include "test_files.h"
#include <fastlio/survey/sensor_selection.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <string>
#include <vector>

namespace fastlio::testing
{
/** Two points with the given times [s], 1 m above the vehicle's origin. */
mrpt::obs::CObservationPointCloud::Ptr cloudAt(
    double seconds, const std::string& label = "lidar",
    const std::vector<float>& times = {0.0F, 0.1F});

/** Clouds at 10 Hz, inertial samples at 200 Hz. */
std::vector<Object> recording(int scans);

inline bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/** Has a folder for recordings. */
class BridgeTest : public ::testing::Test
{
 protected:
  std::string fileOf(const std::vector<Object>& objects);

  fastlio::SensorSelection select(
      const std::vector<Object>& objects, const fastlio::SensorPatterns& patterns = {});

  TemporaryFolder folder_;
};

}  // namespace fastlio::testing
