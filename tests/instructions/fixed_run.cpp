// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// A short run of the odometry that is always the same, for counting its instructions.

#include "odometry_runs.h"

#include <cstdio>
#include <cstdlib>

int main()
{
  fastlio::testing::RoomSettings settings;
  settings.duration = 4.0;
  settings.columns = 900;  // 14400 points per scan
  fastlio::Parameters parameters = fastlio::testing::roomParameters(settings);
  parameters.downsampling.target_points = 1500;
  const auto results =
      fastlio::testing::runInOrder(parameters, fastlio::testing::recordRoom(settings));
  std::size_t tracked = 0;
  for (const auto& result : results)
    tracked += result.status == fastlio::ScanStatus::Tracking ? 1 : 0;
  std::printf("%zu scans tracked\n", tracked);
  return tracked >= 15 ? EXIT_SUCCESS : EXIT_FAILURE;
}
