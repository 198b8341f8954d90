// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/run/pose_track.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
// About 1 mrad for each metre; single precision holds these errors exactly.
constexpr double kTurnByBeams = 1.0 / 1024.0;

/** A vehicle that a constant error of the sensor turns. */
TrackedPose turnedByBeams(double way)
{
  TrackedPose pose;
  pose.T_world_body.p.x() = way;
  const Vec3 phi(0.0, 0.0, kTurnByBeams * way);
  Vector6 error;
  error << phi, skew(phi) * pose.T_world_body.p;
  pose.map_covariance = pose.covariance = error * error.transpose();
  pose.pose_by_beams.col(0) = error.cast<float>();
  return pose;
}

// The difference of the covariances would grow with the way: 199 mrad^2 for the last metre of 100.
TEST(RelativePose, ErrorsOfTheBeamsAreTheSameForEveryMetre)
{
  for (const double way : {0.0, 1.0, 99.0})
  {
    const RelativePose metre = relativePose(turnedByBeams(way), turnedByBeams(way + 1.0));
    EXPECT_NEAR(metre.covariance(2, 2), kTurnByBeams * kTurnByBeams, 1e-12) << way;
  }
}

// A motion of the world moves all poses, so that no motion between them is wrong; what is more, is.
TEST(RelativePose, ErrorsOfTheCalibrationAreThoseOfTheMotion)
{
  const Pose a{expSO3({0.1, -0.2, 0.5}), {1.0, 2.0, 3.0}};
  const Pose b{expSO3({-0.1, 0.1, 1.5}), {5.0, 1.0, 2.0}};
  const Vec3 turn(0.01, 0.02, -0.03), way(0.1, 0.2, 0.3), step(0.05, -0.02, 0.04);
  PoseByCalibrationErrors of_a = PoseByCalibrationErrors::Zero(), of_b = of_a;
  // Attitude errors in the frame of the body, position errors in the world.
  of_a.col(7) << (a.R.transpose() * turn).cast<float>(), (way + turn.cross(a.p)).cast<float>();
  of_b.col(7) << (b.R.transpose() * turn).cast<float>(), (way + turn.cross(b.p)).cast<float>();
  EXPECT_LT(motionByCalibration(of_a, a, of_b, b).norm(), 1e-6);
  of_b.col(7).tail<3>() += step.cast<float>();
  const MotionByCalibration motion = motionByCalibration(of_a, a, of_b, b);
  EXPECT_LT((motion.col(7).tail<3>() - a.R.transpose() * step).norm(), 1e-6);
  EXPECT_NEAR(motion.norm(), step.norm(), 1e-6);
}

// The same turn of the world, at two poses 5 km from its origin: their motion has no error. Errors
// of the poses are stored in single precision.
TEST(RelativePose, HasNoErrorOfTheBeamsThatBothShareFarFromTheOrigin)
{
  const Vec3 phi(1e-3, -2e-3, 3e-3);
  const auto turned = [&](const Vec3& place)
  {
    TrackedPose pose;
    pose.T_world_body.p = place;
    Vector6 error;
    error << phi, Vec3(0.1, 0.2, 0.3) + skew(phi) * (place - Vec3(5000.0, 0.0, 0.0));
    pose.map_covariance = pose.covariance = error * error.transpose();
    pose.pose_by_beams.col(3) = error.cast<float>();
    return pose;
  };
  const RelativePose motion = relativePose(turned({5000.0, 0.0, 0.0}), turned({5003.0, 4.0, 0.0}));
  EXPECT_LT(motion.covariance.diagonal().tail<3>().sum(), 1e-7);  // [m^2]
}

}  // namespace
}  // namespace fastlio
