// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "plot_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastlio
{
namespace
{
/** Empty: low is above high. */
constexpr PlotRange kNothing{
    std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};

void extend(PlotRange& r, double value)
{
  if (!std::isfinite(value)) return;
  r.low = std::min(r.low, value);
  r.high = std::max(r.high, value);
}

PlotRange withSpan(const PlotRange& r, double span)
{
  const double centre = 0.5 * (r.low + r.high);
  return {centre - 0.5 * span, centre + 0.5 * span};
}

/** Some room around the data; an axis on which nothing moves gets a span as well. */
PlotRange padded(const PlotRange& r)
{
  constexpr double kPadding = 1.1;
  if (!(r.high >= r.low)) return {0.0, 1.0};
  const double least = 1e-6 * std::max(1.0, 0.5 * std::abs(r.low + r.high));
  return withSpan(r, std::max(kPadding * (r.high - r.low), least));
}

struct Extent
{
  PlotRange x = kNothing, y = kNothing;

  void add(double px, double py)
  {
    extend(x, px);
    extend(y, py);
  }
};

Extent extentOf(const PlotPanel& panel)
{
  Extent extent;
  for (const PlotSeries& series : panel.series)
    for (const PlotPoint& point : series.points)
      extent.add(point.x, point.y);
  for (const PlotBand& band : panel.bands)
    for (const PlotInterval& interval : band.intervals)
    {
      extent.add(interval.x, interval.low);
      extent.add(interval.x, interval.high);
    }
  for (const PlotCells& cells : panel.cells)
    for (const PlotPoint& centre : cells.centres)
      extent.add(centre.x, centre.y);
  for (const PlotMark& mark : panel.marks)
    extent.add(mark.at.x, mark.at.y);
  if (panel.from_zero) extend(extent.y, 0.0);
  return extent;
}
}  // namespace

PlotAxes axesOf(const PlotPanel& panel, const PlotRectangle& inner)
{
  const Extent extent = extentOf(panel);
  PlotAxes axes{padded(extent.x), padded(extent.y), inner};
  if (panel.from_zero) axes.y.low = 0.0;
  if (panel.x_range) axes.x = *panel.x_range;
  if (panel.y_range) axes.y = *panel.y_range;
  if (!panel.equal_scales) return axes;
  const double unit = std::max(
      (axes.x.high - axes.x.low) / inner.width,
      panel.y_stretch * (axes.y.high - axes.y.low) / inner.height);
  return {
      withSpan(axes.x, unit * inner.width), withSpan(axes.y, unit * inner.height / panel.y_stretch),
      inner};
}

}  // namespace fastlio
