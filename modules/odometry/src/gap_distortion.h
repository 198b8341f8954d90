// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gap_distortion.h What missing inertial samples do to a scan. */
#pragma once

#include "scan_predictor.h"
#include <fastlio/matching/match_result.h>

namespace fastlio
{
/** A scan that is distorted more fits the map nowhere: matched where the prediction puts it, it
 * turns the state by degrees that are wrong [m]. */
inline constexpr double kMostDistortion = 0.05;

/** How far the points of a scan are from where they belong, all of them together [m]. */
[[nodiscard]] double deskewStd(const DeskewedScan& scan, const ScanPrediction& predicted);

/** A distorted scan has larger residuals, but not as large as it pleases. */
[[nodiscard]] bool fitsAsDistorted(const MatchResult& match, const DeskewedScan& scan);
}  // namespace fastlio
