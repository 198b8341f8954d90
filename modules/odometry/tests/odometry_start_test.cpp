// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// How the odometry starts: late inertial data, no rest, rest after motion.

#include "odometry_runs.h"

#include <gtest/gtest.h>

using namespace fastlio;
using namespace fastlio::test;

namespace
{
const RoomRecording& room()
{
  static const RoomRecording recording = []
  {
    RoomSettings settings;
    settings.duration = 4.0;
    return recordRoom(settings);
  }();
  return recording;
}

RoomRecording movingFromTheStart(double imu_rate)
{
  RoomSettings settings;
  settings.rest = 0.0;
  settings.duration = 8.0;
  settings.imu_rate = imu_rate;
  settings.columns = 36;
  return recordRoom(settings);
}
}  // namespace

TEST(OdometryStart, ScansBeforeTheInertialDataAreAccountedFor)
{
  RoomRecording late = room();
  late.imu.erase(late.imu.begin(), late.imu.begin() + 20);  // from 0.1 s on
  late.scans.erase(late.scans.begin() + 38, late.scans.end());
  Odometry odometry(roomParameters());
  Results results;
  for (std::size_t i = 0; i < 10; ++i)
  {
    odometry.addScan(late.scans[i]);
    drain(odometry, results);
  }
  EXPECT_TRUE(results.empty());
  late.scans.erase(late.scans.begin(), late.scans.begin() + 10);
  const Results rest = runInOrder(odometry, late);
  EXPECT_EQ(accountedScans(odometry, rest), 38U);
  EXPECT_EQ(rest.back().status, ScanStatus::Tracking);
  EXPECT_LT(worstPoseErrors(rest, late).position, 0.008);
}

TEST(OdometryStart, WithoutAnyInertialDataNothingComesOut)
{
  Odometry odometry(roomParameters());
  Results results;
  for (const LidarScan& scan : room().scans)
    odometry.addScan(scan);
  drain(odometry, results);
  finish(odometry, results);
  EXPECT_TRUE(results.empty());
}

TEST(OdometryStart, APlatformThatNeverRestsSaysSo)
{
  Parameters p = roomParameters();
  p.initialization.max_gyro_mean = 0.02;
  p.initialization.max_gyro_std = 0.02;
  const RoomRecording recording = movingFromTheStart(200.0);
  Odometry odometry(p);
  const Results results = runInOrder(odometry, recording);
  EXPECT_EQ(accountedScans(odometry, results), recording.scans.size());
  ASSERT_FALSE(results.empty());
  for (const ScanResult& r : results)
  {
    EXPECT_EQ(r.status, ScanStatus::Initializing);
    EXPECT_FALSE(r.message.empty());
  }
  EXPECT_NE(results.front().message.find("does not rest"), std::string::npos)
      << results.front().message;
}

TEST(OdometryStart, ASlowImuThatNeverRestsEndsTheSearchForRestToo)
{
  // Samples farther apart than the search's steps.
  Parameters p = roomParameters();
  p.initialization.max_gyro_mean = 0.02;
  p.initialization.max_gyro_std = 0.02;
  const RoomRecording recording = movingFromTheStart(2.0);
  Odometry odometry(p);
  const Results results = runInOrder(odometry, recording);
  EXPECT_EQ(accountedScans(odometry, results), recording.scans.size());
  EXPECT_EQ(countOf(results, ScanStatus::Initializing), results.size());
}

TEST(OdometryStart, StartsAtTheFirstRestAfterMotion)
{
  // Shaken for the first second, then at rest until 4.1 s.
  RoomSettings settings;
  settings.rest = 4.1;
  settings.duration = 6.0;
  RoomRecording recording = recordRoom(settings);
  for (std::size_t i = 0; i < 200; ++i)
    recording.imu[i].gyro.x() += i % 2 == 0 ? 1.0 : -1.0;
  Odometry odometry(roomParameters());
  const Results results = runInOrder(odometry, recording);
  EXPECT_EQ(accountedScans(odometry, results), recording.scans.size());
  EXPECT_GT(countOf(results, ScanStatus::Tracking), 35U);
  EXPECT_EQ(results.back().status, ScanStatus::Tracking);
  EXPECT_LT(worstPoseErrors(results, recording).position, 0.008);
}
