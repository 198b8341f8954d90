// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/worlds/sampled_motion.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kSpacing = 1e-4;  // of the knots [s]

/** Lagrange's polynomials over the knots 0 to 5, at x. */
std::array<double, 6> weightsAt(double x)
{
  constexpr std::array<double, 6> kInverse{-1.0 / 120.0, 1.0 / 24.0,  -1.0 / 12.0,
                                           1.0 / 12.0,   -1.0 / 24.0, 1.0 / 120.0};
  std::array<double, 6> weights = kInverse;
  double before = 1.0, behind = 1.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    weights[i] *= before;
    before *= x - static_cast<double>(i);
    const std::size_t j = weights.size() - 1 - i;
    weights[j] *= behind;
    behind *= x - static_cast<double>(j);
  }
  return weights;
}
}  // namespace

Pose SampledMotion::at(double t)
{
  constexpr double kBefore = 2.0;  // knots before the interval of t
  const double knot = t / kSpacing;
  const double interval = std::floor(knot);
  moveTo(static_cast<std::int64_t>(interval - kBefore));
  const auto weights = weightsAt(knot - interval + kBefore);
  Pose pose{Mat3::Zero(), Vec3::Zero()};
  for (std::size_t i = 0; i < kKnots; ++i)
  {
    pose.R += weights[i] * knots_[i].R;
    pose.p += weights[i] * knots_[i].p;
  }
  return pose;
}

void SampledMotion::moveTo(std::int64_t first)
{
  constexpr auto kCount = static_cast<std::int64_t>(kKnots);
  const bool some_are_known = first_ && first >= *first_ && first - *first_ < kCount;
  const std::int64_t moved = some_are_known ? first - *first_ : kCount;
  std::rotate(knots_.begin(), knots_.begin() + moved, knots_.end());
  for (std::int64_t i = kCount - moved; i < kCount; ++i)
    knots_[static_cast<std::size_t>(i)] = motion_->pose(static_cast<double>(first + i) * kSpacing);
  first_ = first;
}

}  // namespace fastlio
