// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "plot_axes.h"
#include <fastlio/plot/svg_plot.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace fastlio
{
namespace
{
constexpr double kLeft = 62.0, kRight = 14.0, kBottom = 42.0;  // margins [px]
constexpr double kTop = 34.0, kBareTop = 8.0;
constexpr double kPixelsPerXTick = 70.0, kPixelsPerYTick = 28.0;

std::ostringstream classicStream()
{
  std::ostringstream out;
  out.imbue(std::locale::classic());
  return out;
}

/** A coordinate; a tenth of a pixel is finer than anybody sees. */
double pixel(double value)
{
  return std::round(10.0 * value) / 10.0;
}

std::string textAt(double x, double y, const std::string& content, const std::string& attributes)
{
  auto out = classicStream();
  out << "<text x='" << pixel(x) << "' y='" << pixel(y) << "' " << attributes << ">"
      << escapeXml(content) << "</text>\n";
  return out.str();
}

std::string gridLine(double x1, double y1, double x2, double y2)
{
  auto out = classicStream();
  out << "<line class='grid' x1='" << pixel(x1) << "' y1='" << pixel(y1) << "' x2='" << pixel(x2)
      << "' y2='" << pixel(y2) << "'/>\n";
  return out.str();
}

std::string gridOf(const PlotPanel& panel, const PlotAxes& a)
{
  const PlotRectangle& r = a.inner;
  const auto ticksOf = [](const std::vector<PlotTick>& given, const PlotRange& range, double room)
  { return given.empty() ? axisTicks(range, static_cast<int>(room)) : given; };
  std::string out;
  for (const PlotTick& tick : ticksOf(panel.x_ticks, a.x, r.width / kPixelsPerXTick))
    out += gridLine(a.px(tick.at), r.y, a.px(tick.at), r.y + r.height) +
           textAt(a.px(tick.at), r.y + r.height + 16.0, tick.text, "text-anchor='middle'");
  for (const PlotTick& tick : ticksOf(panel.y_ticks, a.y, r.height / kPixelsPerYTick))
    out += gridLine(r.x, a.py(tick.at), r.x + r.width, a.py(tick.at)) +
           textAt(r.x - 6.0, a.py(tick.at) + 4.0, tick.text, "text-anchor='end'");
  return out;
}

bool isFinite(const PlotPoint& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y);
}

std::string polylinesOf(const PlotSeries& series, const PlotAxes& axes)
{
  auto out = classicStream();
  bool open = false;
  for (const PlotPoint& point : series.points)
  {
    if (!isFinite(point))
    {
      if (open) out << "'/>\n";
      open = false;
      continue;
    }
    if (!open)
      out << "<polyline fill='none' stroke-width='" << series.width
          << "' style='stroke:" << series.colour << "' points='";
    open = true;
    out << pixel(axes.px(point.x)) << ',' << pixel(axes.py(point.y)) << ' ';
  }
  if (open) out << "'/>\n";
  return out.str();
}

/** One closed area per unbroken part. */
std::string polygonsOf(const PlotBand& band, const PlotAxes& axes)
{
  auto out = classicStream();
  auto back = classicStream();
  std::vector<std::string> lower;
  const auto close = [&]
  {
    if (lower.empty()) return;
    for (auto point = lower.rbegin(); point != lower.rend(); ++point)
      out << *point;
    out << "'/>\n";
    lower.clear();
  };
  for (const PlotInterval& i : band.intervals)
  {
    if (!isFinite({i.x, i.low}) || !std::isfinite(i.high))
    {
      close();
      continue;
    }
    if (lower.empty())
      out << "<polygon stroke='none' style='fill:" << band.colour << ";fill-opacity:0.18' points='";
    const double x = pixel(axes.px(i.x));
    out << x << ',' << pixel(axes.py(i.high)) << ' ';
    back.str({});
    back << x << ',' << pixel(axes.py(i.low)) << ' ';
    lower.push_back(back.str());
  }
  close();
  return out.str();
}

std::string stretchOf(const PlotStretch& stretch, const PlotAxes& axes)
{
  constexpr double kLeastWidth = 1.5;  // [px]: a single scan has to be seen
  const PlotRectangle& r = axes.inner;
  const auto inside = [&r](double x) { return std::clamp(x, r.x, r.x + r.width); };
  const double from = inside(axes.px(stretch.from));
  const double to = inside(std::max(axes.px(stretch.to), from + kLeastWidth));
  auto out = classicStream();
  out << "<rect x='" << pixel(from) << "' y='" << r.y << "' width='" << pixel(to - from)
      << "' height='" << r.height << "' style='fill:" << stretch.colour << ";fill-opacity:0.3'>"
      << "<title>" << escapeXml(stretch.title) << "</title></rect>\n";
  if (stretch.label.empty()) return out.str();
  return out.str() + textAt(from + 4.0, r.y + 14.0, stretch.label, "");
}

/** Cells of a row that touch become one stroke. */
std::string cellsOf(const PlotCells& cells, const PlotAxes& axes)
{
  if (cells.centres.empty() || !(cells.size > 0.0)) return {};
  std::vector<PlotPoint> centres;
  std::copy_if(cells.centres.begin(), cells.centres.end(), std::back_inserter(centres), isFinite);
  std::sort(
      centres.begin(), centres.end(),
      [](const PlotPoint& a, const PlotPoint& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  const double size = axes.px(axes.x.low + cells.size) - axes.inner.x;
  const double height = cells.height > 0.0 ? cells.height : cells.size;
  const double thickness = axes.py(axes.y.low) - axes.py(axes.y.low + height);
  auto out = classicStream();
  out << "<path fill='none' stroke-width='" << pixel(thickness + 0.1)
      << "' style='stroke:" << cells.colour << ";stroke-opacity:" << cells.opacity << "' d='";
  for (std::size_t i = 0; i < centres.size();)
  {
    std::size_t end = i + 1;
    while (end < centres.size() && centres[end].y == centres[i].y &&
           centres[end].x - centres[end - 1].x < 1.5 * cells.size)
      ++end;
    out << 'M' << pixel(axes.px(centres[i].x) - 0.5 * size) << ' ' << pixel(axes.py(centres[i].y))
        << 'h' << pixel(static_cast<double>(end - i) * size);
    i = end;
  }
  out << "'/>\n";
  return out.str();
}

/** The dots with their names. Names that would lie on each other go one below the other. */
std::string marksOf(const std::vector<PlotMark>& marks, const PlotAxes& axes)
{
  constexpr double kRoom = 70.0, kLine = 14.0;  // [px] for a name
  std::vector<PlotPoint> names;
  auto out = classicStream();
  for (const PlotMark& mark : marks)
  {
    if (!isFinite(mark.at)) continue;
    const double x = axes.px(mark.at.x), y = axes.py(mark.at.y);
    out << "<circle cx='" << pixel(x) << "' cy='" << pixel(y)
        << "' r='4' style='fill:" << mark.colour << "'/>\n";
    if (mark.name.empty()) continue;
    const bool left = x > axes.inner.x + axes.inner.width - kRoom;
    PlotPoint at{left ? x - 7.0 : x + 7.0, y - 5.0};
    const auto covers = [&at](const PlotPoint& other)
    { return std::abs(other.x - at.x) < kRoom && std::abs(other.y - at.y) < kLine - 1.0; };
    while (std::any_of(names.begin(), names.end(), covers))
      at.y += kLine;
    names.push_back(at);
    out << textAt(
        at.x, at.y, mark.name,
        std::string(left ? "text-anchor='end'" : "") + " style='fill:" + mark.colour + "'");
  }
  return out.str();
}

std::string labelsOf(const PlotPanel& panel, const PlotRectangle& inner)
{
  const double middle = inner.y + 0.5 * inner.height;
  const double x = inner.x - 48.0;
  auto turned = classicStream();
  turned << "text-anchor='middle' transform='rotate(-90 " << pixel(x) << " " << pixel(middle)
         << ")'";
  const std::string title =
      panel.title.empty() ? "" : textAt(inner.x, inner.y - 12.0, panel.title, "font-weight='bold'");
  return title +
         textAt(
             inner.x + 0.5 * inner.width, inner.y + inner.height + 34.0, panel.x_label,
             "text-anchor='middle'") +
         textAt(x, middle, panel.y_label, turned.str());
}

std::string frameOf(const PlotRectangle& r)
{
  auto out = classicStream();
  out << "<rect class='frame' x='" << r.x << "' y='" << r.y << "' width='" << r.width
      << "' height='" << r.height << "' fill='none'/>\n";
  return out.str();
}
}  // namespace

std::string drawPanel(const PlotPanel& panel, const PlotRectangle& place)
{
  const double top = panel.title.empty() ? kBareTop : kTop;
  const PlotRectangle inner{
      place.x + kLeft, place.y + top, place.width - kLeft - kRight, place.height - top - kBottom};
  const PlotAxes axes = axesOf(panel, inner);
  std::string out;
  for (const PlotStretch& stretch : panel.stretches)
    out += stretchOf(stretch, axes);
  out += gridOf(panel, axes) + frameOf(inner) + labelsOf(panel, inner);
  for (const PlotCells& cells : panel.cells)
    out += cellsOf(cells, axes);
  for (const PlotBand& band : panel.bands)
    out += polygonsOf(band, axes);
  for (const PlotSeries& series : panel.series)
    out += polylinesOf(series, axes);
  return out + marksOf(panel.marks, axes);
}

std::string escapeXml(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else if (static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\t')
      out += c;
  }
  return out;
}

std::string svgDocument(double width, double height, const std::string& elements)
{
  auto out = classicStream();
  out << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " << width << ' ' << height
      << "' width='" << width << "' height='" << height
      << "' font-family='sans-serif' font-size='12'>\n"
      << "<style>.grid{stroke:#dddddd}.frame{stroke:#888888}</style>\n"
      << "<rect width='100%' height='100%' fill='white'/>\n"
      << elements << "</svg>\n";
  return out.str();
}

}  // namespace fastlio
