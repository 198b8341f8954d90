// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// When the offset of the clocks joins the state.

#include "odometry_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace fastlio::testing
{
namespace
{
/** Of the points only every \a kept-th one is on a wall; the others are leaves, anywhere. */
RoomRecording roomFullOfLeaves(std::size_t kept)
{
  RoomSettings settings;
  settings.duration = 9.0;
  RoomRecording recording = recordRoom(settings);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> anywhere(-6.0F, 6.0F);
  for (LidarScan& scan : recording.scans)
    for (std::size_t i = 0; i < scan.points.size(); ++i)
      if (i % kept != 0)
        for (auto* column : {&scan.points.x, &scan.points.y, &scan.points.z})
          (*column)[i] = anywhere(random);
  return recording;
}

// Where leaves surround the sensor, 30 % of the points never match. The clocks were taken for exact
// for good, and runs with clocks 4 ms apart ended degraded.
TEST(TimeOffsetRelease, DoesNotWaitForAMapThatNeverBecomesDense)
{
  const RoomRecording recording = roomFullOfLeaves(6);
  OdometryOptions parameters = roomParameters(recording.settings);
  parameters.calibration.estimate_time_offset = true;
  Odometry odometry(parameters);
  const Results results = runInOrder(odometry, recording);
  ASSERT_EQ(results.back().status, ScanStatus::Tracking);
  const bool dense = std::any_of(
      results.begin(), results.end(),
      [](const ScanResult& r)
      { return 10 * r.statistics.points_effective > 3 * r.statistics.points_downsampled; });
  ASSERT_FALSE(dense);
  EXPECT_GT(results.back().filter.P(kTimeOffset, kTimeOffset), 0.0);
}
}  // namespace
}  // namespace fastlio::testing
