// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/health/velocity_changes.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
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
      changes_.add(
          interval.by_scans - last_->by_scans, last_->gain - last_->mean_gain + interval.mean_gain);
    last_ = interval;
  }
  last_position_ = position;
}

void VelocityChanges::restart()
{
  last_position_.reset();
  last_.reset();
}

/** Linear regression: the accelerometer's noise is small beside that of the scans. A wrong tilt
 * adds the same to all changes, which their means take out. */
std::optional<RangeScale> VelocityChanges::scale() const
{
  if (!changes_.enough()) return std::nullopt;
  const double product = changes_.products().trace();
  const double inertial = changes_.inertialSquares();
  if (!(inertial > 3.0 * changes_.count() * kLeastChange * kLeastChange)) return std::nullopt;
  RangeScale scale;
  scale.scale = product / inertial;
  const double left_over = changes_.scanSquares() - scale.scale * product;
  const double variance = std::max(0.0, left_over) / (3.0 * changes_.count());
  scale.std = std::sqrt(variance / inertial);
  return scale;
}

}  // namespace fastlio
