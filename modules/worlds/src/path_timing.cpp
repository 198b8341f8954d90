// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "path_timing.h"

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
/** Speeds that keep the acceleration across the path, from the bend over a metre and a half. */
std::vector<double> speedsInBends(const std::vector<Vec3>& p, const Route& route)
{
  constexpr std::size_t kReach = 15;
  const std::size_t n = p.size();
  std::vector<double> speeds;
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vec3 before = p[i] - p[(i + n - kReach) % n], after = p[(i + kReach) % n] - p[i];
    const double turn = std::atan2(
        std::abs(before.x() * after.y() - before.y() * after.x()),
        before.head<2>().dot(after.head<2>()));
    const double bend = turn / std::max(0.5 * (before.norm() + after.norm()), 1e-9);
    speeds.push_back(std::min(route.speed, std::sqrt(route.acceleration / std::max(bend, 1e-9))));
  }
  return speeds;
}

/** Lowers speeds until each can be reached from the one before (ahead) or lets the vehicle brake to
 * the one after it (not ahead). */
void limitChange(
    std::vector<double>& speeds, const std::vector<Vec3>& p, double acceleration, bool ahead)
{
  const std::size_t n = p.size();
  for (std::size_t k = 0; k < 2 * n; ++k)  // twice around, as the loop has no first point
  {
    const std::size_t from = ahead ? k % n : n - 1 - k % n;
    const std::size_t to = ahead ? (from + 1) % n : (from + n - 1) % n;
    const double gain = 2.0 * acceleration * (p[to] - p[from]).norm();
    speeds[to] = std::min(speeds[to], std::sqrt(speeds[from] * speeds[from] + gain));
  }
}
}  // namespace

std::vector<double> timesAlong(const std::vector<Vec3>& p, const Route& route)
{
  std::vector<double> speeds = speedsInBends(p, route);
  limitChange(speeds, p, route.acceleration, true);
  limitChange(speeds, p, route.acceleration, false);
  std::vector<double> times{0.0};
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    const std::size_t next = (i + 1) % p.size();
    times.push_back(times.back() + 2.0 * (p[next] - p[i]).norm() / (speeds[i] + speeds[next]));
  }
  return times;
}

}  // namespace fastlio
