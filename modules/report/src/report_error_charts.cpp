// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "report_charts.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/plot/report_figure.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::size_t kDrawn = 2000;  // values of a line

/** No line is drawn across a longer time: of a long run, values lie farther apart [s]. */
double longestStep(const PlotPanel& panel)
{
  return std::max(kReportGapSeconds, 3.0 * panel.x_range->high / static_cast<double>(kDrawn));
}

/** Of each so many values the largest one, so that no peak is lost. */
template <typename T, typename Smaller>
std::vector<T> largestOf(const std::vector<T>& values, const Smaller& smaller)
{
  const std::size_t stride = (values.size() + kDrawn - 1) / kDrawn;
  std::vector<T> drawn;
  for (std::size_t i = 0; i < values.size(); i += stride)
  {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end =
        values.begin() + static_cast<std::ptrdiff_t>(std::min(i + stride, values.size()));
    drawn.push_back(*std::max_element(begin, end, smaller));
  }
  return drawn;
}

/** Truth minus estimate along one axis. \param component of Deviation */
std::string deviationChart(
    const EvaluationReport& report, const ReportSeries& series, int component, const char* title)
{
  const bool rotation = component < 3;
  const double factor = rotation ? kDegPerRad : 1.0;
  PlotPanel panel = timePanel(series, rotation ? "[deg]" : "[m]");
  PlotSeries line{"", "var(--s1)", {}, 1.5};
  PlotBand band{"var(--s1)", {}};
  const auto smaller = [component](const Deviation& a, const Deviation& b)
  { return std::abs(a.error[component]) < std::abs(b.error[component]); };
  for (const Deviation& d : largestOf(report.deviations, smaller))
  {
    const double x = toSeconds(d.stamp_ns - series.beginNs());
    if (!line.points.empty() && x - line.points.back().x > longestStep(panel))
    {
      line.points.push_back({x, std::nan("")});
      band.intervals.push_back({x, std::nan(""), std::nan("")});
    }
    line.points.push_back({x, factor * d.error[component]});
    const double reach = kSigmas * factor * d.sigma[component];
    if (reach >= 0.0) band.intervals.push_back({x, -reach, reach});
  }
  panel.series = {line};
  panel.bands = {band};
  return figureHtml(
      panel, kChartPlace, title, {}, "Truth minus estimate; area: three standard deviations.");
}

std::string neesChart(const EvaluationReport& report, const ReportSeries& series)
{
  PlotPanel panel = timePanel(series, "[-]");
  panel.from_zero = true;
  PlotSeries line{"", "var(--s1)", {}, 1.5};
  const auto smaller = [](const NeesSample& a, const NeesSample& b) { return a.pose < b.pose; };
  for (const NeesSample& sample : largestOf(report.nees->samples, smaller))
  {
    const double x = toSeconds(sample.stamp_ns - series.beginNs());
    if (!line.points.empty() && x - line.points.back().x > longestStep(panel))
      line.points.push_back({x, std::nan("")});
    line.points.push_back({x, sample.pose});
  }
  const double bound = report.nees->pose.sample_bound;
  PlotSeries limit{"95 %", "var(--bad)", {{0.0, bound}, {panel.x_range->high, bound}}, 1.0};
  panel.series = {line, limit};
  return figureHtml(
      panel, kChartPlace, "NEES of the pose",
      {{"95 % of a true covariance lie below", "var(--bad)"}},
      "Squared error over its covariance: 6 on average when the covariance is true.");
}
}  // namespace

std::string errorCharts(const ReferenceFindings& findings, const ReportSeries& series)
{
  if (!findings.report) return {};
  const EvaluationReport& report = *findings.report;
  std::string html = deviationChart(report, series, 3, "Position error, x") +
                     deviationChart(report, series, 4, "Position error, y") +
                     deviationChart(report, series, 5, "Position error, z") +
                     deviationChart(report, series, 0, "Rotation error about x") +
                     deviationChart(report, series, 1, "Rotation error about y") +
                     deviationChart(report, series, 2, "Rotation error about z");
  if (report.nees) html += neesChart(report, series);
  return html;
}

}  // namespace fastlio
