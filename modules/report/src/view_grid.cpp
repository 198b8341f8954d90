// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "view_grid.h"

#include <algorithm>

namespace fastlio
{
namespace
{
// The more points a cell holds, the more of it is seen: walls stand out from floors.
constexpr std::array<double, 3> kOpacities = {0.35, 0.65, 1.0};

std::size_t indexOf(double distance, double size)
{
  return static_cast<std::size_t>(distance / size);
}

std::size_t classOf(double value, double low, double high, std::size_t classes)
{
  if (!(high > low)) return 0;
  const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return std::min(classes - 1, static_cast<std::size_t>(share * static_cast<double>(classes)));
}

}  // namespace

ViewGrid::ViewGrid(const PlotRange& across, const PlotRange& up, double stretch, double pixels)
    : x_(across),
      y_(up),
      stretch_(stretch),
      width_(
          pixels *
          std::max((x_.high - x_.low) / kViewWidth, stretch * (y_.high - y_.low) / kViewHeight)),
      height_(width_ / stretch),
      columns_(indexOf(x_.high - x_.low, width_) + 1),
      cells_(columns_ * (indexOf(y_.high - y_.low, height_) + 1))
{
}

void ViewGrid::add(double across, double up, double height)
{
  if (!(across >= x_.low && across <= x_.high && up >= y_.low && up <= y_.high)) return;
  Cell& cell = cells_[indexOf(up - y_.low, height_) * columns_ + indexOf(across - x_.low, width_)];
  cell.height += height;
  ++cell.count;
}

PlotPoint ViewGrid::centreOf(std::size_t cell) const
{
  const std::size_t row = cell / columns_, column = cell % columns_;
  return {
      x_.low + (static_cast<double>(column) + 0.5) * width_,
      y_.low + (static_cast<double>(row) + 0.5) * height_};
}

/** Counts that two fifths and four fifths of the cells do not exceed. */
std::array<std::size_t, 2> ViewGrid::crowdLimits() const
{
  std::vector<std::size_t> counts;
  for (const Cell& cell : cells_)
    if (cell.count > 0) counts.push_back(cell.count);
  if (counts.empty()) return {};
  std::sort(counts.begin(), counts.end());
  return {counts[2 * (counts.size() - 1) / 5], counts[4 * (counts.size() - 1) / 5]};
}

std::vector<PlotCells> ViewGrid::cells(const PlotRange& heights) const
{
  const auto limits = crowdLimits();
  std::vector<PlotCells> groups;
  for (const char* colour : kHeightColours)
    for (const double opacity : kOpacities)
      groups.push_back({colour, opacity, width_, {}, height_});
  for (std::size_t i = 0; i < cells_.size(); ++i)
  {
    const Cell& cell = cells_[i];
    if (cell.count == 0) continue;
    const double height = cell.height / static_cast<double>(cell.count);
    const std::size_t colour = classOf(height, heights.low, heights.high, kHeightColours.size());
    const std::size_t crowd = cell.count > limits[1] ? 2 : cell.count > limits[0] ? 1 : 0;
    groups[colour * kOpacities.size() + crowd].centres.push_back(centreOf(i));
  }
  return groups;
}

}  // namespace fastlio
