// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file evaluate.h Everything there is to say about an estimated trajectory, given the truth.
 *
 * \code
 * const auto report = fastlio::evaluate(
 *     fastlio::readTum("trajectory.tum"), fastlio::readTum("ground_truth.tum"), {});
 * EXPECT_LT(report.ape.translation.rmse, 0.05);
 * \endcode
 */
#pragma once

#include <fastlio/evaluation/alignment.h>
#include <fastlio/evaluation/consistency.h>
#include <fastlio/evaluation/errors.h>

namespace fastlio
{
struct EvaluationOptions
{
  AssociationOptions association;
  Alignment alignment = Alignment::Se3;
  NeesAlignment nees_alignment = NeesAlignment::First;
  double rpe_seconds = 1.0;  //!< span of the relative error per second [s]
  double rpe_metres = 1.0;   //!< span of the relative error per metre [m]
  /** Lengths of the segments [m]; those that do not fit into the path are left out. */
  std::vector<double> segment_lengths = {5, 10, 25, 50, 100, 200, 300, 400, 500, 600, 700, 800};
};

/** Units: m, rad, s. Errors are of the aligned estimate, so that only APE depends on the choice of
 * the alignment (and the rest on the scale of Sim3). */
struct EvaluationReport
{
  EvaluationOptions options;
  std::string estimate_source, reference_source;
  AssociationCounts association;
  double duration = 0.0;  //!< from the first to the last common stamp [s]
  Similarity alignment;   //!< that was applied
  /** About a nearly straight path: the alignment may turn it by this much, see uncertainTurn(). */
  std::optional<double> uncertain_turn;
  AlignedTrajectories aligned;     //!< poses at the common stamps
  std::vector<PoseError> errors;   //!< absolute error of each of them
  PoseErrorStatistics ape;         //!< [m], [rad]
  PoseErrorStatistics rpe_second;  //!< [m/s], [rad/s]; count 0: the run is shorter than the span
  PoseErrorStatistics rpe_metre;   //!< [m/m], [rad/m]; count 0: likewise
  std::vector<SegmentError> segments;
  std::optional<SegmentError> segment_average;
  EndToEndDrift drift;
  std::vector<Deviation> deviations;  //!< of each of them, before that alignment (nees_alignment)
  std::optional<Consistency> nees;    //!< when the estimate has usable covariances
};

/** \exception std::invalid_argument invalid trajectories or options, no common time span, or
 * positions that do not determine the alignment */
[[nodiscard]] EvaluationReport evaluate(
    const Trajectory& estimate, const Trajectory& reference, const EvaluationOptions& options = {});

}  // namespace fastlio
