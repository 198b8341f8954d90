// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Sensors that fail for a while, and sensors that speak another language.

#include "odometry_runs.h"
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
const RoomRecording& roomForRecovery()
{
  static const RoomRecording recording = recordRoom(9.0);
  return recording;
}

std::string textOf(const std::vector<Diagnostic>& diagnostics)
{
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics)
    text += diagnostic.text + "\n";
  return text;
}

/** The worst errors from a time on, in the world that the first pose has fixed. */
WorstPoseErrors worstFrom(const Results& results, const RoomRecording& recording, double t)
{
  WorstPoseErrors worst;
  Pose T_world_truth;
  bool first = true;
  for (const ScanResult& r : results)
  {
    if (r.status == ScanStatus::Initializing || r.status == ScanStatus::Diverged) continue;
    const Pose truth = recording.truthAt(r.stamp_ns);
    if (first) T_world_truth = r.filter.x.pose() * truth.inverse();
    first = false;
    if (static_cast<double>(r.stamp_ns - kRecordingStart) < t * 1e9) continue;
    const Pose expected = T_world_truth * truth;
    worst.position = std::max(worst.position, (r.filter.x.p - expected.p).norm());
    worst.attitude = std::max(worst.attitude, logSO3(expected.R.transpose() * r.filter.x.R).norm());
  }
  return worst;
}

/** Of the filter itself: what is reported is as much larger as the innovations of the whole run. */
double ownTimeOffsetVariance(const ScanResult& result)
{
  return result.filter.P(kTimeOffset, kTimeOffset) / result.statistics.calibration.innovation_scale;
}
}  // namespace

TEST(OdometryRecovery, AShortGapInMotionIsBridged)
{
  RoomRecording recording = roomForRecovery();
  recording.imu.erase(recording.imu.begin() + 1000, recording.imu.begin() + 1060);  // 0.3 s
  Odometry odometry(roomParameters());
  const Results results = runInOrder(odometry, recording);
  EXPECT_EQ(results.size(), recording.scans.size());
  EXPECT_EQ(odometry.imuReport().gaps, 1U);
  EXPECT_EQ(countOf(results, ScanStatus::Diverged), 0U);
  EXPECT_LT(worstFrom(results, recording, 6.0).position, 0.02);
}

TEST(OdometryRecovery, ALongGapInMotionSplitsTheRunAndTheMapIsFoundAgain)
{
  RoomRecording recording = roomForRecovery();
  recording.imu.erase(recording.imu.begin() + 900, recording.imu.begin() + 1140);  // 1.2 s
  for (std::size_t i = 45; i < 57; ++i)
    recording.scans[i].points.resize(10);  // too few to follow
  OdometryOptions parameters = roomParameters();
  parameters.calibration.estimate_time_offset = true;
  Odometry odometry(parameters);
  const Results results = runInOrder(odometry, recording);
  EXPECT_EQ(accountedScans(odometry, results), recording.scans.size());
  const std::string diagnostics = textOf(odometry.diagnostics());
  EXPECT_NE(diagnostics.find("the run is re-initialised"), std::string::npos) << diagnostics;
  EXPECT_NE(diagnostics.find("re-initialised with"), std::string::npos) << diagnostics;
  EXPECT_EQ(results.back().status, ScanStatus::Tracking);
  EXPECT_EQ(countOf(results, ScanStatus::FirstScan), 1U) << "the old map is found again";
  // What was found of the clocks outlasts the gap.
  const auto lost = std::find_if(
      results.begin(), results.end(),
      [](const ScanResult& r) { return r.status == ScanStatus::Diverged; });
  ASSERT_NE(lost, results.begin());
  const ScanResult &before = *(lost - 1), &end = results.back();
  EXPECT_NE(before.filter.x.time_offset, 0.0);
  // Clocks may drift meanwhile.
  const double drift = std::pow(parameters.calibration.time_offset_walk, 2) *
                       toSeconds(end.stamp_ns - before.stamp_ns);
  EXPECT_LE(ownTimeOffsetVariance(end), ownTimeOffsetVariance(before) + drift);
  EXPECT_NEAR(end.filter.x.time_offset, before.filter.x.time_offset, 0.001);
  const WorstPoseErrors worst = worstFrom(results, recording, 7.5);
  EXPECT_LT(worst.position, 0.03);
  EXPECT_LT(worst.attitude, 0.01);
}

