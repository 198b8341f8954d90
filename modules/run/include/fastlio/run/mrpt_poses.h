// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mrpt_poses.h Poses with covariances as MRPT's distributions. */
#pragma once

#include <fastlio/run/pose_track.h>

#include <mrpt/math/CMatrixFixed.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPosePDFGaussian.h>

namespace fastlio
{
/** The covariance in MRPT's order (x, y, z, yaw, pitch, roll), position as it is, the attitude
 * error of the body frame as errors of the three angles, to first order. Where the pitch is +-90
 * deg these angles are not defined; there the pitch counts as 0.06 deg less.
 * \param covariance (attitude in the body frame [rad], position in the frame of the pose [m]) */
[[nodiscard]] mrpt::math::CMatrixDouble66 mrptCovariance(
    const Pose& pose, const Matrix6& covariance);

[[nodiscard]] mrpt::poses::CPose3DPDFGaussian toMrptPdf(
    const Pose& pose, const Matrix6& covariance);

/** The pose on the ground: x, y and yaw of MRPT's angles. */
[[nodiscard]] mrpt::poses::CPose2D onGround(const Pose& pose);

/** The motion on the ground between the ground poses of \a a and \a b, with the covariance of the
 * 3D motion. */
[[nodiscard]] mrpt::poses::CPosePDFGaussian motionOnGround(
    const TrackedPose& a, const TrackedPose& b);

}  // namespace fastlio
