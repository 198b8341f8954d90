// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rides.h Properties of long ways for tests: the parts that are passed again, the places that look alike.
 */
#pragma once

#include "short_simulation.h"
#include <fastlio/math/angles.h>

#include <cmath>
#include <vector>

namespace fastlio::testing
{
/** A scenario at its own length, with hardly any shots. */
inline SimulationSettings wholeRide(std::string_view scenario)
{
  return shortSettings(scenario, 0.0, 10000);
}

/** Metres of a ride that come within reach of an earlier part of it, by the difference of headings.
 */
struct Revisits
{
  double same = 0.0, opposite = 0.0;
};

inline Revisits revisitsOf(const Simulation& simulation, double reach)
{
  constexpr double kStep = 0.25, kApart = 30.0, kAlike = 0.4;  // [s], [s], [rad]
  std::vector<Pose> poses;
  for (double t = 0.0; t < simulation.settings().duration; t += kStep)
    poses.push_back(simulation.motion().pose(t));
  Revisits revisits;
  for (std::size_t i = 1; i < poses.size(); ++i)
  {
    const double way = (poses[i].p - poses[i - 1].p).norm();
    bool same = false, opposite = false;
    for (std::size_t j = 0; static_cast<double>(i - j) * kStep > kApart && j < i; ++j)
    {
      if ((poses[i].p - poses[j].p).norm() > reach) continue;
      const double along = poses[i].R.col(0).dot(poses[j].R.col(0));
      same = same || along > std::cos(kAlike);
      opposite = opposite || along < -std::cos(kAlike);
    }
    revisits.same += same ? way : 0.0;
    revisits.opposite += opposite ? way : 0.0;
  }
  return revisits;
}

/** When the way first leads through a surface or closer than 0.2 m to one ahead [s]; negative:
 * never.
 */
inline double firstCollision(const Simulation& simulation)
{
  constexpr double kStep = 0.05, kClearance = 0.2;
  const Motion& motion = simulation.motion();
  for (double t = simulation.settings().rest; t < simulation.settings().duration; t += kStep)
  {
    const Vec3 here = motion.pose(t).p, there = motion.pose(t + kStep).p;
    const double step = (there - here).norm();
    if (step < 1e-6) continue;
    const Ray ahead{here, (there - here) / step};
    if (simulation.world().cast(ahead, t, step + kClearance)) return t;
  }
  return -1.0;
}

/** Ranges all around a place, slightly upwards [m]; reach where there is nothing. */
inline std::vector<double> viewFrom(const World& world, const Pose& pose, double reach)
{
  constexpr int kRays = 144;
  std::vector<double> ranges;
  for (int i = 0; i < kRays; ++i)
  {
    const double angle = (i + 0.5) * kTwoPi / kRays;
    const Vec3 level = Vec3(std::cos(angle), std::sin(angle), 0.02).normalized();
    const auto hit = world.cast({pose.p, pose.R * level}, 0.0, reach);
    ranges.push_back(hit ? hit->range : reach);
  }
  return ranges;
}

/** Fraction of directions in which two views have the same range within a tolerance [m]. */
inline double fractionAlike(
    const std::vector<double>& a, const std::vector<double>& b, double tolerance)
{
  double alike = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    alike += std::abs(a[i] - b[i]) < tolerance ? 1.0 : 0.0;
  return alike / static_cast<double>(a.size());
}

}  // namespace fastlio::testing
