// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What may come in: any interleaving of the sensors, gaps, repeats, nonsense.

#include "odometry_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

const RoomRecording& roomForInput()
{
  static const RoomRecording recording = recordRoom(4.0);
  return recording;
}

/** Feeds both sensors in their own order, but interleaved at random, with drains in between. */
Results runInterleaved(unsigned seed, double share_of_imu)
{
  std::mt19937 rng(seed);
  std::bernoulli_distribution imu_next(share_of_imu), drain_now(0.3);
  Odometry odometry(roomParameters());
  Results results;
  std::size_t i = 0, k = 0;
  while (i < roomForInput().imu.size() || k < roomForInput().scans.size())
  {
    const bool imu_left = i < roomForInput().imu.size(),
               scan_left = k < roomForInput().scans.size();
    if (imu_left && (!scan_left || imu_next(rng)))
      odometry.addImu(roomForInput().imu[i++]);
    else
      odometry.addScan(roomForInput().scans[k++]);
    if (drain_now(rng)) drain(odometry, results);
  }
  finish(odometry, results);
  return results;
}

bool allFinite(const Results& results)
{
  return std::all_of(
      results.begin(), results.end(),
      [](const ScanResult& r) { return isFinite(r.filter.x) && r.filter.P.allFinite(); });
}
}  // namespace

TEST(OdometryInput, AnyInterleavingGivesTheSameBits)
{
  const Results in_order = runInOrder(roomParameters(), roomForInput());
  EXPECT_EQ(in_order.size(), roomForInput().scans.size());
  // From "all scans first" over mixtures to "all inertial samples first".
  for (const double fraction : {0.0, 0.3, 0.9, 0.95, 0.99, 1.0})
    EXPECT_TRUE(sameBits(runInterleaved(unsigned(100 * fraction), fraction), in_order)) << fraction;
}

TEST(OdometryInput, AScanWaitsForItsInertialData)
{
  Odometry odometry(roomParameters());
  EXPECT_FALSE(odometry.next());
  EXPECT_FALSE(odometry.flush());
  odometry.addScan(roomForInput().scans[0]);
  EXPECT_FALSE(odometry.next());
  Results results;
  const std::int64_t last_end = spanOf(roomForInput().scans[30]).end_ns;
  for (const ImuSample& s : roomForInput().imu)
    if (s.stamp_ns < last_end) odometry.addImu(s);
  for (std::size_t i = 1; i <= 30; ++i)
    odometry.addScan(roomForInput().scans[i]);
  drain(odometry, results);
  EXPECT_EQ(results.size(), 30U) << "the last scan's end is not covered";
  finish(odometry, results);
  ASSERT_EQ(results.size(), 31U);
  EXPECT_EQ(results.back().stamp_ns, last_end);
  EXPECT_FALSE(odometry.flush());
}

