// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file svg_plot.h Line plots as SVG text. */
#pragma once

#include <string>
#include <vector>

namespace fastlio
{
struct PlotPoint
{
  double x = 0.0;
  double y = 0.0;
};

struct PlotSeries
{
  std::string name;    //!< in the legend
  std::string colour;  //!< as CSS
  std::vector<PlotPoint> points;
  double width = 1.5;  //!< of the line [px]
};

struct PlotPanel
{
  std::string title, x_label, y_label;  //!< labels with units
  std::vector<PlotSeries> series;
  bool equal_scales = false;  //!< one unit is as long on x as on y
  bool from_zero = false;     //!< the y axis starts at 0
};

/** Place on the page, axes' labels included [px]. */
struct PlotRectangle
{
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

/** Round numbers ("1, 2 or 5 times a power of ten") in [low, high], about \a count of them. */
[[nodiscard]] std::vector<double> roundTicks(double low, double high, int count);

/** The panel's SVG elements. */
[[nodiscard]] std::string drawPanel(const PlotPanel& panel, const PlotRectangle& place);

/** Text with the characters that are special in XML replaced. */
[[nodiscard]] std::string escapeXml(const std::string& text);

/** A whole SVG file around the elements. */
[[nodiscard]] std::string svgDocument(double width, double height, const std::string& elements);

}  // namespace fastlio
