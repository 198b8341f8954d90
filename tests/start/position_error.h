// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file position_error.h How far a run is from the truth as seen from its first pose. */
#pragma once

#include "simulated_run.h"

namespace fastlio::testing
{
/** RMS distance of the positions, the first poses aligned [m]. */
inline double positionError(const SimulatedRun& run)
{
  EvaluationOptions options;
  options.alignment = Alignment::First;
  return evaluate(estimateOf(run), truthOf(run), options).ape.translation.rmse;
}
}  // namespace fastlio::testing
