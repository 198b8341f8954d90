// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "svg_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace fastlio
{
namespace
{
constexpr double kLeft = 70.0, kRight = 20.0, kTop = 34.0, kBottom = 46.0;  // margins [px]
constexpr double kPixelsPerXTick = 80.0, kPixelsPerYTick = 40.0;

struct Range
{
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();

  [[nodiscard]] double span() const { return high - low; }
  [[nodiscard]] double centre() const { return 0.5 * (low + high); }
};

Range extended(const Range& r, double value)
{
  return {std::min(r.low, value), std::max(r.high, value)};
}

Range withSpan(const Range& r, double span)
{
  return {r.centre() - 0.5 * span, r.centre() + 0.5 * span};
}

/** Data to pixels. */
struct Axes
{
  Range x, y;           //!< data
  PlotRectangle inner;  //!< pixels

  [[nodiscard]] double px(double v) const { return inner.x + inner.width * (v - x.low) / x.span(); }
  [[nodiscard]] double py(double v) const
  {
    return inner.y + inner.height * (1.0 - (v - y.low) / y.span());
  }
};

/** Some room around the data; an axis on which nothing moves gets a span as well. */
Range padded(const Range& r)
{
  constexpr double kPadding = 1.1;
  if (!(r.span() >= 0.0)) return {0.0, 1.0};
  const double least = 1e-6 * std::max(1.0, std::abs(r.centre()));
  return withSpan(r, std::max(kPadding * r.span(), least));
}

Axes axesOf(const PlotPanel& panel, const PlotRectangle& inner)
{
  Range x, y;
  for (const PlotSeries& series : panel.series)
    for (const PlotPoint& point : series.points)
    {
      x = extended(x, point.x);
      y = extended(y, point.y);
    }
  if (panel.from_zero) y = extended(y, 0.0);
  Axes axes{padded(x), padded(y), inner};
  if (panel.from_zero) axes.y.low = 0.0;
  if (!panel.equal_scales) return axes;
  const double unit = std::max(axes.x.span() / inner.width, axes.y.span() / inner.height);
  return {withSpan(axes.x, unit * inner.width), withSpan(axes.y, unit * inner.height), inner};
}

std::string text(double x, double y, const std::string& content, const std::string& attributes)
{
  std::ostringstream out;
  out << "<text x='" << x << "' y='" << y << "' " << attributes << ">" << escapeXml(content)
      << "</text>\n";
  return out.str();
}

std::string line(double x1, double y1, double x2, double y2)
{
  std::ostringstream out;
  out << "<line x1='" << x1 << "' y1='" << y1 << "' x2='" << x2 << "' y2='" << y2
      << "' stroke='#dddddd'/>\n";
  return out.str();
}

std::string number(double value)
{
  std::ostringstream out;
  out << (std::abs(value) < 1e-12 ? 0.0 : value);
  return out.str();
}

std::string grid(const Axes& a)
{
  const PlotRectangle& r = a.inner;
  std::string out;
  for (const double v : roundTicks(a.x.low, a.x.high, static_cast<int>(r.width / kPixelsPerXTick)))
    out += line(a.px(v), r.y, a.px(v), r.y + r.height) +
           text(a.px(v), r.y + r.height + 16.0, number(v), "text-anchor='middle'");
  for (const double v : roundTicks(a.y.low, a.y.high, static_cast<int>(r.height / kPixelsPerYTick)))
    out += line(r.x, a.py(v), r.x + r.width, a.py(v)) +
           text(r.x - 6.0, a.py(v) + 4.0, number(v), "text-anchor='end'");
  return out;
}

std::string polyline(const PlotSeries& series, const Axes& axes)
{
  std::ostringstream out;
  out.precision(7);
  out << "<polyline fill='none' stroke-width='" << series.width << "' stroke='" << series.colour
      << "' points='";
  for (const PlotPoint& point : series.points)
    out << axes.px(point.x) << ',' << axes.py(point.y) << ' ';
  out << "'/>\n";
  return out.str();
}

std::string labels(const PlotPanel& panel, const PlotRectangle& inner)
{
  const double middle = inner.y + 0.5 * inner.height;
  std::ostringstream turned;
  turned << "text-anchor='middle' transform='rotate(-90 " << inner.x - 52.0 << " " << middle
         << ")'";
  return text(inner.x, inner.y - 12.0, panel.title, "font-weight='bold'") +
         text(
             inner.x + 0.5 * inner.width, inner.y + inner.height + 36.0, panel.x_label,
             "text-anchor='middle'") +
         text(inner.x - 52.0, middle, panel.y_label, turned.str());
}

/** Names at the upper right, above the axes, in the series' colours; a single
 * series is named by the title. */
std::string legend(const PlotPanel& panel, const PlotRectangle& inner)
{
  if (panel.series.size() < 2) return {};
  std::string out;
  double x = inner.x + inner.width;
  for (auto series = panel.series.rbegin(); series != panel.series.rend(); ++series)
  {
    out += text(x, inner.y - 12.0, series->name, "text-anchor='end' fill='" + series->colour + "'");
    x -= 8.0 * static_cast<double>(series->name.size()) + 16.0;
  }
  return out;
}

std::string frame(const PlotRectangle& r)
{
  std::ostringstream out;
  out << "<rect x='" << r.x << "' y='" << r.y << "' width='" << r.width << "' height='" << r.height
      << "' fill='none' stroke='#888888'/>\n";
  return out.str();
}

}  // namespace

std::vector<double> roundTicks(double low, double high, int count)
{
  const double raw = (high - low) / std::max(count, 1);
  if (!(raw > 0.0) || !std::isfinite(raw)) return {};
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double mantissa = raw / power;
  const double step = power * (mantissa <= 1.0   ? 1.0
                               : mantissa <= 2.0 ? 2.0
                               : mantissa <= 5.0 ? 5.0
                                                 : 10.0);
  const auto first = std::ceil(low / step);
  const auto steps = static_cast<int>(std::floor(high / step) - first);
  std::vector<double> ticks;
  for (int i = 0; i <= steps; ++i)
    ticks.push_back((first + i) * step);
  return ticks;
}

std::string drawPanel(const PlotPanel& panel, const PlotRectangle& place)
{
  const PlotRectangle inner{
      place.x + kLeft, place.y + kTop, place.width - kLeft - kRight, place.height - kTop - kBottom};
  const Axes axes = axesOf(panel, inner);
  std::string out = grid(axes) + frame(inner) + labels(panel, inner) + legend(panel, inner);
  for (const PlotSeries& series : panel.series)
    out += polyline(series, axes);
  return out;
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
    else
      out += c;
  }
  return out;
}

std::string svgDocument(double width, double height, const std::string& elements)
{
  std::ostringstream out;
  out << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " << width << ' ' << height
      << "' width='" << width << "' height='" << height
      << "' font-family='sans-serif' font-size='12'>\n"
      << "<rect width='100%' height='100%' fill='white'/>\n"
      << elements << "</svg>\n";
  return out.str();
}

}  // namespace fastlio
