// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/laser_widths.h>
#include <fastlio/math/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace fastlio
{
namespace
{
constexpr int kScans = 5;
// Every so many-th point is looked at: a prime, or some lasers of a column would never be.
constexpr std::size_t kStride = 7;
constexpr std::size_t kLeastPoints = 3;  // fewer do not show whether their elevations agree
constexpr std::size_t kLeastLasers = 4;
// Larger numbers are not those of lasers.
constexpr std::size_t kMostLasers = 1024;
// Of the mean distance between lasers: one that scatters more has no elevation of its own.
constexpr double kMostScatter = 0.5;
// A laser that stands for so many times as much as usual. Tolerances of the maker stay far below,
// and so do the cosine of the elevation and neighbours that see nothing.
constexpr double kUneven = 3.0;
// Lasers may share an elevation: each of them sees something all the same.
constexpr double kLeastWidth = 0.25;

/** A laser with enough points. */
struct KnownLaser
{
  double sine = 0.0;     // of its elevation
  double scatter = 0.0;  // standard deviation
  std::size_t ring = 0;
};

/** Lasers whose points wander over the elevations of others have none. */
bool haveElevations(const std::vector<KnownLaser>& lasers)
{
  std::vector<double> scatter;
  scatter.reserve(lasers.size());
  for (const KnownLaser& laser : lasers)
    scatter.push_back(laser.scatter);
  const double range = lasers.back().sine - lasers.front().sine;
  return median(std::move(scatter)) <=
         kMostScatter * range / static_cast<double>(lasers.size() - 1);
}

/** Many sensors number their lasers from one end to the other. */
bool areNumberedInOrder(const std::vector<KnownLaser>& lasers)
{
  const auto rises = [](const KnownLaser& a, const KnownLaser& b) { return a.ring < b.ring; };
  return std::is_sorted(lasers.begin(), lasers.end(), rises) ||
         std::is_sorted(lasers.rbegin(), lasers.rend(), rises);
}

/** Between neighbours, as far as their numbers say also of those that have seen nothing.
 * \param lasers by elevation */
std::vector<double> gapsOf(const std::vector<KnownLaser>& lasers)
{
  const bool in_order = areNumberedInOrder(lasers);
  std::vector<double> gaps(lasers.size() - 1);
  for (std::size_t i = 0; i < gaps.size(); ++i)
  {
    const auto [lower, upper] = std::minmax(lasers[i].ring, lasers[i + 1].ring);
    const auto steps = static_cast<double>(in_order ? upper - lower : 1);
    gaps[i] = (lasers[i + 1].sine - lasers[i].sine) / steps;
  }
  return gaps;
}

/** Halfway to the neighbours on both sides; the outermost lasers have one. */
std::vector<double> widthsOf(const std::vector<double>& gaps)
{
  std::vector<double> widths{gaps.front()};
  for (std::size_t i = 1; i < gaps.size(); ++i)
    widths.push_back(0.5 * (gaps[i - 1] + gaps[i]));
  widths.push_back(gaps.back());
  return widths;
}
}  // namespace

void LaserWidths::learn(const PointColumns& points)
{
  if (scans_ == kScans || points.size() == 0) return;
  ++scans_;
  for (std::size_t i = 0; i < points.size(); i += kStride)
  {
    const std::size_t ring = points.ring[i];
    const double x = points.x[i], y = points.y[i], z = points.z[i];
    const double sine = z / std::sqrt(x * x + y * y + z * z);
    if (ring >= kMostLasers || !std::isfinite(sine)) continue;
    if (ring >= lasers_.size()) lasers_.resize(ring + 1);
    Laser& laser = lasers_[ring];
    laser.sum += sine;
    laser.squares += sine * sine;
    ++laser.count;
  }
  update();
}

void LaserWidths::update()
{
  relative_.clear();
  std::vector<KnownLaser> known;
  for (std::size_t ring = 0; ring < lasers_.size(); ++ring)
  {
    const Laser& laser = lasers_[ring];
    if (laser.count < kLeastPoints) continue;
    const auto n = static_cast<double>(laser.count);
    const double mean = laser.sum / n;
    known.push_back({mean, std::sqrt(std::max(0.0, laser.squares / n - mean * mean)), ring});
  }
  if (known.size() < kLeastLasers) return;
  std::sort(
      known.begin(), known.end(),
      [](const KnownLaser& a, const KnownLaser& b) { return a.sine < b.sine; });
  if (!haveElevations(known)) return;

  std::vector<double> widths = widthsOf(gapsOf(known));
  const double usual = median(widths);
  if (!(usual > 0.0)) return;  // most of them share an elevation
  if (!(*std::max_element(widths.begin(), widths.end()) > kUneven * usual)) return;
  for (double& width : widths)
    width = std::max(width, kLeastWidth * usual);
  const double mean =
      std::accumulate(widths.begin(), widths.end(), 0.0) / static_cast<double>(known.size());
  relative_.assign(lasers_.size(), 1.0F);
  for (std::size_t i = 0; i < known.size(); ++i)
    relative_[known[i].ring] = static_cast<float>(widths[i] / mean);
}

}  // namespace fastlio
