// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_pose.h Where the points of a scan are, as a function of the whole state.
 *
 * A scan of surfaces constrains only a rigid pose: that of its compensated points in the
 * world. Body pose, extrinsic and time offset act on that pose only, so measurements are summed in
 * its six coordinates (see InformationSums) and the state comes in through the Jacobian of the
 * pose. */
#pragma once

#include <fastlio/filter/state.h>

namespace fastlio
{
/** d (attitude in the scan's own frame, position in the world) / d (error state). */
using ScanPoseJacobian = Eigen::Matrix<double, 6, kStateDim, Eigen::DontAlign>;

/** [I_6, 0]: the scan pose is the body pose, eq. 14. */
[[nodiscard]] ScanPoseJacobian bodyPoseJacobian();

/** How the points were brought to the body frame, before the update moves the calibration. */
struct CompensatedWith
{
  Pose extrinsic_correction;         //!< C_0
  double time_offset = 0.0;          //!< tau_0 [s]
  Vec3 angular_rate = Vec3::Zero();  //!< of the body during the scan, IMU frame [rad/s]
  bool moves = true;                 //!< else the velocity is taken for zero
};

/** The pose that takes the compensated points to the world: with C and tau the iterate's,
 *
 *     T_world_imu  M(tau - tau_0)  C C_0^-1,
 *
 * M being the body's motion at the scan's end over the change of the time offset. */
[[nodiscard]] Pose scanPose(const NavState& x, const CompensatedWith& compensation);

/** Its derivative at x; bodyPoseJacobian() where x has the calibration that the points were
 * compensated with, but for the columns of the calibration. */
[[nodiscard]] ScanPoseJacobian scanPoseJacobian(
    const NavState& x, const CompensatedWith& compensation);

/** The change of the state, per second of the time offset, that leaves the scan pose where it is:
 * B times it is zero. A scan that was matched with an offset that is wrong put the body where it
 * was by as much earlier or later, so attitude and position are wrong along with the offset. */
[[nodiscard]] StateVector hiddenByTimeOffset(
    const NavState& x, const CompensatedWith& compensation);

/** Covariance of the scan pose, B P B^T. Body pose and calibration are often known much worse, each
 * for itself, than where together they put the scan. */
[[nodiscard]] Matrix6 scanPoseCovariance(const FilterState& s, const CompensatedWith& compensation);

}  // namespace fastlio
