// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Rhythm, inertial samples at rest, and the comparison of motions, on numbers made for them.

#include <fastlio/survey/imu_survey.h>
#include <fastlio/survey/motion_check.h>
#include <fastlio/survey/stamp_report.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fastlio
{
namespace
{
constexpr std::int64_t kStart = 1'700'000'000'000'000'000;

Vec3 rateAt(double t)
{
  return {0.8 * std::sin(2.1 * t), 0.6 * std::cos(3.3 * t), 0.9 * std::sin(1.3 * t + 1.0)};
}

/** 20 s of an IMU; from the fifth second on it turns as rateAt(). */
std::vector<ImuSample> samplesOf(double gyro_unit, double accel_unit, bool moves = true)
{
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 1.0);
  const auto vector = [&] { return Vec3(noise(random), noise(random), noise(random)); };
  std::vector<ImuSample> samples;
  for (int i = 0; i < 4000; ++i)
  {
    const double t = 0.005 * i;
    const bool still = !moves || t < 5.0;
    const Vec3 rate = Vec3(0.01, 0, 0) + 0.003 * vector() + (still ? Vec3(0, 0, 0) : rateAt(t));
    const Vec3 force =
        Vec3(0, 0, -9.81) + 0.03 * vector() + (still ? Vec3(0, 0, 0) : Vec3(rateAt(2.0 * t)));
    samples.push_back({kStart + i * 5'000'000LL, rate / gyro_unit, force / accel_unit});
  }
  return samples;
}

/** Turns of a LiDAR that is mounted turned by R_imu_lidar and whose clock is ahead. */
std::vector<ScanTurn> turnsOf(const Mat3& R_imu_lidar, double ahead)
{
  std::vector<ScanTurn> turns;
  for (int k = 60; k < 160; ++k)
  {
    const double begin = 0.1 * k, end = begin + 0.1;
    Vec3 turned = Vec3::Zero();
    for (int i = 0; i < 100; ++i)
      turned += 0.001 * rateAt(begin + 0.001 * (i + 0.5));
    const auto stamp = [&](double t) { return kStart + std::llround((t + ahead) * 1e9); };
    turns.push_back({stamp(begin), stamp(end), R_imu_lidar.transpose() * turned});
  }
  return turns;
}
}  // namespace

TEST(StampReport, CountsWhatDisturbsTheRhythm)
{
  std::vector<std::int64_t> stamps;
  stamps.reserve(172);
  for (int i = 0; i < 100; ++i)
    stamps.push_back(kStart + i * 10'000'000LL + (i % 2) * 1'000'000LL);
  for (int i = 130; i < 200; ++i)  // 0.3 s are missing
    stamps.push_back(kStart + i * 10'000'000LL);
  stamps.push_back(stamps.back());
  stamps.push_back(stamps.back() - 50'000'000LL);
  const StampReport report = reportOn(stamps);
  EXPECT_EQ(report.count, 172U);
  EXPECT_NEAR(report.rate(), 100.0, 15.0);
  EXPECT_EQ(report.gaps, 1U);
  EXPECT_NEAR(report.longest_gap, 0.309, 0.002);
  EXPECT_EQ(report.longest_gap_ns, kStart + 991'000'000LL);
  EXPECT_EQ(report.duplicates, 1U);
  EXPECT_EQ(report.backwards, 1U);
  EXPECT_GT(report.jitter, 0.0004);
  EXPECT_LT(report.jitter, 0.002);
  EXPECT_EQ(reportOn({}).count, 0U);
  EXPECT_EQ(reportOn({kStart}).rate(), 0.0);
}

TEST(ImuSurvey, FindsTheRestAndWhatItShows)
{
  for (const auto& [unit, name] :
       {std::pair{1.0, "m/s^2"}, {9.80665, "g"}, {9.80665e-3, "mg"}, {3.3, ""}})
  {
    const ImuSurvey survey = surveyImu(samplesOf(1.0, unit), 200.0);
    EXPECT_TRUE(survey.rests);
    EXPECT_NEAR(survey.rest_seconds, 5.0, 0.3);
    EXPECT_EQ(survey.rest_begin_ns, kStart);
    EXPECT_NEAR(survey.accel_norm * unit, 9.81, 0.01);
    EXPECT_EQ(survey.accel_unit, name);
    EXPECT_NEAR(survey.up.z(), -1.0, 1e-3);  // upside down
    EXPECT_NEAR(survey.gyro_mean.x(), 0.01, 1e-3);
    EXPECT_NEAR(survey.gyro_noise_density, 0.003 / std::sqrt(200.0), 2e-5);
    EXPECT_NEAR(survey.accel_noise_density * unit, 0.03 / std::sqrt(200.0), 2e-4);
  }
  EXPECT_FALSE(surveyImu({}, 200.0).rests);
}

/** A wheelchair that turns on the spot, for longer than it has stood: turning has no more scatter.
 */
TEST(ImuSurvey, ASteadyTurnIsNoRest)
{
  std::mt19937 engine(4);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::vector<ImuSample> samples;
  for (int i = 0; i < 12 * 200; ++i)
  {
    const bool turns = i > 3 * 200 && i < 9 * 200;
    ImuSample& sample = samples.emplace_back();
    sample.stamp_ns = kStart + i * 5'000'000LL;
    sample.gyro = Vec3(0.01 + noise(engine), noise(engine), noise(engine) + (turns ? 1.0 : 0.0));
    sample.accel = Vec3(noise(engine), noise(engine), 9.81 + noise(engine));
  }
  const ImuSurvey survey = surveyImu(samples, 200.0);
  EXPECT_TRUE(survey.rests);
  EXPECT_NEAR(survey.rest_seconds, 3.0, 0.5);
  EXPECT_LT(survey.gyro_mean.norm(), 0.02);
  EXPECT_NEAR(survey.gyro_noise_density, 0.01 / std::sqrt(200.0), 1e-4);
}

