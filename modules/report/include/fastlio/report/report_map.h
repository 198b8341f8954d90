// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file report_map.h Path and map from above and from the side (internal). */
#pragma once

#include <fastlio/math/so3.h>
#include <fastlio/plot/svg_plot.h>
#include <fastlio/report/report_series.h>
#include <fastlio/run/output_map.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** A line over the map; it is broken at points that are not finite. */
struct MapLine
{
  std::string name, colour;  //!< in the legend, as CSS
  std::vector<Vec3> points;  //!< in the world [m]
  double width = 2.0;        //!< [px]
};

/** A named dot over the map. */
struct MapMark
{
  std::string name, colour;
  Vec3 at = Vec3::Zero();  //!< in the world [m]
};

/** What is drawn over the map. */
struct MapOverlay
{
  std::vector<MapLine> lines;  //!< the path first
  std::vector<MapMark> marks;
};

/** Views of a map, counted from its origin [m]. */
struct MapViews
{
  PlotPanel top, side;
  std::optional<PlotPanel> close;      //!< from above, where the path is small beside the map
  std::string side_axis = "x";         //!< horizontal axis of the side view
  double lowest = 0.0, highest = 0.0;  //!< of the colours [m]
  std::size_t points = 0;              //!< of the map
  std::string problem;                 //!< why there are no points, or empty
};

/** Place of a view on the page [px]: no higher than its content needs. */
[[nodiscard]] PlotRectangle placeOf(const PlotPanel& view);

/** Draws at most one cell per few pixels, whatever the size of the map; reads the map twice. */
[[nodiscard]] MapViews mapViewsOf(const MapOverlay& overlay, const OutputMap& map);

/** The same of a run: its path, the stretches of it not to rely on, and the directions that its
 * scans left open. */
[[nodiscard]] MapViews mapViewsOf(
    const ReportSeries& series, const std::vector<UntrustedStretch>& untrusted,
    const OutputMap& map);

/** The views as figures of a page, as HTML. */
[[nodiscard]] std::string mapFigures(const MapViews& views);

}  // namespace fastlio
