// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/survey/lidar_look.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::size_t kStride = 7;  // coprime to the usual numbers of lines
constexpr std::size_t kMostLines = 256;

double quantile(std::vector<float> values, double fraction)
{
  if (values.empty()) return 0.0;
  const auto index = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(index)]);
}
}  // namespace

void LidarLook::add(const PointColumns& points)
{
  if (points.size() == 0) return;
  ++scans_;
  points_ += points.size();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    rings_.insert(points.ring[i]);
    if (i % kStride != 0) continue;
    const double x = points.x[i], y = points.y[i], z = points.z[i];
    const double flat = std::hypot(x, y);
    ranges_.push_back(static_cast<float>(std::hypot(flat, z)));
    elevations_.push_back(static_cast<float>(std::atan2(z, flat) * kDegPerRad));
    const double turns = std::atan2(y, x) / kTwoPi;
    const auto sector = static_cast<std::size_t>((turns - std::floor(turns)) * kSectors);
    sectors_.at(std::min(sector, kSectors - 1)) = true;
  }
}

double LidarLook::pointsPerScan() const
{
  return scans_ == 0 ? 0.0 : static_cast<double>(points_) / static_cast<double>(scans_);
}

int LidarLook::lines() const
{
  return rings_.size() > 1 && rings_.size() <= kMostLines ? static_cast<int>(rings_.size()) : 0;
}

double LidarLook::lowest() const
{
  return quantile(elevations_, 0.01);
}

double LidarLook::highest() const
{
  return quantile(elevations_, 0.99);
}

double LidarLook::coverage() const
{
  return static_cast<double>(std::count(sectors_.begin(), sectors_.end(), true)) / kSectors;
}

double LidarLook::rangeQuantile(double fraction) const
{
  return quantile(ranges_, fraction);
}

}  // namespace fastlio
