// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/matching/match_evidence.h>

namespace fastlio
{
namespace
{
// Of the points where the map has a plane. Nine of ten are usual; at a wrong pose nearly all scans
// have less than four.
constexpr double kFittingPart = 0.5;
}  // namespace

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

bool fitsWhatIsMapped(const ScanStatistics& s)
{
  return s.points_effective > 0 && s.normalized_innovation <= kMaxInnovation &&
         inlierRatio(s, s.points_mapped) >= kFittingPart;
}

}  // namespace fastlio
