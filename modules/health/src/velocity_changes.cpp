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
// A scan that leaves the inertial motion by more found another place, or fits badly [m].
constexpr double kLargestDeparture = 2.0 * kKnownPositionStd;
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
    interval.by_inertia = gained_ + (predicted.p - before.p) / seconds - before.v;
    gained_ += predicted.v - before.v;
    const Interval& last = ring_[(intervals_ + ring_.size() - 1) % ring_.size()];
    const Vec3 departure =
        seconds * (interval.by_scans - last.by_scans - interval.by_inertia + last.by_inertia);
    if (intervals_ > 0 && !(departure.norm() < kLargestDeparture)) return restart();
    ring_[intervals_++ % ring_.size()] = interval;
    if (intervals_ >= ring_.size())
    {
      const Interval found = change();
      changes_.add(found.by_scans, found.by_inertia);
    }
  }
  last_position_ = position;
}

void VelocityChanges::restart()
{
  last_position_.reset();
  intervals_ = 0;
  gained_.setZero();
}

VelocityChanges::Interval VelocityChanges::change() const
{
  Interval sum;
  for (std::size_t i = 0; i < ring_.size(); ++i)
  {
    const Interval& interval = ring_[(intervals_ + i) % ring_.size()];  // the oldest first
    const double sign = i < kHalf ? -1.0 : 1.0;
    sum.by_scans += sign * interval.by_scans;
    sum.by_inertia += sign * interval.by_inertia;
  }
  constexpr auto kCount = static_cast<double>(kHalf);
  return {sum.by_scans / kCount, sum.by_inertia / kCount};
}

/** Linear regression. A wrong tilt adds the same to all changes, which their means take out. */
std::optional<RangeScale> VelocityChanges::scale() const
{
  if (!changes_.enough()) return std::nullopt;
  const double product = changes_.products().trace();
  const double scans = changes_.scanSquares(), inertial = changes_.inertialSquares();
  if (!(inertial > 3.0 * changes_.count() * kLeastChange * kLeastChange)) return std::nullopt;
  if (!(product > PairedVectors::kLeastCorrelation * std::sqrt(scans * inertial)))
    return std::nullopt;
  RangeScale scale;
  scale.scale = product / inertial;
  const double left_over = scans - scale.scale * product;
  // Neighbouring changes share all intervals but two: so many times fewer of them are independent.
  constexpr auto kShared = static_cast<double>(kHalf);
  const double variance = kShared * std::max(0.0, left_over) / (3.0 * changes_.count());
  scale.std = std::sqrt(variance / inertial);
  return scale;
}

}  // namespace fastlio
