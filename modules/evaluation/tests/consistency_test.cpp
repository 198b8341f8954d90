// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "sample_trajectories.h"
#include <fastlio/evaluation/consistency.h>

#include <Eigen/Cholesky>

namespace fastlio
{
namespace
{
using testing::expectThrows;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/** A correlated covariance: about 1 deg and 5 cm. */
Matrix6d someCovariance()
{
  Matrix6d A;
  for (int i = 0; i < 36; ++i)
    A(i / 6, i % 6) = std::sin(1.0 + 1.7 * i);
  Vector6d sigma;
  sigma << 0.02, 0.02, 0.02, 0.05, 0.05, 0.05;
  return sigma.asDiagonal() * (A * A.transpose() / 3.0 + Matrix6d::Identity()) * sigma.asDiagonal();
}

/** An estimate whose errors are drawn from P, in the definition of Trajectory::covariances, and
 * which says that its covariance is claimed * P. */
Trajectory drawn(const Trajectory& truth, const Matrix6d& P, double claimed, unsigned seed)
{
  std::mt19937 random(seed);
  const Matrix6d L = P.llt().matrixL();
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses)
  {
    Vector6d unit;
    unit << testing::gaussian(random), testing::gaussian(random);
    const Vector6d e = L * unit;  // truth minus estimate
    pose.T_world_body.R = pose.T_world_body.R * expSO3(-Vec3(e.head<3>()));
    pose.T_world_body.p -= e.tail<3>();
    estimate.covariances.emplace_back(claimed * P);
  }
  return estimate;
}

Consistency consistencyOf(
    const Trajectory& estimate, const Trajectory& truth, NeesAlignment alignment)
{
  return consistency(associate(estimate, truth, {}), alignment).value();
}

TEST(ChiSquare, QuantilesOfTheTables)
{
  EXPECT_NEAR(chiSquareQuantile(0.95, 1), 3.8415, 1e-4);
  EXPECT_NEAR(chiSquareQuantile(0.95, 3), 7.8147, 1e-4);
  EXPECT_NEAR(chiSquareQuantile(0.95, 6), 12.5916, 1e-4);
  EXPECT_NEAR(chiSquareQuantile(0.025, 6), 1.2373, 1e-4);
  EXPECT_NEAR(chiSquareQuantile(0.975, 6), 14.4494, 1e-4);
  EXPECT_NEAR(chiSquareQuantile(0.025, 100), 74.2219, 1e-4);
  EXPECT_NEAR(chiSquareQuantile(0.975, 100), 129.5612, 1e-4);
}

TEST(ChiSquare, ClosedFormOfTwoDegrees)
{
  for (const double p : {1e-6, 0.01, 0.5, 0.95, 0.999999})
    EXPECT_NEAR(chiSquareQuantile(p, 2), -2.0 * std::log1p(-p), 1e-9 * (1.0 - std::log1p(-p)));
}

/** Wilson and Hilferty 1931: the cube root is nearly normal. */
TEST(ChiSquare, ManyDegreesAreNearlyNormal)
{
  for (const double degrees : {2e4, 1e6})
  {
    const double variance = 2.0 / (9.0 * degrees);
    for (const auto& [p, sigmas] : {std::pair(0.025, -1.95996398), {0.5, 0.0}, {0.975, 1.95996398}})
      EXPECT_NEAR(
          chiSquareQuantile(p, degrees) / degrees,
          std::pow(1.0 - variance + sigmas * std::sqrt(variance), 3), 1e-6);
  }
}

TEST(ChiSquare, OutsideOfItsRangesIsAnError)
{
  for (const double p : {0.0, 1.0, -0.1, std::nan("")})
    expectThrows<std::invalid_argument>([p] { (void)chiSquareQuantile(p, 3); }, {"probability"});
  for (const double n : {0.0, -1.0, std::nan("")})
    expectThrows<std::invalid_argument>([n] { (void)chiSquareQuantile(0.5, n); }, {"degrees"});
}

TEST(Nees, OfOneKnownError)
{
  const Trajectory truth = testing::curve(2);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses)
  {
    pose.T_world_body.R = pose.T_world_body.R * expSO3({0.02, 0.0, 0.0});
    pose.T_world_body.p.y() += 0.3;
  }
  Vector6d variances;
  variances << 1e-4, 1.0, 1.0, 1.0, 0.01, 1.0;
  estimate.covariances.assign(2, Matrix6d(variances.asDiagonal()));
  const Consistency c = consistencyOf(estimate, truth, NeesAlignment::None);
  ASSERT_EQ(c.samples.size(), 2U);
  EXPECT_NEAR(c.samples[0].rotation, 4.0, 1e-9);  // (0.02 / 0.01)^2
  EXPECT_NEAR(c.samples[0].position, 9.0, 1e-9);  // (0.3 / 0.1)^2
  EXPECT_NEAR(c.samples[0].pose, 13.0, 1e-9);
}