TEST(OdometryInput, FlushLeavesScansFarBeyondTheInertialData)
{
  const RoomRecording& r = roomForInput();
  Odometry odometry(roomParameters());
  Results results;
  for (const ImuSample& s : r.imu)
    if (s.stamp_ns < kRecordingStart + 2'500'000'000) odometry.addImu(s);
  for (const LidarScan& scan : r.scans)
    odometry.addScan(scan);
  drain(odometry, results);
  finish(odometry, results);
  // imu.max_gap is 0.5 s.
  EXPECT_EQ(results.size() + odometry.inputStatistics().scans_without_imu, r.scans.size());
  EXPECT_NEAR(double(results.size()), 30.0, 1.0);
}

TEST(OdometryInput, BadInertialSamplesAreCountedAndChangeNothing)
{
  Odometry odometry(roomParameters());
  Results results;
  for (std::size_t i = 0; i < roomForInput().imu.size(); ++i)
  {
    const ImuSample& s = roomForInput().imu[i];
    odometry.addImu(s);
    if (i % 10 == 0) odometry.addImu({s.stamp_ns, Vec3(9, 9, 9), Vec3(9, 9, 9)});
    if (i % 20 == 0) odometry.addImu({s.stamp_ns - 2'000'000, Vec3(9, 9, 9), Vec3(9, 9, 9)});
    if (i % 40 == 0) odometry.addImu({s.stamp_ns + 1'000'000, Vec3(kNaN, 0, 0), s.accel});
    if (i % 80 == 0) odometry.addImu({s.stamp_ns + 1'000'000, s.gyro, Vec3(0, -kInf, 0)});
  }
  for (const LidarScan& scan : roomForInput().scans)
    odometry.addScan(scan);
  drain(odometry, results);
  finish(odometry, results);
  EXPECT_TRUE(sameBits(results, runInOrder(roomParameters(), roomForInput())));
  const InputStatistics& counts = odometry.inputStatistics();
  const std::size_t n = roomForInput().imu.size();
  const auto each = [n](std::size_t step) { return (n + step - 1) / step; };
  EXPECT_EQ(counts.imu_duplicate, each(10));
  EXPECT_EQ(counts.imu_out_of_order, each(20));
  EXPECT_EQ(counts.imu_not_finite, each(40) + each(80));
  EXPECT_EQ(counts.imu_in, n + each(10) + each(20) + each(40) + each(80));
}

// The estimate of the clocks' offset moves the stamps of scans: a repeated one seemed to be newer.
TEST(OdometryInput, ARepeatedScanIsNoNewOne)
{
  OdometryOptions parameters = roomParameters();
  parameters.calibration.estimate_time_offset = true;
  parameters.lidar.time_offset = -0.003;
  const Results once = runInOrder(parameters, roomForInput());
  for (const bool at_once : {true, false})
  {
    Odometry odometry(parameters);
    Results results;
    for (const ImuSample& s : roomForInput().imu)
      odometry.addImu(s);
    for (const LidarScan& scan : roomForInput().scans)
      for (int i = 0; i < 2; ++i)
      {
        odometry.addScan(scan);
        if (at_once) drain(odometry, results);
      }
    drain(odometry, results);
    finish(odometry, results);
    EXPECT_TRUE(sameBits(results, once)) << at_once;
    EXPECT_EQ(odometry.inputStatistics().scans_out_of_order, roomForInput().scans.size());
  }
}

TEST(OdometryInput, EmptyAndRepeatedScansAreCounted)
{
  Odometry odometry(roomParameters());
  Results results;
  for (const ImuSample& s : roomForInput().imu)
    odometry.addImu(s);
  for (std::size_t i = 0; i < roomForInput().scans.size(); ++i)
  {
    odometry.addScan(roomForInput().scans[i]);
    if (i == 20) odometry.addScan(LidarScan{});
    if (i == 25) odometry.addScan(roomForInput().scans[25]);
    if (i == 30) odometry.addScan(roomForInput().scans[10]);
  }
  drain(odometry, results);
  finish(odometry, results);
  EXPECT_EQ(odometry.inputStatistics().scans_empty, 1U);
  EXPECT_EQ(odometry.inputStatistics().scans_out_of_order, 2U);
  EXPECT_TRUE(sameBits(results, runInOrder(roomParameters(), roomForInput())));
}

TEST(OdometryInput, PointsThatAreNoNumbersNeverReachTheState)
{
  RoomRecording spoilt = roomForInput();
  std::mt19937 rng(4);
  std::size_t spoilt_in_last = 0;
  for (LidarScan& scan : spoilt.scans)
  {
    spoilt_in_last = 0;
    for (std::size_t i = 0; i < scan.points.size(); ++i)
    {
      if (rng() % 5 != 0) continue;
      const float values[] = {float(kNaN), float(kInf), -float(kInf), 0.0F};
      const float value = values[rng() % 4];
      scan.points.x[i] = value;
      if (value == 0.0F) scan.points.y[i] = scan.points.z[i] = 0.0F;
      ++spoilt_in_last;
    }
  }
  const Results results = runInOrder(roomParameters(), spoilt);
  ASSERT_EQ(results.size(), spoilt.scans.size());
  EXPECT_TRUE(allFinite(results));
  EXPECT_EQ(results.back().statistics.dropped_invalid, spoilt_in_last);
  EXPECT_LT(worstPoseErrors(results, spoilt).position, 0.008);
}

TEST(OdometryInput, ScansOfNonsenseOnlyLeaveThePrediction)
{
  RoomRecording recording = roomForInput();
  for (std::size_t i = 22; i < 25; ++i)
    for (float& x : recording.scans[i].points.x)
      x = float(kNaN);
  const Results results = runInOrder(roomParameters(), recording);
  ASSERT_EQ(results.size(), recording.scans.size());
  for (std::size_t i = 22; i < 25; ++i)
  {
    EXPECT_EQ(results[i].status, ScanStatus::PredictionOnly);
    const std::string& message = results[i].message;
    EXPECT_NE(message.find("points are left, at least"), std::string::npos) << message;
    EXPECT_NE(message.find("without an echo"), std::string::npos) << message;
    EXPECT_EQ(results[i].statistics.points_effective, 0U);
  }
  EXPECT_EQ(results[25].status, ScanStatus::Tracking);
  EXPECT_TRUE(allFinite(results));
  EXPECT_LT(worstPoseErrors(results, recording).position, 0.008);
}

TEST(OdometryInput, AbsurdInertialValuesNeverMakeTheStateInfinite)
{
  RoomRecording recording = roomForInput();
  for (std::size_t i = 700; i < 720; ++i)
    recording.imu[i].accel.setConstant(1e300);
  const Results results = runInOrder(roomParameters(), recording);
  EXPECT_EQ(results.size(), recording.scans.size());
  EXPECT_TRUE(allFinite(results));
}

TEST(OdometryInput, ALongGapOfTheImuIsReportedAndSurvived)
{
  // 0.6 s at rest without samples; imu.max_gap is 0.5 s.
  RoomSettings settings;
  settings.rest = 3.5;
  settings.duration = 5.0;
  RoomRecording recording = recordRoom(settings);
  recording.imu.erase(recording.imu.begin() + 500, recording.imu.begin() + 620);
  Odometry odometry(roomParameters());
  const Results results = runInOrder(odometry, recording);
  EXPECT_EQ(accountedScans(odometry, results), recording.scans.size());
  const auto reports = std::count_if(
      results.begin(), results.end(),
      [](const ScanResult& r) { return r.message.find("imu.max_gap") != std::string::npos; });
  EXPECT_GE(reports, 1);
  EXPECT_LE(reports, 8);
  EXPECT_EQ(results.back().status, ScanStatus::Tracking);
  EXPECT_LT(worstPoseErrors(results, recording).position, 0.008);
}

TEST(OdometryInput, RefusesUnusableParametersByName)
{
  const auto refusal = [](auto change) -> std::string
  {
    OdometryOptions p = roomParameters();
    change(p);
    try
    {
      const Odometry odometry(p);
    }
    catch (const std::invalid_argument& e)
    {
      return e.what();
    }
    return {};
  };
  EXPECT_NE(
      refusal([](auto& p) { p.map.voxel_size = -0.1; }).find("voxel_size"), std::string::npos);
  EXPECT_NE(
      refusal([](auto& p) { p.update.max_iterations = 0; }).find("update.max_iterations"),
      std::string::npos);
  EXPECT_NE(
      refusal([](auto& p) { p.measurement.range_noise = kNaN; }).find("measurement.range_noise"),
      std::string::npos);
  EXPECT_NE(
      refusal([](auto& p) { p.lidar.min_range = 2.0 * p.lidar.max_range; }).find("lidar.m"),
      std::string::npos);
  EXPECT_EQ(refusal([](auto&) {}), "");
}
