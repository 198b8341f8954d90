// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "view_grid.h"
#include <fastlio/options/number_text.h>
#include <fastlio/plot/report_figure.h>
#include <fastlio/report/report_map.h>

#include <algorithm>

namespace fastlio
{
namespace
{
/** The lines that are drawn, and the colours of the heights. */
std::vector<LegendEntry> legendOf(const MapViews& views, const PlotPanel& panel)
{
  std::vector<LegendEntry> legend;
  for (const PlotSeries& line : panel.series)
    if (!line.points.empty()) legend.push_back({line.name, line.colour});
  if (views.points == 0) return legend;
  legend.push_back({"low, " + fixedText(views.lowest, 1) + " m", kHeightColours.front()});
  legend.push_back({"high, " + fixedText(views.highest, 1) + " m", kHeightColours.back()});
  return legend;
}

std::string figureOf(
    const MapViews& views, const PlotPanel& panel, const std::string& title,
    const std::string& note)
{
  return figureHtml(panel, placeOf(panel), title, legendOf(views, panel), note);
}
}  // namespace

std::string mapFigures(const MapViews& views)
{
  // A run that only localises saves none.
  std::string note = views.points == 0 ? "The saved map has no points."
                                       : "The saved map has " + countText(views.points) +
                                             " points. Colours show the height.";
  if (!views.problem.empty()) note = "The map is not complete: " + htmlText(views.problem);
  const std::string seen_along = views.side_axis == "x" ? "y" : "x";
  std::string side_note = "Seen along " + seen_along + ".";
  if (views.points > 0) side_note += " Where points are denser, the colour is stronger.";
  if (views.side.y_stretch > 1.0)
    side_note += " Heights are drawn " + fixedText(views.side.y_stretch, 0) +
                 " times as large as distances along " + views.side_axis + ".";
  return figureOf(views, views.top, "From above", note) +
         (views.close ? figureOf(
                            views, *views.close, "From above, the path closer",
                            "The same map around the path.")
                      : "") +
         figureOf(views, views.side, "From the side", side_note);
}

}  // namespace fastlio