// Matches that were refused are those of a wrong pose. The offsets of beams that they taught were
// as large as such offsets can be, and no scan matched well ever after.
TEST(OdometryRecovery, ScansThatFindNoPoseTeachNothingOfTheBeams)
{
  RoomRecording recording = roomForRecovery();
  recording.imu.erase(recording.imu.begin() + 900, recording.imu.begin() + 1140);  // 1.2 s
  const Results results = runInOrder(roomParameters(), recording);
  ASSERT_EQ(results.back().status, ScanStatus::Tracking);
  const CalibrationCheck usual =
      runInOrder(roomParameters(), roomForRecovery()).back().statistics.calibration;
  const CalibrationCheck& check = results.back().statistics.calibration;
  EXPECT_LT(check.range_offset, 1.5 * usual.range_offset);
  EXPECT_LT(check.elevation_offset, 1.5 * usual.elevation_offset);
  EXPECT_LT(check.azimuth_offset, 1.5 * usual.azimuth_offset);
}

/** What a search said of the best place; empty: there was none. */
std::string searchIn(const std::string& message)
{
  const std::size_t begin = message.find("mean z^2/r");
  return begin == std::string::npos ? std::string() : message.substr(begin);
}

TEST(OdometryRecovery, ASearchWithoutHopeWaitsBeforeItIsRepeated)
{
  RoomRecording recording = roomForRecovery();
  recording.scans.erase(recording.scans.begin() + 30, recording.scans.begin() + 60);
  for (std::size_t k = 30; k < recording.scans.size(); ++k)  // another room
    for (float& x : recording.scans[k].points.x)
      x *= 1.8F;
  std::size_t scans = 0;
  std::set<std::string> searches;
  OdometryOptions parameters = roomParameters();
  parameters.imu.noise.accel_noise_density *= 400.0;  // many places are possible
  for (const ScanResult& result : runInOrder(parameters, recording))
    if (const std::string search = searchIn(result.message); !search.empty())
    {
      ++scans;
      searches.insert(search);
    }
  EXPECT_GE(searches.size(), 2U);
  EXPECT_LE(searches.size() + 5, scans) << "scans between searches say what the last one said";
}

TEST(OdometryRecovery, APoseThatIsLostIsGivenUpAndFoundAgain)
{
  RoomRecording recording = roomForRecovery();
  // 1.5 s of consistent nonsense at once: the gyro's axes are exchanged.
  for (std::size_t i = 700; i < 1000; ++i)
    recording.imu[i].gyro = Vec3(3.0 + recording.imu[i].gyro.z(), -4.0, 2.0);
  OdometryOptions p = roomParameters();
  p.measurement.max_unaided_time = 0.5;
  Odometry odometry(p);
  const Results results = runInOrder(odometry, recording);
  EXPECT_EQ(accountedScans(odometry, results), recording.scans.size());
  EXPECT_GT(countOf(results, ScanStatus::Diverged), 0U);
  EXPECT_EQ(results.back().status, ScanStatus::Tracking);
  EXPECT_NE(textOf(odometry.diagnostics()).find("no scan has matched"), std::string::npos)
      << textOf(odometry.diagnostics());
  for (const ScanResult& r : results)
    ASSERT_TRUE(isFinite(r.filter.x) && r.filter.P.allFinite());
}

TEST(OdometryRecovery, UnitsOfGAndDegreesAreFound)
{
  RoomRecording recording = roomForRecovery();
  for (ImuSample& s : recording.imu)
  {
    s.accel /= 9.80665;
    s.gyro *= 180.0 / M_PI;
  }
  Odometry odometry(roomParameters());
  const Results results = runInOrder(odometry, recording);
  EXPECT_EQ(odometry.imuReport().accel_unit, AccelUnit::G);
  EXPECT_EQ(odometry.imuReport().gyro_unit, GyroUnit::Degrees);
  EXPECT_EQ(accountedScans(odometry, results), recording.scans.size());
  EXPECT_EQ(results.back().status, ScanStatus::Tracking) << results.back().message;
}

TEST(OdometryRecovery, UnitsThatAreGivenCostNothing)
{
  RoomRecording recording = roomForRecovery();
  for (ImuSample& s : recording.imu)
  {
    s.accel /= 9.80665;
    s.gyro *= 180.0 / M_PI;
  }
  OdometryOptions p = roomParameters();
  p.imu.accel_unit = AccelUnit::G;
  p.imu.gyro_unit = GyroUnit::Degrees;
  const Results results = runInOrder(p, recording);
  EXPECT_EQ(countOf(results, ScanStatus::Tracking), recording.scans.size() - 1);
  EXPECT_LT(worstPoseErrors(results, recording).position, 0.01);
}

