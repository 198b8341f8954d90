// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/feature_lines.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/columns.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
// Shots that follow each other within this angle may belong to one moving beam: cosine of 0.5 deg.
constexpr double kCosSameBeam = 0.999962;

Vec3 beamOf(const PointColumns& points, std::uint32_t i)
{
  return pointAt(points, i).normalized();
}

/** Sorts a range of indices by time, then by index; most sensors deliver them so. */
template <typename Iterator>
void sortByTime(const PointColumns& points, Iterator first, Iterator last)
{
  const auto earlier = [&](std::uint32_t a, std::uint32_t b)
  {
    const std::int32_t ta = points.time_offset_ns[a], tb = points.time_offset_ns[b];
    return ta != tb ? ta < tb : a < b;
  };
  if (!std::is_sorted(first, last, earlier)) std::sort(first, last, earlier);
}
}  // namespace

bool ScanLineSorter::haveRings(
    const PointColumns& points, const std::vector<std::uint32_t>& usable) const
{
  return std::any_of(
      usable.begin(), usable.end(),
      [&](std::uint32_t i) { return points.ring[i] != points.ring[usable.front()]; });
}

ScanLineOrder ScanLineSorter::chooseWithoutRings(
    const PointColumns& points, const std::vector<std::uint32_t>& usable)
{
  by_time_ = usable;
  sortByTime(points, by_time_.begin(), by_time_.end());
  std::size_t jumps = 0;
  for (std::size_t k = 1; k < by_time_.size(); ++k)
  {
    const std::uint32_t a = by_time_[k - 1], b = by_time_[k];
    const bool at_once = points.time_offset_ns[a] == points.time_offset_ns[b];
    if (at_once || beamOf(points, a).dot(beamOf(points, b)) < kCosSameBeam) ++jumps;
  }
  // The lasers of a spinning sensor fire at once or by turns, far apart; a single beam wanders.
  return 2 * jumps > by_time_.size() ? ScanLineOrder::Elevation : ScanLineOrder::Time;
}

void ScanLineSorter::labelByRing(
    const PointColumns& points, const std::vector<std::uint32_t>& usable)
{
  label_.resize(usable.size());
  for (std::size_t k = 0; k < usable.size(); ++k)
    label_[k] = points.ring[usable[k]];
}

void ScanLineSorter::labelByElevation(
    const PointColumns& points, const std::vector<std::uint32_t>& usable)
{
  label_.resize(usable.size());
  line_of_bin_.fill(0);
  for (std::size_t k = 0; k < usable.size(); ++k)
  {
    const double elevation = std::asin(std::clamp(beamOf(points, usable[k]).z(), -1.0, 1.0));
    const auto bin = static_cast<std::uint16_t>((elevation / kPi + 0.5) * kElevationBins);
    label_[k] = bin;
    line_of_bin_[bin] = 1;
  }
  // Bins side by side are one line: its elevation may fall on the border of two.
  std::uint16_t line = 0;
  for (std::size_t bin = 0; bin < line_of_bin_.size(); ++bin)
  {
    const bool occupied = line_of_bin_[bin] != 0;
    if (occupied && (bin == 0 || line_of_bin_[bin - 1] == 0)) ++line;
    if (occupied) line_of_bin_[bin] = line;
  }
  for (std::uint16_t& label : label_)
    label = line_of_bin_[label];
}

void ScanLineSorter::collect(
    const PointColumns& points, const std::vector<std::uint32_t>& usable, ScanLines& lines)
{
  const std::uint16_t last = *std::max_element(label_.begin(), label_.end());
  line_begin_.assign(last + std::size_t{2}, 0);
  for (const std::uint16_t label : label_)
    ++line_begin_[label + std::size_t{1}];
  for (std::size_t line = 1; line < line_begin_.size(); ++line)
  {
    if (line_begin_[line] > 0) lines.begin.push_back(line_begin_[line - 1] + line_begin_[line]);
    line_begin_[line] += line_begin_[line - 1];
  }
  lines.order.resize(usable.size());
  for (std::size_t k = 0; k < usable.size(); ++k)
    lines.order[line_begin_[label_[k]]++] = usable[k];
  for (std::size_t line = 0; line < lines.count(); ++line)
    sortByTime(
        points, lines.order.begin() + lines.begin[line],
        lines.order.begin() + lines.begin[line + 1]);
}

ScanLineOrder ScanLineSorter::sort(
    const PointColumns& points, const std::vector<std::uint32_t>& usable, ScanLineOrder order,
    ScanLines& lines)
{
  lines.order.clear();
  lines.begin.assign(1, 0);
  if (usable.empty()) return order;
  if (order == ScanLineOrder::Automatic)
    order = haveRings(points, usable) ? ScanLineOrder::Ring : chooseWithoutRings(points, usable);
  if (order == ScanLineOrder::Ring)
    labelByRing(points, usable);
  else if (order == ScanLineOrder::Elevation)
    labelByElevation(points, usable);
  else
    label_.assign(usable.size(), 0);
  collect(points, usable, lines);
  return order;
}

}  // namespace fastlio
