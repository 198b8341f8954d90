// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gates.h Limits that a report must keep, for automated tests. */
#pragma once

#include <fastlio/evaluation/evaluate.h>

namespace fastlio
{
/** Units as users write them. Absent: not checked. */
struct GateLimits
{
  std::optional<double> max_ape;               //!< APE translation RMSE [m]
  std::optional<double> max_ape_rotation;      //!< APE rotation RMSE [deg]
  std::optional<double> max_rpe;               //!< RPE translation RMSE [m/s]
  std::optional<double> max_rpe_rotation;      //!< RPE rotation RMSE [deg/s]
  std::optional<double> max_segment_percent;   //!< mean segment error [%]
  std::optional<double> max_drift;             //!< end-to-end drift [m]
  std::optional<double> max_drift_percent;     //!< end-to-end drift [% of the path]
  std::optional<double> max_nees;              //!< mean NEES of the pose (6 when consistent)
  std::optional<double> max_nees_position;     //!< mean NEES of the position (3 when consistent)
  std::optional<double> max_nees_rotation;     //!< mean NEES of the rotation (3 when consistent)
  std::optional<double> min_coverage_percent;  //!< fraction of the reference's time span [%]
};

/** One limit and what was measured. */
struct GateResult
{
  std::string name;  //!< as the option of the program, without dashes in front: "max-ape"
  std::string unit;
  double limit = 0.0;
  double measured = 0.0;
  bool passed = false;
};

/** The limits that are set, in the order above. A measure that is not a number fails.
 * \exception std::invalid_argument a limit is set on something that the report does not have; the
 * message says what is missing */
[[nodiscard]] std::vector<GateResult> checkGates(
    const EvaluationReport& report, const GateLimits& limits);

}  // namespace fastlio
