// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "samples_at_rest.h"
#include <fastlio/initialization/static_initializer.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
/** Estimate minus truth of gyro bias, accelerometer bias and gravity in the estimate's world. */
Eigen::Matrix<double, 9, 1> biasAndGravityError(const FilterState& s, const RestTruth& truth)
{
  Eigen::Matrix<double, 9, 1> e;
  e << s.x.gyro_bias - truth.gyro_bias, s.x.accel_bias - truth.accel_bias, s.x.g - s.x.R * truth.g;
  return e;
}

template <int N>
double normalizedSquare(const FilterState& s, const Eigen::Matrix<double, 9, 1>& e, int first)
{
  const Eigen::Matrix<double, N, N> P = s.P.block<N, N>(kGyroBias + first, kGyroBias + first);
  const Eigen::Matrix<double, N, 1> part = e.segment<N>(first);
  return part.dot(P.ldlt().solve(part));
}

RestStatistics restOf(const Vec3& gyro, const Vec3& accel)
{
  RestStatistics rest;
  rest.samples = kSamples;
  rest.gyro_mean = gyro;
  rest.accel_mean = accel;
  rest.gyro_std.setConstant(kGyroNoise);
  rest.accel_std.setConstant(kAccelNoise);
  return rest;
}

TEST(RestStatistics, AreMeanAndUnbiasedScatter)
{
  const std::vector<ImuSample> samples{
      {0, {1, 0, 0}, {0, 0, 9}}, {1, {2, 0, 0}, {0, 0, 10}}, {2, {6, 0, 0}, {0, 0, 11}}};
  const RestStatistics rest = restStatistics(samples);
  EXPECT_EQ(rest.samples, 3U);
  EXPECT_NEAR(rest.gyro_mean.x(), 3.0, 1e-12);
  EXPECT_NEAR(rest.gyro_std.x(), std::sqrt(7.0), 1e-12);
  EXPECT_NEAR(rest.accel_mean.z(), 10.0, 1e-12);
  EXPECT_NEAR(rest.accel_std.z(), 1.0, 1e-12);
  EXPECT_EQ(rest.gyro_std.y(), 0.0);
}

TEST(RestStatistics, DoNotCancelFarFromZero)
{
  std::vector<ImuSample> samples;
  samples.reserve(1000);
  for (int i = 0; i < 1000; ++i)
    samples.push_back({i, Vec3::Constant(1e4 + (i % 2) * 1e-4), Vec3::Constant(1e6)});
  EXPECT_NEAR(restStatistics(samples).gyro_std.x(), 0.5e-4, 1e-7);
  EXPECT_EQ(restStatistics(samples).accel_std.x(), 0.0);
}

TEST(RestStatistics, OfOneSampleOrNoneSayThatThereAreTooFew)
{
  EXPECT_EQ(restStatistics({}).samples, 0U);
  EXPECT_EQ(restStatistics({ImuSample{}}).samples, 1U);
  const auto reason = whyNotAtRest(restStatistics({ImuSample{}}), {});
  ASSERT_TRUE(reason);
  EXPECT_NE(reason->find("1 IMU sample"), std::string::npos) << *reason;
}

TEST(RestingSamples, AreAllOfThemWhereThePlatformRests)
{
  Random random(7);
  constexpr int kDraws = 1000;
  int shortened = 0;
  for (int k = 0; k < kDraws; ++k)
  {
    const std::vector<ImuSample> samples = samplesWithAnEngine(drawTruth({}, random), random);
    shortened += restingSamples(samples) < samples.size() ? 1 : 0;
  }
  EXPECT_LT(shortened, kDraws / 50);
}

TEST(RestingSamples, EndWhereThePlatformMovesOff)
{
  Random random(8);
  std::vector<ImuSample> samples = samplesAtRest(drawTruth({}, random), random);
  for (std::size_t i = 340; i < samples.size(); ++i)
    samples[i].accel.x() += 0.1;
  EXPECT_EQ(restingSamples(samples), 340U);
  for (std::size_t i = 261; i < samples.size(); ++i)
    samples[i].gyro.z() += 0.1;
  EXPECT_EQ(restingSamples(samples), 260U);
}

TEST(RestingSamples, OfSignalsWithoutNoiseAreAll)
{
  EXPECT_EQ(restingSamples({}), 0U);
  EXPECT_EQ(restingSamples(std::vector<ImuSample>(7)), 7U);
  EXPECT_EQ(
      restingSamples(std::vector<ImuSample>(100, {0, Vec3::Constant(0.1), {0.0, 0.0, 9.81}})),
      100U);
}

TEST(InitialState, IsConsistentWithItsCovariance)
{
  InitializationOptions p;
  constexpr int kDraws = 3000;
  for (const bool align : {true, false})
  {
    p.align_with_gravity = align;
    Random random(align ? 1 : 2);
    double all = 0.0, gyro = 0.0, accel = 0.0, gravity = 0.0, both = 0.0;
    for (int k = 0; k < kDraws; ++k)
    {
      const RestTruth truth = drawTruth(p, random);
      const FilterState s = initialState(restStatistics(samplesAtRest(truth, random)), p);
      const auto e = biasAndGravityError(s, truth);
      all += normalizedSquare<9>(s, e, 0) / kDraws;
      gyro += normalizedSquare<3>(s, e, 0) / kDraws;
      accel += normalizedSquare<3>(s, e, 3) / kDraws;
      gravity += normalizedSquare<3>(s, e, 6) / kDraws;
      both += normalizedSquare<6>(s, e, 3) / kDraws;  // their correlation is part of it
    }
    // Means of chi-square variables, five standard errors.
    EXPECT_NEAR(all, 9.0, 5.0 * std::sqrt(18.0 / kDraws));
    EXPECT_NEAR(both, 6.0, 5.0 * std::sqrt(12.0 / kDraws));
    EXPECT_NEAR(gyro, 3.0, 5.0 * std::sqrt(6.0 / kDraws));
    EXPECT_NEAR(accel, 3.0, 5.0 * std::sqrt(6.0 / kDraws));
    EXPECT_NEAR(gravity, 3.0, 5.0 * std::sqrt(6.0 / kDraws));
  }
}

