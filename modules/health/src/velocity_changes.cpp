// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/health/velocity_changes.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kFewestChanges = 90.0;
// Of the sums, per change: about the last minute counts.
constexpr double kForgettingChanges = 0.998;
// Weak directions of a scan would drown the rest [m].
constexpr double kKnownPositionStd = 0.01;
// Smaller changes, root mean square per axis, are mostly bias and tilt [m/s].
constexpr double kLeastChange = 0.02;
}  // namespace

void VelocityChanges::add(
    const NavState& before, double seconds, const NavState& predicted, const Vec3& position,
    double std)
{
  if (!(std < kKnownPositionStd) || !(seconds > 0.0)) return restart();
  if (last_position_)
  {
    Interval interval;
    interval.by_scans = (position - *last_position_) / seconds;
    interval.mean_gain = (predicted.p - before.p) / seconds - before.v;
    interval.gain = predicted.v - before.v;
    if (last_)
    {
      const Vec3 scans = interval.by_scans - last_->by_scans;
      const Vec3 inertial = last_->gain - last_->mean_gain + interval.mean_gain;
      product_ = kForgettingChanges * product_ + scans.dot(inertial);
      inertial_squares_ = kForgettingChanges * inertial_squares_ + inertial.squaredNorm();
      scan_squares_ = kForgettingChanges * scan_squares_ + scans.squaredNorm();
      inertial_sum_ = kForgettingChanges * inertial_sum_ + inertial;
      scan_sum_ = kForgettingChanges * scan_sum_ + scans;
      changes_ = kForgettingChanges * changes_ + 1.0;
    }
    last_ = interval;
  }
  last_position_ = position;
}

void VelocityChanges::restart()
{
  last_position_.reset();
  last_.reset();
}

/** Linear regression: the accelerometer's noise is small beside that of the scans. Without the
 * means, which a wrong tilt adds to. */
std::optional<RangeScale> VelocityChanges::scale() const
{
  if (changes_ < kFewestChanges) return std::nullopt;
  const double n = changes_;
  const double product = product_ - inertial_sum_.dot(scan_sum_) / n;
  const double inertial = inertial_squares_ - inertial_sum_.squaredNorm() / n;
  const double scans = scan_squares_ - scan_sum_.squaredNorm() / n;
  if (!(inertial > 3.0 * n * kLeastChange * kLeastChange)) return std::nullopt;
  RangeScale scale;
  scale.scale = product / inertial;
  const double variance = std::max(0.0, scans - scale.scale * product) / (3.0 * n);
  scale.std = std::sqrt(variance / inertial);
  return scale;
}

}  // namespace fastlio
