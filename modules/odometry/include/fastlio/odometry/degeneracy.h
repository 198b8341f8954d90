// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file degeneracy.h Which motions a scan does not constrain: along a tunnel, across an open
 * field, in front of one wall. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/lidar/deskew.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/odometry/point_to_plane.h>

#include <vector>

namespace fastlio
{
/** The information of a scan by direction of its pose, all lengths: rotations are multiplied by the
 * lever arm that the scan's points have on average. Directions by growing information. */
struct ScanConstraints
{
  double lever_arm = 1.0;                       //!< of rotations [m]
  Matrix6 directions = Matrix6::Identity();     //!< columns: (rotation * lever_arm, translation)
  Vector6 information = Vector6::Zero();        //!< along each direction [1/m^2]
  Vector6 noise_information = Vector6::Zero();  //!< what noisy normals alone make of it [1/m^2]
  int unconstrained = 0;                        //!< number of directions that are left alone
  Matrix6 projection = Matrix6::Identity();     //!< of a scan pose step on the constrained ones
};

/** Information that appears where there is none, because the normals of the map are noisy: the sum
 * of w_j cov(h_j), the rows' covariance for the normals' variance. A wall of a tunnel that is known
 * to a degree seems to tell where along the tunnel one is. Of the points [first, last); the parts
 * of a scan add up. */
[[nodiscard]] Matrix6 normalNoiseInformation(
    const Pose& T_world_scan, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const ResidualModel& model, std::size_t first, std::size_t last);

/** Analyses the information of a scan: a direction is unconstrained where the information is less
 * than \a min_signal_to_noise times that of the noise, or none at all. \param information the sum
 * of w h h^T \param noise_information from normalNoiseInformation() */
[[nodiscard]] ScanConstraints scanConstraints(
    const Matrix6& information, const Matrix6& noise_information, double min_signal_to_noise);

/** True when some direction has so much less information than the best one that it is worth the
 * while to look for noise in it. */
[[nodiscard]] bool mayBeDegenerate(const Matrix6& information);

/** The unconstrained directions as plain motions, each by its larger part. */
[[nodiscard]] std::vector<MotionDirection> unconstrainedMotions(const ScanConstraints& constraints);

/** The sums with the unconstrained directions taken out: what is left moves the others only. */
[[nodiscard]] InformationSums constrainedSums(
    const InformationSums& sums, const ScanConstraints& constraints);

}  // namespace fastlio
