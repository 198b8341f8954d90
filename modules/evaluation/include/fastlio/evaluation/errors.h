// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file errors.h Error measures of an aligned trajectory: absolute, relative, per segment, end to
 * end.
 *
 * Q is the reference, P the aligned estimate, both at common stamps. Sources: Sturm et al., IROS
 * 2012 (APE, there called ATE, and RPE); Geiger et al., CVPR 2012 (segments).
 */
#pragma once

#include <fastlio/evaluation/statistics.h>
#include <fastlio/evaluation/trajectory.h>

#include <optional>

namespace fastlio
{
/** Reference and estimate in one world frame at common stamps: as many poses in each. */
struct AlignedTrajectories
{
  std::vector<StampedPose> reference;
  std::vector<StampedPose> estimate;
};

/** Error of one pose: Q^-1 P. */
struct PoseError
{
  double translation = 0.0;  //!< [m]
  double rotation = 0.0;     //!< [rad]
};

/** Absolute error of every pose, E_i = Q_i^-1 P_i. */
[[nodiscard]] std::vector<PoseError> absoluteErrors(const AlignedTrajectories& t);

/** Error of the motion from pose i to pose j: (Q_i^-1 Q_j)^-1 (P_i^-1 P_j). */
[[nodiscard]] PoseError relativeError(const AlignedTrajectories& t, std::size_t i, std::size_t j);

/** Statistics of translation and rotation errors; units as the errors they were made of. */
struct PoseErrorStatistics
{
  ErrorStatistics translation;
  ErrorStatistics rotation;
};

[[nodiscard]] PoseErrorStatistics summarize(const std::vector<PoseError>& errors);

/** Relative errors from every pose to the first pose at least \a delta [s] later, each divided by
 * the time between both [m/s, rad/s]. Empty when the trajectory is shorter. */
[[nodiscard]] std::vector<PoseError> relativeErrorsPerSecond(
    const AlignedTrajectories& t, double delta);

/** Relative errors from every pose to the first pose at least \a delta [m] farther along the
 * reference's path, each divided by the path between both [m/m, rad/m]. */
[[nodiscard]] std::vector<PoseError> relativeErrorsPerMetre(
    const AlignedTrajectories& t, double delta);

/** Mean relative error over all segments of one length, divided by the length. */
struct SegmentError
{
  double length = 0.0;       //!< along the reference's path [m]
  std::size_t count = 0;     //!< segments: one from each pose from which one fits
  double translation = 0.0;  //!< [m/m]
  double rotation = 0.0;     //!< [rad/m]
};

/** One row per length that fits into the path, in the order given. */
[[nodiscard]] std::vector<SegmentError> segmentErrors(
    const AlignedTrajectories& t, const std::vector<double>& lengths);

/** Mean over the segments of all rows (each segment counts once), length 0; nothing without rows.
 */
[[nodiscard]] std::optional<SegmentError> averageOf(const std::vector<SegmentError>& rows);

/** Error of the motion from the first to the last pose. */
struct EndToEndDrift
{
  PoseError error;           //!< [m], [rad]
  double path_length = 0.0;  //!< of the reference at the common stamps [m]

  /** Translation error / path length; nothing when the reference does not move. */
  [[nodiscard]] std::optional<double> ratio() const;
};

[[nodiscard]] EndToEndDrift endToEndDrift(const AlignedTrajectories& t);

}  // namespace fastlio
