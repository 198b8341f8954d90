// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "view_grid.h"
#include <fastlio/files/failure_text.h>
#include <fastlio/report/report_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

namespace fastlio
{
namespace
{
constexpr double kFarthestPose = 1e8;     // [m]: nothing is there
constexpr std::size_t kSample = 20000;    // points that determine the extent
constexpr double kLowestView = 110.0;     // [px]
constexpr double kSmallPath = 1.0 / 3.0;  // of the view: the path gets a view of its own

/** Some points of the map, at even distances. */
struct MapSample
{
  std::array<std::vector<float>, 3> xyz;
};

MapSample sampleOf(const OutputMap& map)
{
  MapSample sample;
  const std::size_t stride = std::max<std::size_t>(1, map.size() / kSample);
  std::size_t index = 0;
  map.forEachTile(
      [&](const OutputPoints& points)
      {
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          if (index++ % stride != 0) continue;
          sample.xyz[0].push_back(points.x[i]);
          sample.xyz[1].push_back(points.y[i]);
          sample.xyz[2].push_back(points.z[i]);
        }
      });
  for (auto& values : sample.xyz)
    std::sort(values.begin(), values.end());
  return sample;
}

/** Nearly all points, and the lines as a whole: a few echoes from afar do not decide. */
PlotRange rangeOf(const std::vector<float>& sorted, const MapOverlay& overlay, int axis)
{
  constexpr double kLeftOut = 0.005;
  PlotRange range{1e300, -1e300};
  if (!sorted.empty())
  {
    const auto last = static_cast<double>(sorted.size() - 1);
    range.low = static_cast<double>(sorted[static_cast<std::size_t>(kLeftOut * last)]);
    range.high = static_cast<double>(sorted[static_cast<std::size_t>((1.0 - kLeftOut) * last)]);
  }
  for (const MapLine& line : overlay.lines)
    for (const Vec3& p : line.points)
    {
      if (!p.allFinite()) continue;
      range.low = std::min(range.low, p[axis]);
      range.high = std::max(range.high, p[axis]);
    }
  if (range.low > range.high) return {0.0, 1.0};
  const double margin = std::max(0.03 * (range.high - range.low), 0.5);
  return {range.low - margin, range.high + margin};
}

double spanOf(const PlotRange& range)
{
  return range.high - range.low;
}

PlotRange widened(const PlotRange& range, double span)
{
  const double more = 0.5 * std::max(0.0, span - spanOf(range));
  return {range.low - more, range.high + more};
}

/** A view of the lines alone, where they are small beside the map. */
std::optional<ViewGrid> closeGrid(const MapOverlay& overlay, const ViewGrid& top)
{
  constexpr double kMargin = 1.3;  // room around
  constexpr double kLeast = 2.0;   // [m]
  const PlotRange x = rangeOf({}, overlay, 0), y = rangeOf({}, overlay, 1);
  const double view = std::max(spanOf(top.across()), spanOf(top.up()));
  const bool has_path = std::any_of(
      overlay.lines.begin(), overlay.lines.end(),
      [](const MapLine& line)
      {
        return std::any_of(
            line.points.begin(), line.points.end(), [](const Vec3& p) { return p.allFinite(); });
      });
  if (!has_path || std::max(spanOf(x), spanOf(y)) > kSmallPath * view) return {};
  // As high as other views may be: the surroundings fill what the path leaves.
  const double across =
      std::max({kLeast, kMargin * spanOf(x), kMargin * spanOf(y) * kViewWidth / kViewHeight});
  // So near, points are farther apart than cells of the usual size.
  constexpr double kPixelsPerCloseCell = 2.0 * kPixelsPerCell;
  return ViewGrid(
      widened(x, across), widened(y, across * kViewHeight / kViewWidth), 1.0, kPixelsPerCloseCell);
}

/** How many times as long heights have to be drawn so that they can be read: 1, 2, 5, 10, ... */
double stretchOf(const PlotRange& across, const PlotRange& up)
{
  double power = 1.0;
  const double height = kViewWidth * spanOf(up) / spanOf(across);
  for (int i = 0; i < 4; ++i, power *= 10.0)
    for (const double step : {1.0, 2.0, 5.0})
      if (power * step * height >= kLowestView) return power * step;
  return power;
}

PlotPanel viewOf(
    const ViewGrid& grid, const MapOverlay& overlay, int across, int up, const PlotRange& heights)
{
  PlotPanel panel;
  panel.equal_scales = true;
  panel.x_range = grid.across();
  panel.y_range = grid.up();
  panel.y_stretch = grid.stretch();
  panel.cells = grid.cells(heights);
  for (const MapLine& line : overlay.lines)
  {
    PlotSeries& drawn =
        panel.series.emplace_back(PlotSeries{line.name, line.colour, {}, line.width});
    for (const Vec3& p : line.points)
      drawn.points.push_back({p[across], p[up]});
  }
  for (const MapMark& mark : overlay.marks)
    panel.marks.push_back({{mark.at[across], mark.at[up]}, mark.name, mark.colour});
  constexpr std::array<const char*, 3> kAxes = {"x [m]", "y [m]", "z [m]"};
  panel.x_label = kAxes.at(static_cast<std::size_t>(across));
  panel.y_label = kAxes.at(static_cast<std::size_t>(up));
  return panel;
}

/** Counted from the origin of the map. */
MapOverlay relativeTo(const Vec3& origin, MapOverlay overlay)
{
  const auto take = [&origin](Vec3& p)
  {
    p -= origin;
    if (!(p.cwiseAbs().maxCoeff() < kFarthestPose)) p.setConstant(std::nan(""));
  };
  for (MapLine& line : overlay.lines)
    std::for_each(line.points.begin(), line.points.end(), take);
  for (MapMark& mark : overlay.marks)
    take(mark.at);
  return overlay;
}

/** Short bars along the translations that scans left open. */
PlotSeries openBars(const ReportSeries& series, const Vec3& origin, const PlotRange& across)
{
  constexpr double kBar = 0.02;          // of the view
  constexpr std::size_t kMostBars = 40;  // more of them hide the path
  const double length = kBar * spanOf(across);
  const double gap = std::nan("");
  PlotSeries bars{"degenerate direction", "var(--warn)", {}, 2.5};
  std::vector<ReportBin> open;
  for (const ReportBin& bin : series.bins())
    if (bin.open_axis && bin.position) open.push_back(bin);
  const std::size_t stride = (open.size() + kMostBars - 1) / kMostBars;
  for (std::size_t i = 0; i < open.size(); i += stride)
  {
    const ReportBin& bin = open[i];
    const Vec3 p = *bin.position - origin, d = length * *bin.open_axis;
    for (const Vec3& end : {Vec3(p - d), Vec3(p + d)})
      bars.points.push_back({end.x(), end.y()});
    bars.points.push_back({gap, gap});
  }
  return bars;
}

/** The heights that get colours. */
PlotRange heightsOf(const std::vector<float>& sorted)
{
  if (sorted.empty()) return {};
  const std::size_t last = sorted.size() - 1;
  return {static_cast<double>(sorted[last / 50]), static_cast<double>(sorted[last - last / 50])};
}

struct Grids
{
  ViewGrid top, side;
  std::optional<ViewGrid> close;
};

void fillGrids(Grids& grids, const OutputMap& map, bool side_along_x)
{
  map.forEachTile(
      [&](const OutputPoints& points)
      {
        for (std::size_t i = 0; i < points.size(); ++i)
        {
          const auto x = static_cast<double>(points.x[i]), y = static_cast<double>(points.y[i]),
                     z = static_cast<double>(points.z[i]);
          grids.top.add(x, y, z);
          grids.side.add(side_along_x ? x : y, z, z);
          if (grids.close) grids.close->add(x, y, z);
        }
      });
}

/** Runs a step that reads the map. \return why it could not be read, or nothing */
template <typename Step>
std::string problemOf(const Step& step)
{
  try
  {
    step();
    return {};
  }
  catch (const std::exception& e)
  {
    return failureText(e);  // a piece on the disk that cannot be read
  }
}

}  // namespace

