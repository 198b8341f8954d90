// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file association.h Which reference pose belongs to which estimated pose: by time. */
#pragma once

#include <fastlio/evaluation/trajectory.h>

#include <cstddef>

namespace fastlio
{
struct AssociationOptions
{
  double max_gap = 0.1;      //!< the reference is not interpolated across longer gaps [s]
  double time_offset = 0.0;  //!< added to the estimate's stamps [s]
};

/** The fate of the estimated poses. */
struct AssociationCounts
{
  std::size_t estimated = 0;  //!< poses of the estimate
  std::size_t used = 0;       //!< with a reference pose
  std::size_t before = 0;     //!< older than the reference
  std::size_t after = 0;      //!< newer than the reference
  std::size_t in_gap = 0;     //!< inside a gap of the reference
  /** Fraction of the reference's time span between the first and the last used, without holes of
   * the estimate: steps above a second and ten times its median step. */
  double coverage = 0.0;
  double longest_hole = 0.0;  //!< of them [s]; 0: there is none
};

/** Both trajectories at common stamps. */
struct AssociatedTrajectories
{
  std::vector<StampedPose> estimate;   //!< stamps on the reference's clock
  std::vector<StampedPose> reference;  //!< interpolated at the same stamps
  std::vector<Matrix6> covariances;    //!< of the estimate: one per pose, or empty
  AssociationCounts counts;
};

/** The pose at a stamp between two poses: linear in position, geodesic (slerp) in rotation. */
[[nodiscard]] Pose interpolate(const StampedPose& a, const StampedPose& b, std::int64_t stamp_ns);

/** Samples the reference at the stamps of the estimate. It is never extrapolated, and not
 * interpolated across gaps above AssociationOptions::max_gap. \exception std::invalid_argument an
 * invalid trajectory, or fewer than two common stamps; the message prints both time ranges and the
 * counts */
[[nodiscard]] AssociatedTrajectories associate(
    const Trajectory& estimate, const Trajectory& reference, const AssociationOptions& options);

}  // namespace fastlio
