// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_problems.h"
#include <fastlio/filter/gravity.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
TEST(GravityOnSphere, keepsTheDirectionAndSetsTheLength)
{
  testing::Random random(61);
  const FilterState s{random.state(), random.covariance(0.1, 10.0)};
  const FilterState on_sphere = withGravityOnSphere(s, 9.79);
  EXPECT_NEAR(on_sphere.x.g.norm(), 9.79, 1e-12);
  EXPECT_LT(on_sphere.x.g.cross(s.x.g).norm(), 1e-9);
}

TEST(GravityOnSphere, isSureOfTheLengthAndOfNothingElse)
{
  testing::Random random(62);
  const FilterState s{random.state(), random.covariance(0.1, 10.0)};
  const FilterState on_sphere = withGravityOnSphere(s, 9.81);
  const Vec3 along = s.x.g.normalized();
  EXPECT_LT((on_sphere.P.middleRows<3>(kGravity).transpose() * along).norm(), 1e-15);
  const Vec3 across = along.unitOrthogonal();
  EXPECT_NEAR(
      across.dot(on_sphere.P.block<3, 3>(kGravity, kGravity) * across),
      across.dot(s.P.block<3, 3>(kGravity, kGravity) * across), 1e-15);
  EXPECT_EQ((on_sphere.P.topLeftCorner<15, 15>() - s.P.topLeftCorner<15, 15>()).norm(), 0.0);
  EXPECT_LT((on_sphere.P - on_sphere.P.transpose()).norm(), 1e-15);
}
}  // namespace
}  // namespace fastlio
