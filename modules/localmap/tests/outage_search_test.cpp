// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/localmap/outage_search.h>
#include <fastlio/matching/pose_search.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
// The error of the velocity is known, so most of that of the position is known, too.
TEST(CorrectedByVelocity, DeterminesThePosition)
{
  FilterState s;
  s.P.diagonal().setConstant(1e-8);
  considerUnmodelledAcceleration(s, 10.0);
  const double before = positionStd(s).maxCoeff();
  EXPECT_NEAR(before, 2.5, 0.01);
  VelocityError error;
  error.mean = Vec3(0.4, 0.0, 0.0);
  error.covariance = 0.05 * 0.05 * Mat3::Identity();
  const FilterState corrected = correctedByVelocity(s, error);
  EXPECT_NEAR(corrected.x.v.x(), s.x.v.x() + 0.4, 0.02);
  EXPECT_NEAR(corrected.x.p.x(), s.x.p.x() + 0.4 * 10.0 / 2.0, 0.2);
  EXPECT_LT(positionStd(corrected).maxCoeff(), before / 3.0);
  EXPECT_NEAR(corrected.x.v.z(), s.x.v.z(), 1e-6);
}

TEST(CorrectedByVelocity, LeavesAloneWhatIsNotMeasured)
{
  FilterState s;
  s.P.diagonal().setConstant(1e-8);
  considerUnmodelledAcceleration(s, 10.0);
  VelocityError error;
  error.mean = Vec3(0.0, 0.0, 0.8);
  error.covariance = 0.05 * 0.05 * Mat3::Identity();
  error.covariance(2, 2) = 1e4;
  const FilterState corrected = correctedByVelocity(s, error);
  EXPECT_NEAR(corrected.x.p.z(), s.x.p.z(), 1e-3);
  EXPECT_NEAR(corrected.P(kPosition + 2, kPosition + 2), s.P(kPosition + 2, kPosition + 2), 1e-3);
}

}  // namespace
}  // namespace fastlio
