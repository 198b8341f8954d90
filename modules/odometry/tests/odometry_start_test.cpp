// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// How the odometry starts: late inertial data, no rest, rest after motion.

#include "odometry_runs.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
const RoomRecording& roomForStart()
{
  static const RoomRecording recording = recordRoom(4.0);
  return recording;
}

OdometryOptions startingAtRest()
{
  OdometryOptions parameters = roomParameters();
  parameters.initialization.mode = InitializationMode::Rest;
  return parameters;
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
  RoomRecording late = roomForStart();
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

TEST(OdometryStart, WithoutAnyInertialDataTheEndSaysSo)
{
  Odometry odometry(roomParameters());
  Results results;
  for (const LidarScan& scan : roomForStart().scans)
    odometry.addScan(scan);
  drain(odometry, results);
  EXPECT_TRUE(results.empty());
  finish(odometry, results);
  ASSERT_EQ(results.size(), roomForStart().scans.size());
  for (const ScanResult& result : results)
  {
    EXPECT_EQ(result.status, ScanStatus::Initializing);
    EXPECT_NE(result.message.find("no usable inertial sample"), std::string::npos)
        << result.message;
  }
}

TEST(OdometryStart, ScansDoNotPileUpWithoutInertialData)
{
  OdometryOptions p = roomParameters();
  p.lidar.max_waiting = 1.0;
  Odometry odometry(p);
  Results results;
  for (const LidarScan& scan : roomForStart().scans)
  {
    odometry.addScan(scan);
    drain(odometry, results);
  }
  EXPECT_EQ(results.size(), roomForStart().scans.size() - 11);
  EXPECT_EQ(results.front().begin_ns, spanOf(roomForStart().scans.front()).begin_ns);
}

TEST(OdometryStart, AnImuThatFailsOnTheWayIsReported)
{
  OdometryOptions p = roomParameters();
  p.lidar.max_waiting = 0.5;
  p.imu_rate = true;
  Odometry odometry(p);
  for (const ImuSample& sample : roomForStart().imu)
    if (sample.stamp_ns < kRecordingStart + 2'500'000'000) odometry.addImu(sample);
  Results results;
  std::size_t states = 0;
  for (const LidarScan& scan : roomForStart().scans)
  {
    odometry.addScan(scan);
    while (auto result = odometry.next())
    {
      results.push_back(std::move(*result));
      states += odometry.imuRateStates().size();
    }
  }
  EXPECT_EQ(results.back().status, ScanStatus::Diverged);
  EXPECT_NE(results.back().message.find("have ended"), std::string::npos) << results.back().message;
  EXPECT_EQ(results.size(), roomForStart().scans.size() - 6);
  EXPECT_LE(states, roomForStart().imu.size());
}

TEST(OdometryStart, APlatformThatNeverRestsSaysSo)
{
  OdometryOptions p = startingAtRest();
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
  OdometryOptions p = startingAtRest();
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

TEST(OdometryStart, APlatformThatMovesOffBeforeTheFirstScanHasItsVelocity)
{
  // At rest until 2.1 s; the first scan comes when it moves already.
  RoomRecording recording = recordRoom();
  recording.scans.erase(recording.scans.begin(), recording.scans.begin() + 24);
  Odometry odometry(roomParameters());
  const Results results = runInOrder(odometry, recording);
  EXPECT_EQ(countOf(results, ScanStatus::Initializing), 0U);
  EXPECT_LT(worstPoseErrors(results, recording).position, 0.008);
}

/** Every scan of a start in motion names the way out, also while the next window is collected. */
TEST(OdometryStart, AStartInMotionNamesTheModeThatTakesIt)
{
  const RoomRecording moving = movingFromTheStart(200.0);
  Odometry odometry(startingAtRest());
  const Results results = runInOrder(odometry, moving);
  ASSERT_EQ(countOf(results, ScanStatus::Initializing), results.size());
  for (const ScanResult& r : results)
  {
    EXPECT_NE(r.message.find("does not rest"), std::string::npos) << r.message;
    EXPECT_NE(r.message.find("initialization.mode: auto"), std::string::npos) << r.message;
    EXPECT_EQ(r.message.find("collecting"), std::string::npos) << r.message;
  }
}

// In feet, or without gravity: a start in motion would follow it for hundreds of metres.
TEST(OdometryStart, AForceThatIsNotGravityIsNoStart)
{
  for (const double factor : {3.28, 0.02})
  {
    RoomRecording wrong = roomForStart();
    for (ImuSample& sample : wrong.imu)
      sample.accel *= factor;
    OdometryOptions parameters = roomParameters();
    parameters.imu.accel_unit = AccelUnit::Si;
    Odometry odometry(parameters);
    const Results results = runInOrder(odometry, wrong);
    EXPECT_EQ(countOf(results, ScanStatus::Initializing), results.size()) << factor;
    ASSERT_FALSE(results.empty());
    // The last one, too: it is what a run that never began reports.
    for (const ScanResult* result : {&results.front(), &results.back()})
      EXPECT_NE(
          result->message.find("no start in motion: the mean specific force"), std::string::npos)
          << result->message;
  }
}

TEST(OdometryStart, ClocksThatAreAnHourApartAreNamed)
{
  RoomRecording apart = roomForStart();
  for (LidarScan& scan : apart.scans)
    scan.stamp_ns += 3'600'000'000'000;
  Odometry odometry(roomParameters());
  const Results results = runInOrder(odometry, apart);
  ASSERT_FALSE(results.empty());
  for (const ScanResult& r : results)
  {
    EXPECT_EQ(r.status, ScanStatus::Initializing);
    EXPECT_EQ(r.message.find(": -"), std::string::npos) << r.message;
    EXPECT_NE(r.message.find("clocks of LiDAR and IMU"), std::string::npos) << r.message;
  }
}

// Such a scan begins and ends at its stamp, which is where the run starts.
TEST(OdometryStart, TheFirstScanWithoutPointTimesIsNotLate)
{
  for (const InitializationMode mode : {InitializationMode::Rest, InitializationMode::Motion})
  {
    RoomRecording recording = roomForStart();
    for (LidarScan& scan : recording.scans)
    {
      scan.stamp_ns = spanOf(scan).end_ns;
      std::fill(scan.points.time_offset_ns.begin(), scan.points.time_offset_ns.end(), 0);
    }
    recording.scans.erase(recording.scans.begin() + 18, recording.scans.end());  // at rest
    OdometryOptions parameters = roomParameters();
    parameters.initialization.mode = mode;
    Odometry odometry(parameters);
    const Results results = runInOrder(odometry, recording);
    EXPECT_EQ(odometry.inputStatistics().scans_out_of_order, 0U);
    ASSERT_EQ(results.size(), recording.scans.size());
    EXPECT_EQ(results.front().status, ScanStatus::FirstScan) << results.front().message;
    EXPECT_EQ(results.back().status, ScanStatus::Tracking) << results.back().message;
  }
}
