// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "file_points.h"

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kNear = 1e4;  // single precision has steps of 1 mm there [m]
constexpr double kStep = 1e3;  // origins are round numbers [m]
}  // namespace

bool FilePoints::usable(const std::array<double, 3>& p)
{
  return std::all_of(
      p.begin(), p.end(), [](double c) { return std::abs(c) <= kFarthestPoint; });  // not for NaN
}

void FilePoints::add(const std::array<double, 3>& p)
{
  if (!placed_ && usable(p))
  {
    placed_ = true;
    const Vec3 first(p[0], p[1], p[2]);
    // Plus zero: no -0 in messages.
    if (first.cwiseAbs().maxCoeff() > kNear) origin = kStep * (first / kStep).array().round() + 0.0;
  }
  points.add(Vec3(p[0], p[1], p[2]) - origin);
}

}  // namespace fastlio