PlotRectangle placeOf(const PlotPanel& view)
{
  constexpr double kWidth = 480.0, kMargin = 50.0;
  const double up = view.y_stretch * spanOf(*view.y_range);
  const double height =
      std::clamp(kViewWidth * up / spanOf(*view.x_range), kLowestView, kViewHeight);
  return {0.0, 0.0, kWidth, std::round(kMargin + height)};
}

MapViews mapViewsOf(const MapOverlay& overlay, const OutputMap& map)
{
  MapViews views;
  const MapOverlay drawn = relativeTo(map.origin(), overlay);
  MapSample sample;
  views.problem = problemOf([&] { sample = sampleOf(map); });
  const PlotRange x = rangeOf(sample.xyz[0], drawn, 0), y = rangeOf(sample.xyz[1], drawn, 1),
                  z = rangeOf(sample.xyz[2], drawn, 2);
  const bool along_x = spanOf(x) >= spanOf(y);
  const PlotRange& along = along_x ? x : y;
  Grids grids{{x, y}, {along, z, stretchOf(along, z)}, {}};
  grids.close = closeGrid(drawn, grids.top);
  if (views.problem.empty()) views.problem = problemOf([&] { fillGrids(grids, map, along_x); });
  const PlotRange heights = heightsOf(sample.xyz[2]);
  views.top = viewOf(grids.top, drawn, 0, 1, heights);
  views.side = viewOf(grids.side, drawn, along_x ? 0 : 1, 2, heights);
  if (grids.close) views.close = viewOf(*grids.close, drawn, 0, 1, heights);
  views.side_axis = along_x ? "x" : "y";
  views.lowest = heights.low;
  views.highest = heights.high;
  views.points = map.size();
  return views;
}

MapViews mapViewsOf(
    const ReportSeries& series, const std::vector<UntrustedStretch>& untrusted,
    const OutputMap& map)
{
  constexpr double kWide = 3.0;  // it covers the path [px]
  const std::vector<Vec3> path = series.path(), unreliable = series.pathWithin(untrusted);
  MapOverlay overlay;
  overlay.lines = {{"path", "var(--path)", path}};
  if (!unreliable.empty())
    overlay.lines.push_back({"not to rely on", "var(--untrusted)", unreliable, kWide});
  if (!path.empty()) overlay.marks = {{"start", "var(--path)", path.front()}};
  MapViews views = mapViewsOf(overlay, map);
  views.top.series.push_back(openBars(series, map.origin(), *views.top.x_range));
  if (views.close)
    views.close->series.push_back(openBars(series, map.origin(), *views.close->x_range));
  return views;
}

}  // namespace fastlio
