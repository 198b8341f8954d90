// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Once storage has grown to what the scans need, a scan allocates nothing: this program counts.

#include "allocation_counter.h"
#include "odometry_runs.h"

#include <gtest/gtest.h>

namespace fastlio::testing
{
namespace
{
/** Allocations while each scan is processed; feeding it is not counted. */
std::vector<std::size_t> allocationsPerScan(Odometry& odometry, const RoomRecording& recording)
{
  std::vector<std::size_t> allocations;
  std::size_t next_sample = 0;
  for (const LidarScan& scan : recording.scans)
  {
    const std::int64_t end_ns = spanOf(scan).end_ns;
    for (; next_sample < recording.imu.size() &&
           recording.imu[next_sample].stamp_ns <= end_ns + 5'000'000;
         ++next_sample)
      odometry.addImu(recording.imu[next_sample]);
    odometry.addScan(scan);
    const std::size_t before = allocationCount();
    const auto result = odometry.next();
    if (result && result->status == ScanStatus::Tracking)
      allocations.push_back(allocationCount() - before);
  }
  return allocations;
}

class OdometryAllocations : public ::testing::TestWithParam<int>
{
};

INSTANTIATE_TEST_SUITE_P(Threads, OdometryAllocations, ::testing::Values(1, 2));

TEST_P(OdometryAllocations, AScanInAKnownPlaceAllocatesNothing)
{
  RoomSettings settings;
  settings.duration = 12.0;
  const RoomRecording recording = recordRoom(settings);
  OdometryOptions parameters = roomParameters(settings);
  parameters.threads = GetParam();
  Odometry odometry(parameters);
  const std::vector<std::size_t> allocations = allocationsPerScan(odometry, recording);
  ASSERT_GT(allocations.size(), 80U);
  EXPECT_GT(allocations.front(), 0U) << "the counter does not count";
  std::size_t idle = 0;
  for (std::size_t i = allocations.size() - 30; i < allocations.size(); ++i)
  {
    EXPECT_LE(allocations[i], 2U) << "scan " << i;
    idle += allocations[i] == 0 ? 1 : 0;
  }
  // A voxel that is seen for the first time now and then makes a pool or a table grow.
  EXPECT_GE(idle, 20U);
}
}  // namespace
}  // namespace fastlio::testing
