// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/initialization/carried_pose.h>
#include <fastlio/math/angles.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
// The heading is about the vertical, whatever the axes of the body were before and are now.
TEST(CarriedPose, TheHeadingIsAsUncertainAsBeforeWhereTheBodyIsTilted)
{
  constexpr double kRoll = 0.0001, kPitch = 0.0004, kYaw = 0.01;  // [rad^2], of the body before
  CarriedPose carried;
  carried.x.g = Vec3(0.0, 0.0, -9.81);
  carried.P.diagonal().segment<3>(kAttitude) = Vec3(kRoll, kPitch, kYaw);
  FilterState start;
  start.x.R = expSO3({0.0, M_PI / 2.0, 0.0});
  start.x.g = carried.x.g;
  const FilterState s = startInCarriedWorld(start, carried);
  const Mat3 in_world = s.x.R * s.P.block<3, 3>(kAttitude, kAttitude) * s.x.R.transpose();
  EXPECT_NEAR(in_world(2, 2), kYaw, 1e-12);
  EXPECT_NEAR(in_world(0, 0), 0.0, 1e-12) << "tilt is known from gravity";
}

// A car that turned was metres beside the straight way, which counted as known to half a metre.
TEST(CarriedPose, IsUncertainToTheSideAsFarAsATurnLeads)
{
  constexpr double kSpeed = 12.0, kRate = 20.0 / kDegPerRad, kSeconds = 1.0;
  FilterState last;
  last.x.R = expSO3({0.3, 0.2, 0.0});
  last.x.v = {kSpeed, 0.0, 0.0};
  last.x.g = {0.0, 0.0, -9.81};
  const CarriedPose carried = carriedOver(last, kSeconds);
  const double aside = kSpeed / kRate * (1.0 - std::cos(kRate * kSeconds));  // [m], of the circle
  EXPECT_GT(aside, 2.0);
  EXPECT_NEAR(std::sqrt(carried.P(kPosition + 1, kPosition + 1)), aside, 0.1 * aside);
  EXPECT_NEAR(std::sqrt(carried.P(kPosition, kPosition)), 0.5, 1e-9) << "along the way";
  last.P(kVelocity, kVelocity) = 4.0;
  EXPECT_NEAR(
      carriedOver(last, kSeconds).P(kPosition, kPosition), 0.25 + 4.0 * kSeconds * kSeconds, 1e-9);
}

TEST(CarriedPose, TheCalibrationGoesOn)
{
  CarriedPose carried;
  carried.x.g = Vec3(0.0, 0.0, -9.81);
  carried.x.time_offset = 0.004;
  carried.x.extrinsic_correction.p = Vec3(0.01, 0.0, 0.0);
  carried.P(kTimeOffset, kTimeOffset) = 1e-8;
  const FilterState s = startInCarriedWorld(FilterState{}, carried);
  EXPECT_EQ(s.x.time_offset, 0.004);
  EXPECT_EQ(s.x.extrinsic_correction.p, carried.x.extrinsic_correction.p);
  EXPECT_EQ(s.P(kTimeOffset, kTimeOffset), 1e-8);
}
}  // namespace
}  // namespace fastlio
