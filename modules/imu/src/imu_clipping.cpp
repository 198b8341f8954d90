// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_clipping.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kAtRange = 0.999;  // of a full scale that is known
constexpr double kEqual = 1.0 - 1e-7;
constexpr int kRepeats = 3;  // readings in a row at the extreme: no chance
}  // namespace

double ClippingDetector::add(const Vec3& reading)
{
  before_ = latest_;
  latest_ = clippedRange(reading);
  return latest_;
}

double ClippingDetector::clippedRange(const Vec3& reading)
{
  if (range_ > 0.0) return reading.cwiseAbs().maxCoeff() >= kAtRange * range_ ? range_ : 0.0;
  double clipped = 0.0;
  for (std::size_t i = 0; i < axes_.size(); ++i)
  {
    Axis& axis = axes_[i];
    const double value = std::abs(reading[static_cast<Eigen::Index>(i)]);
    const bool at_extreme = value >= kEqual * axis.extreme;
    axis.repeats = !at_extreme ? 0 : value * kEqual > axis.extreme ? 1 : axis.repeats + 1;
    axis.extreme = std::max(axis.extreme, value);
    if (axis.repeats >= kRepeats && axis.extreme > floor_)
      clipped = std::max(clipped, axis.extreme);
  }
  return clipped;
}

}  // namespace fastlio
