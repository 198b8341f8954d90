// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// A short run of the odometry that is always the same, for counting its instructions.

#include "odometry_runs.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

// The counted part: simulating the recording is left out, and the odometry gets its scans, no
// copies. A plain name, which the script can give to valgrind.
extern "C" __attribute__((noinline)) void fastlioCountedRun(
    const fastlio::OdometryOptions& parameters, fastlio::testing::RoomRecording& recording,
    fastlio::testing::Results& results)
{
  fastlio::Odometry odometry(parameters);
  results = fastlio::testing::runInOrder(odometry, std::move(recording));
}

int main()
{
  fastlio::testing::RoomSettings settings;
  settings.duration = 4.0;
  settings.columns = 900;  // 14400 points per scan
  fastlio::OdometryOptions parameters = fastlio::testing::roomParameters(settings);
  // What scans cost: the comparison of the first ones with rest comes once per run.
  parameters.initialization.mode = fastlio::InitializationMode::Rest;
  parameters.downsampling.target_points = 1500;
  fastlio::testing::RoomRecording recording = fastlio::testing::recordRoom(settings);
  fastlio::testing::Results results;
  fastlioCountedRun(parameters, recording, results);
  std::size_t tracked = 0;
  for (const auto& result : results)
    tracked += result.status == fastlio::ScanStatus::Tracking ? 1 : 0;
  std::printf("%zu scans tracked\n", tracked);
  return tracked >= 15 ? EXIT_SUCCESS : EXIT_FAILURE;
}
