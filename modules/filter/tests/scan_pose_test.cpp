// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_problems.h"
#include <fastlio/filter/scan_pose.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
using testing::Random;

/** The compensation of a scan's points, at some distance from \a x. */
CompensatedWith compensationNear(Random& random, const NavState& x, double distance)
{
  CompensatedWith c;
  c.extrinsic_correction.R = x.extrinsic_correction.R * expSO3(random.vector(distance));
  c.extrinsic_correction.p = x.extrinsic_correction.p + random.vector(distance);
  c.time_offset = x.time_offset + 0.1 * distance * random.normal();
  c.angular_rate = random.vector(3.0);
  return c;
}

/** Scan pose b as seen from a: attitude in the frame of a, position in the world. */
Vector6 difference(const Pose& b, const Pose& a)
{
  Vector6 d;
  d << logSO3(a.R.transpose() * b.R), b.p - a.p;
  return d;
}

TEST(ScanPose, IsTheBodyPoseWithTheCalibrationOfTheCompensation)
{
  Random random(41);
  const NavState x = random.state();
  CompensatedWith c = compensationNear(random, x, 0.0);
  const Pose pose = scanPose(x, c);
  EXPECT_LT(difference(pose, x.pose()).norm(), 1e-12);
  const ScanPoseJacobian J = scanPoseJacobian(x, c);
  EXPECT_LT(
      (J.leftCols<kNavigationDim>() - bodyPoseJacobian().leftCols<kNavigationDim>()).norm(), 1e-12);
}

TEST(ScanPose, OfABodyAtRestDoesNotDependOnTheTimeOffset)
{
  Random random(43);
  NavState x = random.state();
  CompensatedWith c = compensationNear(random, x, 0.1);
  c.angular_rate.setZero();
  c.moves = false;
  const Pose before = scanPose(x, c);
  EXPECT_EQ(scanPoseJacobian(x, c).col(kTimeOffset).norm(), 0.0);
  x.time_offset += 1.0;
  EXPECT_EQ(difference(scanPose(x, c), before).norm(), 0.0);
}

TEST(ScanPose, DoesNotShowAWrongTimeOffsetThatTheBodyPoseHides)
{
  Random random(44);
  for (const bool moves : {true, false})
  {
    const NavState x = random.state();
    CompensatedWith c = compensationNear(random, x, 0.0);
    c.moves = moves;
    if (!moves) c.angular_rate.setZero();
    const StateVector hidden = hiddenByTimeOffset(x, c);
    EXPECT_EQ(hidden[kTimeOffset], 1.0);
    EXPECT_LT((scanPoseJacobian(x, c) * hidden).norm(), 1e-12);
    const StateVector step = 1e-3 * hidden;
    EXPECT_LT(difference(scanPose(boxplus(x, step), c), scanPose(x, c)).norm(), 1e-9);
  }
}

TEST(ScanPose, JacobianIsTheDerivative)
{
  constexpr double kStep = 1e-6;
  Random random(42);
  for (const double distance : {0.0, 0.01, 0.5, -0.5})
  {
    const NavState x = random.state();
    CompensatedWith c = compensationNear(random, x, std::abs(distance));
    c.moves = distance >= 0.0;
    const Pose at = scanPose(x, c);
    const ScanPoseJacobian J = scanPoseJacobian(x, c);
    for (int i = 0; i < kStateDim; ++i)
    {
      const StateVector e = kStep * StateVector::Unit(i);
      const Vector6 numeric = (difference(scanPose(boxplus(x, e), c), at) -
                               difference(scanPose(boxplus(x, -e), c), at)) /
                              (2.0 * kStep);
      EXPECT_LT((J.col(i) - numeric).norm(), 1e-6) << "column " << i << ", distance " << distance;
    }
  }
}

TEST(ScanPose, MovesPointsAsANewCompensationWould)
{
  // A point at the scan's end, measured with the extrinsic T: the correction moves it as C T does.
  Random random(43);
  const NavState x = random.state();
  CompensatedWith c = compensationNear(random, x, 0.2);
  c.time_offset = x.time_offset;
  const Pose T_imu_lidar{expSO3(random.vector()), random.vector()};
  const Vec3 p_lidar = random.vector(10.0);
  const Vec3 p_body = c.extrinsic_correction * T_imu_lidar * p_lidar;
  const Vec3 expected = x.pose() * (x.extrinsic_correction * T_imu_lidar) * p_lidar;
  EXPECT_LT((scanPose(x, c) * p_body - expected).norm(), 1e-12);
}

TEST(ScanPose, ALaterStampFindsTheBodyFurtherOnItsWay)
{
  NavState x;
  x.v = Vec3(2.0, 0.0, 0.0);
  CompensatedWith c;
  c.angular_rate = Vec3(0.0, 0.0, 1.0);
  x.time_offset = 0.01;
  const Pose pose = scanPose(x, c);
  EXPECT_NEAR(pose.p.x(), 0.02, 1e-15);
  EXPECT_NEAR(logSO3(pose.R).z(), 0.01, 1e-15);
}
}  // namespace
}  // namespace fastlio
