// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "gap_distortion.h"

#include <cmath>
#include <cstddef>

namespace fastlio
{
// The rotation in a gap grows towards the scan's begin, so its mean square is a third.
double deskewStd(const DeskewedScan& scan, const ScanPrediction& predicted)
{
  const BodyPoints& points = scan.surfaces;
  if (predicted.gap_rotation_std == 0.0 || points.size() == 0) return 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    squares += static_cast<double>(
        points.x[i] * points.x[i] + points.y[i] * points.y[i] + points.z[i] * points.z[i]);
  const double lever = std::sqrt(squares / static_cast<double>(points.size()));
  return predicted.gap_rotation_std / std::sqrt(3.0) * lever;
}

// The distortion is no normal error: within a gap of imu.max_gap it may be several times as large.
constexpr double kWorstFit = 5.0;

bool fitsAsDistorted(const MatchResult& match, const DeskewedScan& scan)
{
  const double weight = match.model.weight;
  const auto points = static_cast<double>(scan.surfaces.size());
  const double expected = 1.0 + (1.0 / weight - 1.0) / points;
  return normalizedInnovation(match.update) / weight <= kWorstFit * expected;
}
}  // namespace fastlio