TEST(OdometryRecovery, AnImuUpsideDownIsFine)
{
  const Mat3 flip = expSO3({M_PI, 0.0, 0.0});
  RoomRecording recording = roomForRecovery();
  for (ImuSample& s : recording.imu)
    s = {s.stamp_ns, flip * s.gyro, flip * s.accel};
  for (LidarScan& scan : recording.scans)
    scan.T_imu_lidar = Pose{flip, Vec3::Zero()} * scan.T_imu_lidar;
  Odometry odometry(roomParameters());
  const Results results = runInOrder(odometry, recording);
  EXPECT_NE(textOf(odometry.diagnostics()).find("upside down"), std::string::npos);
  EXPECT_EQ(countOf(results, ScanStatus::Tracking), recording.scans.size() - 1);
  const double travelled = (results.back().filter.x.p - results.front().filter.x.p).norm();
  const double truth =
      (recording.truthAt(results.back().stamp_ns).p - recording.truthAt(results.front().stamp_ns).p)
          .norm();
  EXPECT_NEAR(travelled, truth, 0.01);
}

TEST(OdometryRecovery, AClockThatIsSetBackLosesNothing)
{
  RoomRecording recording = roomForRecovery();
  constexpr std::int64_t kHourNs = 3'600'000'000'000;
  for (std::size_t i = 900; i < recording.imu.size(); ++i)
    recording.imu[i].stamp_ns -= kHourNs;
  for (std::size_t i = 45; i < recording.scans.size(); ++i)
    recording.scans[i].stamp_ns -= kHourNs;
  Odometry odometry(roomParameters());
  Results results;
  // In the order of the recorder.
  std::size_t sample = 0;
  for (std::size_t i = 0; i < recording.scans.size(); ++i)
  {
    for (; sample < recording.imu.size() && sample <= 20 * (i + 1); ++sample)
      odometry.addImu(recording.imu[sample]);
    odometry.addScan(recording.scans[i]);
    drain(odometry, results);
  }
  finish(odometry, results);
  EXPECT_EQ(odometry.imuReport().clock_steps, 1U);
  EXPECT_EQ(accountedScans(odometry, results), recording.scans.size());
  EXPECT_GE(countOf(results, ScanStatus::Tracking), recording.scans.size() - 2);
  EXPECT_LT(worstPoseErrors(results, roomForRecovery()).position, 0.02);
}

TEST(OdometryRecovery, WrongStampsOfScansDoNotStopTheOthers)
{
  RoomRecording recording = roomForRecovery();
  recording.scans[0].stamp_ns += 86'400'000'000'000;
  recording.scans[40].stamp_ns += 3'600'000'000'000;
  recording.scans[50].stamp_ns -= 3'600'000'000'000;
  recording.scans[55].stamp_ns = std::numeric_limits<std::int64_t>::max();
  recording.scans[56].stamp_ns = std::numeric_limits<std::int64_t>::min();
  Odometry odometry(roomParameters());
  Results results;
  std::size_t sample = 0, processed_in_time = 0;
  for (std::size_t i = 0; i < recording.scans.size(); ++i)
  {
    for (; sample < recording.imu.size() && sample <= 20 * (i + 1); ++sample)
      odometry.addImu(recording.imu[sample]);
    odometry.addScan(recording.scans[i]);
    drain(odometry, results);
    processed_in_time = results.size();
  }
  EXPECT_GE(processed_in_time, recording.scans.size() - 7);
  finish(odometry, results);
  const InputStatistics& counts = odometry.inputStatistics();
  EXPECT_EQ(counts.scans_bad_stamp, 2U);
  EXPECT_EQ(accountedScans(odometry, results) + counts.scans_bad_stamp, recording.scans.size());
  EXPECT_EQ(countOf(results, ScanStatus::Diverged), 0U);
  EXPECT_LT(worstPoseErrors(results, recording).position, 0.01);
}

TEST(OdometryRecovery, ScansInTheWrongOrderAreSorted)
{
  RoomRecording recording = roomForRecovery();
  for (std::size_t i = 10; i + 1 < recording.scans.size(); i += 4)
    std::swap(recording.scans[i], recording.scans[i + 1]);
  Odometry odometry(roomParameters());
  Results results;
  for (const LidarScan& scan : recording.scans)
    odometry.addScan(scan);
  for (const ImuSample& s : recording.imu)
    odometry.addImu(s);
  finish(odometry, results);
  EXPECT_TRUE(sameBits(results, runInOrder(roomParameters(), roomForRecovery())));
}