TEST(Nees, HonestCovariancesAreConsistent)
{
  const Trajectory truth = testing::curve(2000);
  const Consistency c =
      consistencyOf(drawn(truth, someCovariance(), 1.0, 7), truth, NeesAlignment::None);
  for (const NeesSummary& s : {c.pose, c.position, c.rotation})
  {
    EXPECT_EQ(s.count, 2000U);
    EXPECT_TRUE(s.meanInside()) << s.mean << " not in " << s.mean_lower << " " << s.mean_upper;
    EXPECT_NEAR(s.coverage, 0.95, 0.02);
    EXPECT_LT(s.mean_lower, s.degrees);
    EXPECT_GT(s.mean_upper, s.degrees);
  }
  EXPECT_EQ(c.pose.degrees, 6);
  EXPECT_EQ(c.position.degrees, 3);
}

TEST(Nees, WrongCovariancesAreNot)
{
  const Trajectory truth = testing::curve(500);
  for (const double claimed : {0.5, 2.0})
  {
    const Consistency c =
        consistencyOf(drawn(truth, someCovariance(), claimed, 8), truth, NeesAlignment::None);
    for (const NeesSummary& s : {c.pose, c.position, c.rotation})
    {
      EXPECT_FALSE(s.meanInside());
      EXPECT_EQ(s.mean > s.mean_upper, claimed < 1.0);
    }
  }
}

/** Swapping the blocks of the covariance must not go unnoticed. */
TEST(Nees, TheOrderOfTheBlocksMatters)
{
  const Trajectory truth = testing::curve(500);
  Trajectory estimate = drawn(truth, someCovariance(), 1.0, 9);
  for (Matrix6& P : estimate.covariances)
  {
    const Matrix6 swapped = (Matrix6() << P.bottomRightCorner<3, 3>(), P.bottomLeftCorner<3, 3>(),
                             P.topRightCorner<3, 3>(), P.topLeftCorner<3, 3>())
                                .finished();
    P = swapped;
  }
  EXPECT_FALSE(consistencyOf(estimate, truth, NeesAlignment::None).position.meanInside());
}

TEST(Nees, FirstAlignmentIsIndependentOfTheWorldFrame)
{
  std::mt19937 random(10);
  const Trajectory truth = testing::curve(300);
  Trajectory estimate = drawn(truth, someCovariance(), 1.0, 11);
  estimate.poses.front() = truth.poses.front();  // the filter knows its start
  const Consistency in_one_world = consistencyOf(estimate, truth, NeesAlignment::First);
  const Consistency in_another = consistencyOf(
      estimate, testing::moved(testing::randomPose(random), truth), NeesAlignment::First);
  ASSERT_EQ(in_one_world.samples.size(), 299U);
  ASSERT_EQ(in_another.samples.size(), 299U);
  for (std::size_t i = 0; i < 299; ++i)
  {
    EXPECT_NEAR(in_one_world.samples[i].pose, in_another.samples[i].pose, 1e-6);
    EXPECT_NEAR(in_one_world.samples[i].position, in_another.samples[i].position, 1e-6);
  }
  EXPECT_TRUE(in_another.pose.meanInside());
}

TEST(Nees, SingularCovariancesAreCountedAndLeftOut)
{
  const Trajectory truth = testing::curve(50);
  Trajectory estimate = drawn(truth, someCovariance(), 1.0, 12);
  estimate.covariances[3] = Matrix6::Zero();
  estimate.covariances[4] *= -1.0;
  const Consistency c = consistencyOf(estimate, truth, NeesAlignment::None);
  EXPECT_EQ(c.singular, 2U);
  EXPECT_EQ(c.samples.size(), 48U);
  for (Matrix6& P : estimate.covariances)
    P.setZero();
  EXPECT_FALSE(consistency(associate(estimate, truth, {}), NeesAlignment::None).has_value());
}

TEST(Nees, DeviationsAreTheErrorsWithTheirStandardDeviations)
{
  const Trajectory truth = testing::curve(20, 100'000'000);
  Trajectory estimate = truth;
  estimate.poses[7].T_world_body.p.z() -= 0.5;
  const auto without = deviations(associate(estimate, truth, {}), NeesAlignment::First);
  ASSERT_EQ(without.size(), 20U);
  EXPECT_NEAR(without[7].error[5], 0.5, 1e-9);
  EXPECT_LT(without[7].sigma[5], 0.0);
  estimate.covariances.assign(20, Matrix6(0.04 * Matrix6::Identity()));
  const auto with = deviations(associate(estimate, truth, {}), NeesAlignment::First);
  EXPECT_NEAR(with[7].sigma[5], 0.2, 1e-12);
  EXPECT_NEAR(with[8].error.norm(), 0.0, 1e-9);
}

TEST(Nees, SummaryNeedsSamples)
{
  expectThrows<std::invalid_argument>([] { (void)summarizeNees({}, 3); }, {"no sample"});
  expectThrows<std::invalid_argument>([] { (void)summarizeNees({1.0}, 0); }, {"degrees"});
}

}  // namespace
}  // namespace fastlio
