// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "report_charts.h"
#include <fastlio/options/number_text.h>
#include <fastlio/plot/report_figure.h>

namespace fastlio
{
std::string mapFigures(const MapViews& views)
{
  std::vector<LegendEntry> legend{{"path", "var(--path)"}};
  if (views.points > 0 && !views.height_colours.empty())
  {
    legend.push_back({"low, " + fixedText(views.lowest, 1) + " m", views.height_colours.front()});
    legend.push_back({"high, " + fixedText(views.highest, 1) + " m", views.height_colours.back()});
  }
  std::vector<LegendEntry> top_legend = legend;
  if (views.top.series.size() > 1 && !views.top.series[1].points.empty())
    top_legend.push_back({"degenerate direction", "var(--warn)"});
  std::string note = std::to_string(views.points) + " points of the map, coloured by height.";
  if (!views.problem.empty()) note = "The map is not complete: " + htmlText(views.problem);
  return figureHtml(views.top, placeOf(views.top), "From above", top_legend, note) +
         figureHtml(
             views.side, placeOf(views.side), "From the side", legend,
             "Along " + std::string(views.side_axis == "x" ? "y" : "x") +
                 "; the denser the points, the stronger the colour.");
}

}  // namespace fastlio