TEST(MotionCheck, FindsOffsetMountingAndUnit)
{
  const Mat3 R_imu_lidar = expSO3(Vec3(0.3, -1.2, 2.0));
  for (const double ahead : {0.0, 0.123, -0.07})
    for (const double gyro_unit : {1.0, 0.017453292519943295})
    {
      const MotionCheck check = checkMotion(turnsOf(R_imu_lidar, ahead), samplesOf(gyro_unit, 1.0));
      ASSERT_TRUE(check.conclusive) << check.correlation;
      EXPECT_NEAR(check.time_offset, -ahead, 0.002);
      EXPECT_TRUE(check.rotation_known);
      EXPECT_LT(logSO3(check.R_imu_lidar.transpose() * R_imu_lidar).norm(), 0.02);
      EXPECT_NEAR(check.scale * gyro_unit, 1.0, 0.02);
    }
}

TEST(MotionCheck, SaysWhenItDoesNotKnow)
{
  const auto turns = turnsOf(Mat3::Identity(), 0.0);
  const MotionCheck other = checkMotion(turns, samplesOf(1.0, 1.0, false));  // another motion
  EXPECT_FALSE(other.conclusive || other.rotation_known);
  EXPECT_FALSE(checkMotion({}, samplesOf(1.0, 1.0)).conclusive);
  EXPECT_FALSE(checkMotion(turns, {}).conclusive);
  // Neither sensor has moved at all.
  auto at_rest = turns;
  for (ScanTurn& turn : at_rest)
    turn.rotation.setZero();
  const MotionCheck rest = checkMotion(at_rest, samplesOf(1.0, 1.0));
  EXPECT_FALSE(rest.conclusive || rest.rotation_known);
  auto far_off = turns;  // by more than is looked for
  for (ScanTurn& turn : far_off)
    turn.begin_ns += 3'600'000'000'000, turn.end_ns += 3'600'000'000'000;
  EXPECT_FALSE(checkMotion(far_off, samplesOf(1.0, 1.0)).conclusive);
}

/** Some scans are matched wrongly: the offset of the clocks is not certain then, the rotation is.
 */
TEST(MotionCheck, FindsTheRotationDespiteWrongMatches)
{
  const Mat3 R_imu_lidar = expSO3(Vec3(0.3, -1.2, 2.0));
  auto turns = turnsOf(R_imu_lidar, 0.0);
  std::mt19937 random(5);
  std::normal_distribution<double> wrong(0.0, 0.06);
  for (std::size_t i = 0; i < turns.size(); i += 10)
    turns[i].rotation = Vec3(wrong(random), wrong(random), wrong(random));
  const MotionCheck check = checkMotion(turns, samplesOf(1.0, 1.0));
  EXPECT_FALSE(check.conclusive) << check.correlation;
  ASSERT_TRUE(check.rotation_known) << check.rotation_std;
  const double error = logSO3(check.R_imu_lidar.transpose() * R_imu_lidar).norm();
  EXPECT_LT(error, 0.01);
  EXPECT_LT(error, 4.0 * check.rotation_std);
}

TEST(MotionCheck, ATurnAboutOneAxisLeavesTheRotationOpen)
{
  auto turns = turnsOf(Mat3::Identity(), 0.0);
  auto samples = samplesOf(1.0, 1.0);
  std::mt19937 random(6);
  std::normal_distribution<double> noise(0.0, 0.003);
  for (ScanTurn& turn : turns)
    turn.rotation = Vec3(noise(random), noise(random), turn.rotation.z() + noise(random));
  for (ImuSample& sample : samples)
    sample.gyro.head<2>().setZero();
  const MotionCheck check = checkMotion(turns, samples);
  EXPECT_GT(check.correlation, 0.95);
  EXPECT_FALSE(check.rotation_known) << check.rotation_std;
}

TEST(MotionCheck, ScansOfARoomTellHowTheyWereTurned)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Pose T_first_second{expSO3(Vec3(0.03, -0.05, 0.1)), Vec3(0.1, 0.05, -0.02)};
  PointColumns first, second;
  for (int i = 0; i < 12000; ++i)
  {
    Vec3 p(5.0 * uniform(random), 4.0 * uniform(random), 2.0 * uniform(random));
    const int wall = i % 3;
    p[wall] = std::copysign(wall == 0 ? 5.0 : wall == 1 ? 4.0 : 2.0, p[wall]);
    const auto add = [](PointColumns& points, const Vec3& q)
    {
      points.push_back(
          static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()), 0, 0, 0);
    };
    i % 2 == 0 ? add(first, p) : add(second, T_first_second.inverse() * p);
  }
  const auto found = matchScans(first, second);
  ASSERT_TRUE(found);
  EXPECT_LT(logSO3(found->R.transpose() * T_first_second.R).norm(), 0.003);
  EXPECT_LT((found->p - T_first_second.p).norm(), 0.01);
  EXPECT_FALSE(matchScans(first, PointColumns{}));
  // A scan without a point in reach: of a covered LiDAR, or of an empty file.
  EXPECT_FALSE(matchScans(PointColumns{}, first));
  PointColumns near;
  for (int i = 0; i < 100; ++i)
    near.push_back(0.001F * static_cast<float>(i), 0.5F, 0.0F, 0, 0, 0);
  EXPECT_FALSE(matchScans(near, first));
}

}  // namespace fastlio
