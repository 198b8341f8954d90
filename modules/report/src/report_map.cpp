// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

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
constexpr std::array<const char*, 7> kHeightColours = {"#3b6fd4", "#2aa0c9", "#2fa86f", "#8fb53a",
                                                       "#d9a91f", "#e8832b", "#d3452c"};
// The more points a cell holds, the more of it is seen: walls stand out from floors.
constexpr std::array<double, 3> kOpacities = {0.35, 0.65, 1.0};
constexpr double kPixelsPerCell = 2.5;
constexpr double kInnerWidth = 400.0, kInnerHeight = 340.0;  // [px], about
constexpr double kFarthestPose = 1e8;                        // [m]: nothing is there
constexpr std::size_t kSample = 20000;                       // points that determine the extent

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

/** Nearly all points and the whole path: a few echoes from afar do not decide. */
PlotRange rangeOf(const std::vector<float>& sorted, const std::vector<Vec3>& path, int axis)
{
  constexpr double kLeftOut = 0.005;
  PlotRange range{1e300, -1e300};
  if (!sorted.empty())
  {
    const auto last = static_cast<double>(sorted.size() - 1);
    range.low = static_cast<double>(sorted[static_cast<std::size_t>(kLeftOut * last)]);
    range.high = static_cast<double>(sorted[static_cast<std::size_t>((1.0 - kLeftOut) * last)]);
  }
  for (const Vec3& p : path)
  {
    if (!p.allFinite()) continue;
    range.low = std::min(range.low, p[axis]);
    range.high = std::max(range.high, p[axis]);
  }
  if (range.low > range.high) return {0.0, 1.0};
  const double margin = std::max(0.03 * (range.high - range.low), 0.5);
  return {range.low - margin, range.high + margin};
}

/** Cells of one view, row by row: their number is that of the view's pixels, whatever the map. */
struct ViewGrid
{
  struct Cell
  {
    double height = 0.0;  //!< sum
    std::size_t count = 0;
  };

  PlotRange x, y;
  double size;  //!< edge of a cell [m]
  std::size_t columns;
  std::vector<Cell> cells;

  ViewGrid(const PlotRange& across, const PlotRange& up)
      : x(across),
        y(up),
        size(
            kPixelsPerCell *
            std::max((x.high - x.low) / kInnerWidth, (y.high - y.low) / kInnerHeight)),
        columns(indexOf(x.high - x.low) + 1),
        cells(columns * (indexOf(y.high - y.low) + 1))
  {
  }

  [[nodiscard]] std::size_t indexOf(double distance) const
  {
    return static_cast<std::size_t>(distance / size);
  }

  void add(double across, double up, double height)
  {
    if (!(across >= x.low && across <= x.high && up >= y.low && up <= y.high)) return;
    Cell& cell = cells[indexOf(up - y.low) * columns + indexOf(across - x.low)];
    cell.height += height;
    ++cell.count;
  }

  [[nodiscard]] PlotPoint centreOf(std::size_t cell) const
  {
    const std::size_t row = cell / columns, column = cell % columns;
    return {
        x.low + (static_cast<double>(column) + 0.5) * size,
        y.low + (static_cast<double>(row) + 0.5) * size};
  }
};

std::size_t classOf(double value, double low, double high, std::size_t classes)
{
  if (!(high > low)) return 0;
  const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return std::min(classes - 1, static_cast<std::size_t>(share * static_cast<double>(classes)));
}

/** Counts that two fifths and four fifths of the cells do not exceed. */
std::array<std::size_t, 2> crowdLimits(const ViewGrid& grid)
{
  std::vector<std::size_t> counts;
  for (const ViewGrid::Cell& cell : grid.cells)
    if (cell.count > 0) counts.push_back(cell.count);
  if (counts.empty()) return {};
  std::sort(counts.begin(), counts.end());
  return {counts[2 * (counts.size() - 1) / 5], counts[4 * (counts.size() - 1) / 5]};
}

std::vector<PlotCells> cellsOfView(const ViewGrid& grid, const PlotRange& heights)
{
  const auto limits = crowdLimits(grid);
  std::vector<PlotCells> groups;
  for (const char* colour : kHeightColours)
    for (const double opacity : kOpacities)
      groups.push_back({colour, opacity, grid.size, {}});
  for (std::size_t i = 0; i < grid.cells.size(); ++i)
  {
    const ViewGrid::Cell& cell = grid.cells[i];
    if (cell.count == 0) continue;
    const double height = cell.height / static_cast<double>(cell.count);
    const std::size_t colour = classOf(height, heights.low, heights.high, kHeightColours.size());
    const std::size_t crowd = cell.count > limits[1] ? 2 : cell.count > limits[0] ? 1 : 0;
    groups[colour * kOpacities.size() + crowd].centres.push_back(grid.centreOf(i));
  }
  return groups;
}

