// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/matching/match_evidence.h>

namespace fastlio
{
double inlierRatio(std::size_t inliers, std::size_t points)
{
  return points > 0 ? static_cast<double>(inliers) / static_cast<double>(points) : 0.0;
}

double inlierRatio(const ScanStatistics& s, std::size_t points)
{
  return inlierRatio(s.points_effective, points);
}

bool matchesAsUsual(const ScanStatistics& statistics, std::size_t points)
{
  return inlierRatio(statistics, points) >= kMinUsualFraction * statistics.usual_inlier_ratio;
}

}  // namespace fastlio