TEST(InitialState, StaysWithinThreeSigmaOfTheTruth)
{
  const InitializationOptions p;
  Random random(3);
  int outside = 0;
  constexpr int kDraws = 1000;
  for (int k = 0; k < kDraws; ++k)
  {
    const RestTruth truth = drawTruth(p, random);
    const FilterState s = initialState(restStatistics(samplesAtRest(truth, random)), p);
    const auto e = biasAndGravityError(s, truth);
    for (int i = 0; i < 9; ++i)
      outside += std::abs(e[i]) > 3.0 * std::sqrt(s.P(kGyroBias + i, kGyroBias + i)) ? 1 : 0;
  }
  EXPECT_LT(outside, 0.006 * 9 * kDraws);  // 0.27 % by the normal distribution
}

TEST(InitialState, KnowsThatOnlyTheDifferenceOfBiasAndGravityIsSeen)
{
  const InitializationOptions p;
  const FilterState s = initialState(restOf(Vec3::Zero(), {0.3, -0.2, 9.7}), p);
  const Mat3 R = s.x.R;
  const Mat3 P_bias = s.P.block<3, 3>(kAccelBias, kAccelBias);
  const Mat3 P_g = R.transpose() * s.P.block<3, 3>(kGravity, kGravity) * R;
  const Mat3 cross = s.P.block<3, 3>(kAccelBias, kGravity) * R;
  const Mat3 difference = P_bias + P_g - cross - cross.transpose();
  const double expected = kAccelNoise * kAccelNoise / kSamples;
  EXPECT_LT((difference - expected * Mat3::Identity()).norm(), 0.01 * expected);
  EXPECT_GT(P_bias(0, 0), 0.9 * p.accel_bias_std * p.accel_bias_std);
}

TEST(InitialState, DefinesTheWorldFrame)
{
  InitializationOptions p;
  // Every way up, and exactly upside down.
  for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(-0.6, 0.64, -0.48)})
  {
    const FilterState s = initialState(restOf({0.01, 0.02, -0.03}, 9.81 * up), p);
    EXPECT_LT((s.x.R * up - Vec3::UnitZ()).norm(), 1e-9);
    EXPECT_NEAR(s.x.R.determinant(), 1.0, 1e-9);
    EXPECT_LT((s.x.g - Vec3(0, 0, -9.81)).norm(), 1e-6);
    EXPECT_EQ(s.x.gyro_bias, Vec3(0.01, 0.02, -0.03));
    EXPECT_EQ(s.x.p, Vec3::Zero());
    EXPECT_EQ(s.x.v, Vec3::Zero());
    EXPECT_EQ((s.P.topRows<6>().norm()), 0.0) << "pose: no error by definition";
    EXPECT_LT((s.P - s.P.transpose()).norm(), 1e-12);
  }
  p.align_with_gravity = false;  // as in the paper
  const FilterState s = initialState(restOf(Vec3::Zero(), {9.81, 0, 0}), p);
  EXPECT_EQ(s.x.R, Mat3::Identity());
  EXPECT_LT((s.x.g - Vec3(-9.81, 0, 0)).norm(), 1e-6);
}

TEST(WhyNotAtRest, AcceptsRest)
{
  EXPECT_FALSE(whyNotAtRest(restOf({0.01, 0, 0}, {0, 0, 9.7}), {}));
}

TEST(WhyNotAtRest, NamesTheCauseAndTheParameter)
{
  const auto expectReason = [](const RestStatistics& rest, std::initializer_list<const char*> words)
  {
    const auto reason = whyNotAtRest(rest, {});
    ASSERT_TRUE(reason);
    for (const char* word : words)
      EXPECT_NE(reason->find(word), std::string::npos) << word << " is not in: " << *reason;
  };
  const Vec3 up(0, 0, 9.81);
  // Turning at 0.5 rad/s = 28.65 deg/s, which a resting gyro in deg/s looks like too.
  expectReason(restOf({0.5, 0, 0}, up), {"does not rest", "28.65", "imu.gyro_unit"});
  RestStatistics shaken = restOf(Vec3::Zero(), up);
  shaken.gyro_std.y() = 0.3;
  expectReason(shaken, {"does not rest", "17.19", "imu.gyro_unit"});
  shaken = restOf(Vec3::Zero(), up);
  shaken.accel_std.x() = 2.5;
  expectReason(shaken, {"does not rest", "2.5"});
  expectReason(
      restOf(Vec3::Zero(), {0, 0, 1.0}), {"1.0000", "units of g", "initialization.gravity"});
  expectReason(restOf(Vec3::Zero(), Vec3::Zero()), {"gravity removed", "max_gravity_error"});
  expectReason(restOf(Vec3::Zero(), {0, 0, 12.0}), {"12.0000", "9.8100"});
}
}  // namespace
}  // namespace fastlio
