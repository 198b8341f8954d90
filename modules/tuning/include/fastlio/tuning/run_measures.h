// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_measures.h Measures of the error of a run, without ground truth. */
#pragma once

#include <fastlio/tuning/run_outcome.h>

#include <string>

namespace fastlio
{
/** Measures of the run in a folder, from its timing.csv and states.csv:
 *
 * - `slip` [m/s]: how far positions move against the integral of the velocities. Positions follow
 *   the scans at once, velocities the inertial samples: where noise, clocks or the map are wrong,
 *   the corrections of successive scans have one direction, and the two part. RMS over spans of
 *   half a second, so that white corrections cancel.
 * - `position_std` [m]: mean standard deviation of the position. The run reports it itself; it is
 *   wider where innovations are larger than the noise model says.
 * - `proxy` [m^2/s]: slip * position_std. The slip shows errors that the covariance does not know
 *   of; the covariance counts errors that do not show, as of few points or degenerate directions.
 * - `residual` [m], `inliers`: RMS of the residuals, points that were matched by all.
 * - `duration` [s]: from the first to the last state. A run that starts late or ends early has less
 *   to err in.
 *
 * A run with too few scans has no slip and no proxy.
 * \exception std::exception a file cannot be read; the message names it */
[[nodiscard]] Measures measuresOfRun(const std::string& folder);

}  // namespace fastlio
