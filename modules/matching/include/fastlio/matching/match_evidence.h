// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file match_evidence.h Does a scan match the map as scans usually do? */
#pragma once

#include <fastlio/interface/scan_result.h>

#include <cstddef>

namespace fastlio
{
/** A scan in trouble has less than this fraction of the inlier ratio of the scans before it. */
inline constexpr double kMinUsualFraction = 0.2;
/** Largest mean of z^2/r without trouble: noise that is set too small makes 2, a wrong pose more.
 */
inline constexpr double kMaxInnovation = 3.0;

/** Points that matched a plane, of all that could have; 0 of none. */
[[nodiscard]] double inlierRatio(std::size_t inliers, std::size_t points);
[[nodiscard]] double inlierRatio(const ScanStatistics& statistics, std::size_t points);

/** The scan matches as those before it did: its inlier ratio is at least kMinUsualFraction of the
 * usual one. (Residuals alone are not enough: along a tunnel they grow although the pose is right
 * but for one direction.) \param points of the scan that could have matched */
[[nodiscard]] bool matchesAsUsual(const ScanStatistics& statistics, std::size_t points);

/** What the map has where the scan is fits the scan, however little that is. A sensor with a narrow
 * field of view that turns sees surroundings that are not in the map yet; at a wrong pose, the map
 * contradicts. */
[[nodiscard]] bool fitsWhatIsMapped(const ScanStatistics& statistics);

}  // namespace fastlio
