// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// How often a start in motion is tried that is never found.

#include "initialization.h"
#include "odometry_runs.h"
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace fastlio::testing
{
namespace
{
/** Points that lie on no surface. */
LidarScan scattered(LidarScan scan, std::mt19937& random)
{
  std::normal_distribution<float> error(0.0F, 1.0F);  // [m]
  for (auto* column : {&scan.points.x, &scan.points.y, &scan.points.z})
    for (float& coordinate : *column)
      coordinate += error(random);
  return scan;
}

TEST(StartFinder, TriesLessOftenWhenStartsAreRefused)
{
  RoomSettings settings;
  settings.duration = 16.0;
  settings.rest = 0.0;
  const RoomRecording recording = recordRoom(settings);
  ImuBuffer imu;
  for (const ImuSample& sample : recording.imu)
    imu.add(sample);
  std::mt19937 random(1);
  ScanQueue scans;
  for (const LidarScan& scan : recording.scans)
    scans.push_back({scattered(scan, random), spanOf(scan)});

  OdometryOptions parameters = roomParameters(recording.settings);
  parameters.initialization.mode = InitializationMode::Motion;
  StartFinder finder(parameters);
  std::vector<double> attempts;  // [s]
  std::int64_t oldest_ns = imu.oldestStamp();
  for (; !scans.empty(); scans.pop_front())
  {
    const double time = toSeconds(scans.front().span.begin_ns - kRecordingStart);
    const StartDecision decision = finder.decide(scans, imu, true);
    ASSERT_FALSE(decision.state.has_value()) << time;
    ASSERT_TRUE(decision.drop_oldest) << time;
    // What a refused start leaves behind is forgotten.
    if (imu.oldestStamp() != oldest_ns) attempts.push_back(time);
    oldest_ns = imu.oldestStamp();
  }
  ASSERT_GT(attempts.size(), 12U);
  for (std::size_t i = 1; i < attempts.size(); ++i)
  {
    const double step = attempts[i] - attempts[i - 1];
    if (attempts[i] < 4.0)
    {
      EXPECT_LT(step, 0.75) << attempts[i];
    }
    if (attempts[i - 1] > 6.0)
    {
      EXPECT_GT(step, 0.95) << attempts[i];
    }
  }
}
}  // namespace
}  // namespace fastlio::testing
