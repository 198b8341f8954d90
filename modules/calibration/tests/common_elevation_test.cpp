// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "../src/common_elevation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
/** Two values of theta and one beam. \param response of the second value */
CommonElevation commonElevation(double response)
{
  return {Eigen::Vector3d(0.0, 0.0, 2e-4), Eigen::Vector3d(0.0, response, 0.0)};
}

TEST(CommonElevation, SharesAnErrorByThePriors)
{
  // 8 mm by the common elevation are as likely as 8 mm by the mounting: half of it each.
  const Eigen::Vector2d prior_std(0.01, 0.008);
  Eigen::VectorXd x = Eigen::Vector3d(0.003, -0.014, 0.001);
  Eigen::MatrixXd covariance = Eigen::Vector3d(1e-6, 4e-6, 1e-9).asDiagonal();
  const Eigen::VectorXd hidden = shareOut(commonElevation(-0.008), prior_std, x, covariance);
  EXPECT_DOUBLE_EQ(x[0], 0.003);
  EXPECT_NEAR(x[1], -0.007, 1e-12);
  EXPECT_NEAR(x[2], 0.001 - 2e-4 * 0.875, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 4e-6 + 0.5 * 0.008 * 0.008, 1e-12);
  EXPECT_NEAR(std::abs(hidden[1]), 0.008 / std::sqrt(2.0), 1e-12);
  EXPECT_LT(covariance(1, 2), 0.0) << "they explain the same";
}

TEST(CommonElevation, LeavesWhatItDoesNotReach)
{
  const Eigen::Vector2d prior_std(0.01, 0.0);  // the second value is known
  Eigen::VectorXd x = Eigen::Vector3d(0.003, 0.0, 0.001);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(3, 3);
  (void)shareOut({Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}, prior_std, x, covariance);
  EXPECT_TRUE(x.isApprox(Eigen::Vector3d(0.003, 0.0, 0.001)));
  EXPECT_TRUE(covariance.isIdentity());
  (void)shareOut(commonElevation(0.0), prior_std, x, covariance);
  EXPECT_DOUBLE_EQ(x[1], 0.0);
  EXPECT_GT(covariance(2, 2), 1.0);
}
}  // namespace
}  // namespace fastlio
