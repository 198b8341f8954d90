// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "report_charts.h"

#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/plot/report_figure.h>
#include <fastlio/run/run_health.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace fastlio
{
namespace
{
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

struct ChartLine
{
  const char* name;
  const char* colour;
  std::size_t channel;
  std::optional<std::size_t> sigma = {};  //!< channel of its standard deviation
};

struct ChartSpec
{
  const char* title;
  const char* unit;
  const char* note;  //!< HTML
  std::vector<ChartLine> lines;
  bool from_zero = true;
  std::optional<PlotRange> range = {};
};

std::vector<ChartLine> threeAxes(std::size_t channel, std::optional<std::size_t> sigma = {})
{
  const auto shifted = [&](std::size_t by)
  { return sigma ? std::optional(*sigma + by) : std::nullopt; };
  return {
      {"x", "var(--s1)", channel, shifted(0)},
      {"y", "var(--s2)", channel + 1, shifted(1)},
      {"z", "var(--s3)", channel + 2, shifted(2)}};
}

const std::vector<ChartSpec>& runCharts()
{
  static const std::vector<ChartSpec> charts = {
      {"Height", "[m]", "z of the body in the world.", {{"", "var(--s1)", kHeightChannel}}, false},
      {"Speed", "[m/s]", "Of the IMU.", {{"", "var(--s1)", kSpeedChannel}}},
      {"Angular rate", "[deg/s]", "Mean from scan to scan.", {{"", "var(--s1)", kRateChannel}}},
      {"Position, standard deviation", "[m]", "In the world frame, since the start.",
       threeAxes(kPositionSigmaChannel)},
      {"Attitude, standard deviation", "[deg]", "About the axes of the body.",
       threeAxes(kAttitudeSigmaChannel)},
      {"Gyro bias", "[deg/s]",
       "Areas: three standard deviations. A bias settles while the platform "
       "turns.",
       threeAxes(kGyroBiasChannel, kGyroSigmaChannel), false},
      {"Accelerometer bias", "[m/s\u00b2]", "Areas: three standard deviations.",
       threeAxes(kAccelBiasChannel, kAccelSigmaChannel), false},
      {"Degenerate directions",
       "[count]",
       "Directions of motion that a scan leaves open: there the pose is inertial only.",
       {{"", "var(--s1)", kUnconstrainedChannel}},
       true,
       PlotRange{0.0, 6.2}},
      {"Residuals",
       "[mm]",
       "Distance of the matched points from the map, RMS.",
       {{"", "var(--s1)", kResidualChannel}}},
      {"Normalised innovation",
       "[-]",
       "About 1 when the noise is as assumed; above 3 the scan is in trouble.",
       {{"", "var(--s1)", kInnovationChannel}}},
      {"Points of a scan",
       "[count]",
       "Points that were matched are a part of the downsampled ones.",
       {{"downsampled", "var(--s1)", kPointsDownsampledChannel},
        {"matched", "var(--s2)", kPointsEffectiveChannel}}},
      {"Points as delivered",
       "[count]",
       "Before range limits and downsampling.",
       {{"", "var(--s1)", kPointsInChannel}}},
      {"Size of the matching map",
       "[points]",
       "Points in the map that scans are matched with; the saved map is another one.",
       {{"", "var(--s1)", kMapPointsChannel}}},
  };
  return charts;
}

const std::vector<ChartSpec>& machineCharts()
{
  static const std::vector<ChartSpec> charts = {
      {"Time per scan and stage",
       "[ms]",
       "Wall clock.",
       {{"total", "var(--ink)", kStagesChannel + 6},
        {"propagate", "var(--s1)", kStagesChannel},
        {"deskew", "var(--s2)", kStagesChannel + 1},
        {"downsample", "var(--s3)", kStagesChannel + 2},
        {"associate", "var(--s4)", kStagesChannel + 3},
        {"update", "var(--s5)", kStagesChannel + 4},
        {"insert", "var(--s6)", kStagesChannel + 5}}},
      {"Memory", "[MB]", "Resident memory of the program.", {{"", "var(--s1)", kMemoryChannel}}},
  };
  return charts;
}

/** The smallest and the largest value of each bin, so that no peak is lost. */
PlotSeries lineOf(const ReportSeries& series, const ChartLine& line)
{
  PlotSeries drawn{line.name, line.colour, {}, 1.5};
  double last_s = -std::numeric_limits<double>::max();
  for (const ReportBin& bin : series.bins())
  {
    if (bin.begin_s - last_s > kReportGapSeconds) drawn.points.push_back({kNoNumber, kNoNumber});
    last_s = bin.end_s;
    const auto low = static_cast<double>(bin.low.at(line.channel));
    const auto high = static_cast<double>(bin.high.at(line.channel));
    const double x = low < high ? 0.5 * (bin.begin_s + bin.end_s) : bin.end_s;
    drawn.points.push_back({x, low});
    if (low < high) drawn.points.push_back({bin.end_s, high});
  }
  return drawn;
}

PlotBand bandOf(const ReportSeries& series, const ChartLine& line)
{
  PlotBand band{line.colour, {}};
  double last_s = 0.0;
  for (const ReportBin& bin : series.bins())
  {
    if (bin.begin_s - last_s > kReportGapSeconds)
      band.intervals.push_back({kNoNumber, kNoNumber, kNoNumber});
    last_s = bin.end_s;
    const double reach = kSigmas * static_cast<double>(bin.high.at(*line.sigma));
    band.intervals.push_back(
        {bin.end_s, static_cast<double>(bin.low.at(line.channel)) - reach,
         static_cast<double>(bin.high.at(line.channel)) + reach});
  }
  return band;
}

std::string causeTitle(const TroubledStretch& stretch)
{
  return fixedText(stretch.begin_s, 1) + " to " + fixedText(stretch.end_s, 1) +
         " s: " + toString(stretch.cause);
}

bool hasNumber(const PlotPanel& panel)
{
  for (const PlotSeries& series : panel.series)
    for (const PlotPoint& point : series.points)
      if (std::isfinite(point.y)) return true;
  return false;
}

std::string chartHtml(const ReportSeries& series, const ChartSpec& spec)
{
  PlotPanel panel = timePanel(series, spec.unit);
  panel.from_zero = spec.from_zero;
  panel.y_range = spec.range;
  std::vector<LegendEntry> legend;
  for (const ChartLine& line : spec.lines)
  {
    panel.series.push_back(lineOf(series, line));
    if (line.sigma) panel.bands.push_back(bandOf(series, line));
    if (*line.name != '\0') legend.push_back({line.name, line.colour});
  }
  const std::string note = hasNumber(panel) ? spec.note : "No scan has a value.";
  return figureHtml(panel, kChartPlace, spec.title, legend, note);
}

std::string healthChart(const ReportSeries& series)
{
  PlotPanel panel = timePanel(series, "[0 to 1]");
  panel.y_range = PlotRange{0.0, 1.05};
  panel.series = {lineOf(series, {"", "var(--s1)", kHealthChannel})};
  const double end_s = panel.x_range->high;
  panel.series.push_back(
      {"limit", "var(--bad)", {{0.0, kTroubledHealth}, {end_s, kTroubledHealth}}, 1.0});
  std::vector<LegendEntry> legend{{"limit", "var(--bad)"}};
  std::set<HealthCause> causes;
  for (const TroubledStretch& stretch : troubledStretches(series))
    if (causes.insert(stretch.cause).second)
      legend.push_back({toString(stretch.cause), causeColour(stretch.cause)});
  return figureHtml(
      panel, kChartPlace, "Health", legend,
      "Below the limit a scan is in trouble. Coloured stretches, here and in the other charts, "
      "show "
      "the cause.");
}
}  // namespace

PlotPanel timePanel(const ReportSeries& series, const char* unit)
{
  PlotPanel panel;
  panel.x_label = "time [s]";
  panel.y_label = unit;
  const double end_s = series.bins().empty() ? 1.0 : series.bins().back().end_s;
  panel.x_range = PlotRange{0.0, std::max(end_s, 1e-3)};
  for (const TroubledStretch& stretch : troubledStretches(series))
    panel.stretches.push_back(
        {stretch.begin_s, stretch.end_s, causeColour(stretch.cause), causeTitle(stretch)});
  return panel;
}

std::string causeColour(HealthCause cause)
{
  return std::string("var(--c-") + toString(cause) + ")";
}

std::vector<TroubledStretch> troubledStretches(const ReportSeries& series)
{
  std::vector<TroubledStretch> stretches;
  double last_end = 0.0;
  for (const ReportBin& bin : series.bins())
  {
    if (bin.begin_s - last_end > kReportGapSeconds)
      stretches.push_back({last_end, bin.begin_s, HealthCause::ScanTiming});  // no scan at all
    last_end = bin.end_s;
    if (bin.worst_health >= kTroubledHealth) continue;
    const bool goes_on = !stretches.empty() && stretches.back().cause == bin.cause &&
                         bin.begin_s - stretches.back().end_s < kReportGapSeconds;
    if (!goes_on) stretches.push_back({bin.begin_s, bin.end_s, bin.cause});
    stretches.back().end_s = bin.end_s;
  }
  return stretches;
}

std::string timeCharts(const ReportSeries& series)
{
  std::string html = healthChart(series);
  for (const ChartSpec& spec : runCharts())
    html += chartHtml(series, spec);
  return html;
}

std::string measuredCharts(const ReportSeries& series)
{
  std::string html;
  for (const ChartSpec& spec : machineCharts())
    html += chartHtml(series, spec);
  return html;
}

}  // namespace fastlio
