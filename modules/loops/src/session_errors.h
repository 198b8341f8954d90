// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file session_errors.h Errors that all measurements of a session have in common, because its sensors are
 * off by the same in every scan (internal). A pose graph estimates them with the poses:
 *
 * - drift: the odometry measures (rotation [rad/m], translation [m/m]) too much on its way,
 * - bias of the accelerometer, over gravity,
 * - beams: see ScanResult::pose_by_beams,
 * - inertial: matrices of gyro and accelerometer, see ScanResult::pose_by_calibration.
 *
 * The extrinsic is not among them: submaps are in the frame of the LiDAR, with the extrinsic in
 * use. So closures agree, also between sessions of different rigs. Gravity is turned in each
 * session by the error of its extrinsic, which looks like a bias of its accelerometer as long as
 * the platform stays upright. What the error makes of the poses of the IMU is added in the end
 * (extrinsicCovariance()). */
#pragma once

#include <fastlio/posegraph/pose_graph.h>
#include <fastlio/submaps/submap.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace fastlio
{
/** Covariance of the errors before the graph shows them. \param latest knows most of the
 * calibration */
[[nodiscard]] Eigen::MatrixXd sessionErrorCovariance(const Submap& latest);

/** The covariance of a motion as the graph takes it. An odometry that is lost says so in ever
 * larger numbers, which would only cost the graph its digits: any attitude and 1 km say the same.
 */
[[nodiscard]] Matrix6 boundedCovariance(const Matrix6& covariance);

/** The motion between the references of submaps that follow each other, numbers \a a and a + 1.
 * Where the odometry was lost between them, it depends on no errors: it is linear in none. */
[[nodiscard]] GraphEdge odometryEdge(const Submap& earlier, const Submap& later, std::size_t a);

/** Gravity in a submap that has a reading of it. */
[[nodiscard]] TiltFactor tiltOf(const Submap& submap, std::size_t node);

/** What the odometry's covariance does not contain when motions follow each other: from submap
 * number \a a to number \a b. */
[[nodiscard]] Matrix6 driftCovariance(
    const std::vector<Submap>& submaps, std::size_t a, std::size_t b);

/** Covariance of the motion of the odometry from \a a to \a b by errors of the inertial sensor, as
 * \a b knows them. */
[[nodiscard]] Matrix6 inertialCovariance(const Submap& a, const Submap& b);

}  // namespace fastlio
