// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/pose.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
void expectEqual(const Pose& a, const Pose& b)
{
  EXPECT_LT((a.R - b.R).norm(), 1e-14);
  EXPECT_LT((a.p - b.p).norm(), 1e-14);
}
}  // namespace

TEST(InterpolatedPose, MovesAndTurnsEvenlyFromOneToTheOther)
{
  const Pose a{expSO3(Vec3(0.3, -0.2, 1.0)), Vec3(1.0, 2.0, 3.0)};
  const Vec3 turn(0.8, -1.2, 0.4);
  const Pose b{a.R * expSO3(turn), a.p + Vec3(4.0, 0.0, -2.0)};
  expectEqual(interpolated(a, b, 0.0), a);
  expectEqual(interpolated(a, b, 1.0), b);
  expectEqual(interpolated(a, b, 0.25), {a.R * expSO3(0.25 * turn), a.p + Vec3(1.0, 0.0, -0.5)});
}

}  // namespace fastlio
