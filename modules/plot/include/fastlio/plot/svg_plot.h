// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file svg_plot.h Plots as SVG text. Colours are CSS values: a page may give its own variables. */
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
struct PlotPoint
{
  double x = 0.0;
  double y = 0.0;
};

/** A line; it is broken at points that are not finite. */
struct PlotSeries
{
  std::string name;    //!< for a legend
  std::string colour;  //!< as CSS
  std::vector<PlotPoint> points;
  double width = 1.5;  //!< of the line [px]
};

/** Between which values something lies, at x. */
struct PlotInterval
{
  double x = 0.0, low = 0.0, high = 0.0;
};

/** An area about a line, for instance three standard deviations; broken like a line. */
struct PlotBand
{
  std::string colour;
  std::vector<PlotInterval> intervals;
};

/** A part of the x axis, coloured over the whole height. */
struct PlotStretch
{
  double from = 0.0, to = 0.0;
  std::string colour;
  std::string title;       //!< shown by browsers where the pointer rests
  std::string label = {};  //!< written at its top
};

/** Cells of one colour, for instance of a map; those that touch in a row become one. */
struct PlotCells
{
  std::string colour;
  double opacity = 1.0;
  double size = 1.0;  //!< width, in the unit of the axes
  std::vector<PlotPoint> centres;
  double height = 0.0;  //!< likewise; 0: as the width
};

/** A dot with a name beside it. */
struct PlotMark
{
  PlotPoint at;
  std::string name, colour;
};

/** Two numbers of an axis. */
struct PlotRange
{
  double low = 0.0, high = 0.0;
};

/** A value of an axis with its text. */
struct PlotTick
{
  double at = 0.0;
  std::string text;
};

struct PlotPanel
{
  std::string title;             //!< empty: the axes begin at the top
  std::string x_label, y_label;  //!< with units
  std::vector<PlotSeries> series;
  bool equal_scales = false;  //!< one unit is as long on x as on y, but for y_stretch
  bool from_zero = false;     //!< the y axis starts at 0
  std::vector<PlotBand> bands = {};
  std::vector<PlotStretch> stretches = {};
  std::vector<PlotCells> cells = {};
  std::vector<PlotMark> marks = {};
  std::optional<PlotRange> x_range = {};  //!< instead of that of the data
  std::optional<PlotRange> y_range = {};  //!< likewise
  double y_stretch = 1.0;  //!< with equal scales: one unit is so many times as long on y as on x
  std::vector<PlotTick> x_ticks = {};  //!< instead of round numbers
  std::vector<PlotTick> y_ticks = {};  //!< likewise
};

/** Place on the page, axes' labels included [px]. */
struct PlotRectangle
{
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

/** Round numbers ("1, 2 or 5 times a power of ten") in [low, high], about \a count of them. */
[[nodiscard]] std::vector<double> roundTicks(double low, double high, int count);

/** The panel's SVG elements. Those of class `grid` and `frame` have no colour of their own. */
[[nodiscard]] std::string drawPanel(const PlotPanel& panel, const PlotRectangle& place);

/** Text with the characters that are special in XML replaced, and control characters, which XML
 * does not allow, left out. */
[[nodiscard]] std::string escapeXml(const std::string& text);

/** A whole SVG file around the elements. */
[[nodiscard]] std::string svgDocument(double width, double height, const std::string& elements);

/** A number as axes show it: at most six digits. */
[[nodiscard]] std::string tickText(double value);

/** At least three round numbers where there is room for \a count, with their texts. */
[[nodiscard]] std::vector<PlotTick> axisTicks(const PlotRange& range, int count);

}  // namespace fastlio
