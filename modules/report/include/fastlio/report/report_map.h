// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file report_map.h Path and map from above and from the side (internal). */
#pragma once

#include <fastlio/plot/svg_plot.h>
#include <fastlio/report/report_series.h>
#include <fastlio/run/output_map.h>

#include <string>
#include <vector>

namespace fastlio
{
/** Two views, counted from the origin of the map [m]. */
struct MapViews
{
  PlotPanel top, side;
  std::string side_axis = "x";              //!< horizontal axis of the side view
  double lowest = 0.0, highest = 0.0;       //!< of the colours [m]
  std::size_t points = 0;                   //!< of the map
  std::string problem;                      //!< why there are no points, or empty
  std::vector<std::string> height_colours;  //!< from low to high
};

/** Place of a view on the page [px]: no higher than its content needs. */
[[nodiscard]] PlotRectangle placeOf(const PlotPanel& view);

/** Draws at most one cell per few pixels, whatever the size of the map; reads the map twice. */
[[nodiscard]] MapViews mapViewsOf(const ReportSeries& series, const OutputMap& map);

}  // namespace fastlio
