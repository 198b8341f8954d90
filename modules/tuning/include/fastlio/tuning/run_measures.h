// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_measures.h What a run tells about its own error, without ground truth. */
#pragma once

#include <fastlio/tuning/run_outcome.h>

#include <string>

namespace fastlio
{
/** Measures of the run in a folder, from timing.csv, states.csv and map.ply:
 *
 * | name | unit | |
 * |---|---|---|
 * | `thickness` | m | of the surfaces of the map: see mapThickness() |
 * | `volume` | - | cells that the map occupies: grows when it is blurred or doubled |
 * | `residual` | m | RMS of the residuals of matched points |
 * | `outliers` | - | points that were not matched, by all |
 * | `correction` | m/s | what a scan changes of the predicted motion: RMS of displacement by time
 * minus velocity |
 * | `bias` | - | movement of the biases from scan to scan |
 *
 * \exception std::exception a file cannot be read; the message names it */
[[nodiscard]] Measures measuresOfRun(const std::string& folder);

}  // namespace fastlio
