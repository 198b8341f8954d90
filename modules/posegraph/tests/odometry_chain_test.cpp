// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/so3.h>
#include <fastlio/posegraph/odometry_chain.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
/** A straight road of 100 m. */
void drive(OdometryChain& chain, double noise)
{
  RelativePose motion;
  motion.T_a_b.p = Vec3::UnitX();
  motion.covariance = noise * noise * Matrix6::Identity();
  for (int metre = 0; metre < 100; ++metre)
    chain.advance(motion, Matrix6::Identity());
}
}  // namespace

TEST(OdometryChain, NoiseAddsUpAsARandomWalk)
{
  OdometryChain chain(Pose{}, Matrix6::Zero(), Vector6::Zero(), Matrix6::Zero());
  drive(chain, 1e-3);
  EXPECT_NEAR(chain.pose().p.x(), 100.0, 1e-9);
  EXPECT_NEAR(std::sqrt(chain.covariance()(3, 3)), 0.01, 1e-6);
  // Heights by the attitude: sum of squares of the ways that are left.
  EXPECT_NEAR(std::sqrt(chain.covariance()(5, 5)), 1e-3 * std::sqrt(328350.0 + 100.0), 1e-6);
}

TEST(OdometryChain, ADriftThatIsNotKnownBendsTheRoad)
{
  constexpr double kDrift = 1e-4;  // [rad/m]
  Matrix6 covariance = Matrix6::Zero();
  covariance(1, 1) = kDrift * kDrift;
  OdometryChain unknown(Pose{}, Matrix6::Zero(), Vector6::Zero(), covariance);
  drive(unknown, 0.0);
  EXPECT_NEAR(unknown.pose().p.z(), 0.0, 1e-12);
  // One standard deviation of the drift, when it is known, moves the end by one of the end's.
  Vector6 drift = Vector6::Zero();
  drift[1] = kDrift;
  OdometryChain known(Pose{}, Matrix6::Zero(), drift, Matrix6::Zero());
  drive(known, 0.0);
  EXPECT_NEAR(known.pose().p.z(), std::sqrt(unknown.covariance()(5, 5)), 2e-3);
  EXPECT_NEAR(known.pose().p.z(), 0.5 * kDrift * 100.0 * 100.0, 0.01);
  EXPECT_EQ(known.covariance()(5, 5), 0.0);
}

}  // namespace fastlio
