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

TEST(Nees, BoundsAreThoseOfTheTables)
{
  for (const auto& [degrees, bound] : {std::pair(1, 3.8415), {3, 7.8147}, {6, 12.5916}})
    EXPECT_NEAR(summarizeNees({1.0}, degrees).sample_bound, bound, 1e-4);
  const NeesSummary one = summarizeNees({1.0}, 6);
  EXPECT_NEAR(one.mean_lower, 1.2373, 1e-4);
  EXPECT_NEAR(one.mean_upper, 14.4494, 1e-4);
  const NeesSummary ten = summarizeNees(std::vector<double>(10, 1.0), 10);
  EXPECT_NEAR(ten.mean_lower, 7.42219, 1e-5);
  EXPECT_NEAR(ten.mean_upper, 12.95612, 1e-5);
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