PlotPanel viewOf(const ViewGrid& grid, const std::vector<Vec3>& path, int across, int up)
{
  PlotPanel panel;
  panel.bare = panel.equal_scales = true;
  panel.x_range = grid.x;
  panel.y_range = grid.y;
  PlotSeries line{"path", "var(--path)", {}, 2.0};
  for (const Vec3& p : path)
    line.points.push_back({p[across], p[up]});
  panel.series = {line};
  if (path.empty()) return panel;
  panel.marks = {{line.points.front(), "start", "var(--path)"}};
  return panel;
}

/** Short bars along the translations that scans left open. */
PlotSeries openBars(const ReportSeries& series, const Vec3& origin, const ViewGrid& grid)
{
  constexpr double kBar = 0.02;          // of the view
  constexpr std::size_t kMostBars = 40;  // more of them hide the path
  const double length = kBar * (grid.x.high - grid.x.low);
  const double gap = std::nan("");
  PlotSeries bars{"degenerate direction", "var(--warn)", {}, 2.5};
  std::vector<ReportBin> open;
  for (const ReportBin& bin : series.bins())
    if (bin.open_axis) open.push_back(bin);
  const std::size_t stride = (open.size() + kMostBars - 1) / kMostBars;
  for (std::size_t i = 0; i < open.size(); i += stride)
  {
    const ReportBin& bin = open[i];
    const Vec3 p = bin.position - origin, d = length * *bin.open_axis;
    for (const Vec3& end : {Vec3(p - d), Vec3(p + d)})
      bars.points.push_back({end.x(), end.y()});
    bars.points.push_back({gap, gap});
  }
  return bars;
}

std::vector<Vec3> relativePath(const ReportSeries& series, const Vec3& origin)
{
  std::vector<Vec3> path;
  for (const Vec3& p : series.path())
    path.emplace_back(
        (p - origin).cwiseAbs().maxCoeff() < kFarthestPose ? Vec3(p - origin)
                                                           : Vec3::Constant(std::nan("")));
  return path;
}

/** The heights that get colours. */
PlotRange heightsOf(const std::vector<float>& sorted)
{
  if (sorted.empty()) return {};
  const std::size_t last = sorted.size() - 1;
  return {static_cast<double>(sorted[last / 50]), static_cast<double>(sorted[last - last / 50])};
}

struct BothGrids
{
  ViewGrid top, side;
};

void fillGrids(BothGrids& grids, const OutputMap& map, bool side_along_x)
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

void nameAxes(MapViews& views)
{
  views.top.x_label = "x [m]";
  views.top.y_label = "y [m]";
  views.side.x_label = views.side_axis + " [m]";
  views.side.y_label = "z [m]";
}
}  // namespace

PlotRectangle placeOf(const PlotPanel& view)
{
  constexpr double kWidth = 480.0, kMargin = 50.0, kLowest = 110.0;
  const double up = view.y_range->high - view.y_range->low;
  const double across = view.x_range->high - view.x_range->low;
  const double height = std::clamp(kInnerWidth * up / across, kLowest, kInnerHeight);
  return {0.0, 0.0, kWidth, std::round(kMargin + height)};
}

MapViews mapViewsOf(const ReportSeries& series, const OutputMap& map)
{
  MapViews views;
  const std::vector<Vec3> path = relativePath(series, map.origin());
  MapSample sample;
  views.problem = problemOf([&] { sample = sampleOf(map); });
  const PlotRange x = rangeOf(sample.xyz[0], path, 0), y = rangeOf(sample.xyz[1], path, 1),
                  z = rangeOf(sample.xyz[2], path, 2);
  const bool along_x = x.high - x.low >= y.high - y.low;
  BothGrids grids{{x, y}, {along_x ? x : y, z}};
  if (views.problem.empty()) views.problem = problemOf([&] { fillGrids(grids, map, along_x); });
  const PlotRange heights = heightsOf(sample.xyz[2]);
  views.top = viewOf(grids.top, path, 0, 1);
  views.side = viewOf(grids.side, path, along_x ? 0 : 1, 2);
  views.top.cells = cellsOfView(grids.top, heights);
  views.side.cells = cellsOfView(grids.side, heights);
  views.top.series.push_back(openBars(series, map.origin(), grids.top));
  views.side_axis = along_x ? "x" : "y";
  nameAxes(views);
  views.lowest = heights.low;
  views.highest = heights.high;
  views.points = map.size();
  views.height_colours.assign(kHeightColours.begin(), kHeightColours.end());
  return views;
}

}  // namespace fastlio
