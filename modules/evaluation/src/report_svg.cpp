// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "units.h"
#include <fastlio/evaluation/report.h>
#include <fastlio/math/time.h>
#include <fastlio/plot/svg_plot.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr double kWidth = 900.0, kTopViewHeight = 520.0, kOverTimeHeight = 220.0;  // [px]
constexpr double kLegendLine = 18.0, kLegendTop = 14.0, kLegendLeft = 62.0;        // [px]
constexpr std::size_t kMaxPoints = 4000;  // more than pixels; bounds the size of the file
constexpr double kSigmas = 3.0;           // of bands
constexpr const char* kReferenceColour = "#7f93a8";
constexpr std::array<const char*, 8> kColours = {"#c0392b", "#1f6fc4", "#15803d", "#8e44ad",
                                                 "#d08700", "#0e8a92", "#b03a8c", "#5d4a2f"};

std::string colourOf(std::size_t estimate)
{
  return kColours.at(estimate % kColours.size());
}

/** Poses that one drawn point stands for. */
std::size_t strideFor(std::size_t count)
{
  return (count + kMaxPoints - 1) / kMaxPoints;
}

/** Draws each n-th pose, and the last one. */
template <typename Draw>
void forSomePoses(const std::vector<StampedPose>& poses, const Draw& draw)
{
  const std::size_t stride = strideFor(poses.size());
  for (std::size_t i = 0; i < poses.size(); i += stride)
    draw(i, poses[i]);
  if (!poses.empty() && (poses.size() - 1) % stride != 0) draw(poses.size() - 1, poses.back());
}

/** Time of all reports counts from the earliest common stamp of any of them. */
std::int64_t beginOf(const std::vector<NamedReport>& reports)
{
  std::int64_t begin_ns = reports.front().report.aligned.reference.front().stamp_ns;
  for (const NamedReport& named : reports)
    begin_ns = std::min(begin_ns, named.report.aligned.reference.front().stamp_ns);
  return begin_ns;
}

/** The report whose reference goes on for longest: that one is drawn. */
const EvaluationReport& longestOf(const std::vector<NamedReport>& reports)
{
  const auto shorter = [](const NamedReport& a, const NamedReport& b)
  { return a.report.duration < b.report.duration; };
  return std::max_element(reports.begin(), reports.end(), shorter)->report;
}

PlotSeries pathFromAbove(
    const std::vector<StampedPose>& poses, const std::string& colour, double width)
{
  PlotSeries series{"", colour, {}, width};
  forSomePoses(
      poses,
      [&](std::size_t, const StampedPose& pose) {
        series.points.push_back({pose.T_world_body.p.x(), pose.T_world_body.p.y()});
      });
  return series;
}

PlotSeries heightOverTime(
    const std::vector<StampedPose>& poses, std::int64_t begin_ns, const std::string& colour,
    double width)
{
  PlotSeries series{"", colour, {}, width};
  forSomePoses(
      poses,
      [&](std::size_t, const StampedPose& pose) {
        series.points.push_back({toSeconds(pose.stamp_ns - begin_ns), pose.T_world_body.p.z()});
      });
  return series;
}

/** Empty where the estimate has no covariances. */
PlotBand heightBand(const EvaluationReport& r, std::int64_t begin_ns, const std::string& colour)
{
  constexpr int kHeight = 5;  // of Deviation
  PlotBand band{colour, {}};
  forSomePoses(
      r.aligned.estimate,
      [&](std::size_t i, const StampedPose& pose)
      {
        const double sigma = i < r.deviations.size() ? r.deviations[i].sigma[kHeight] : -1.0;
        if (sigma < 0.0) return;
        const double z = pose.T_world_body.p.z(), reach = kSigmas * sigma;
        band.intervals.push_back({toSeconds(pose.stamp_ns - begin_ns), z - reach, z + reach});
      });
  return band;
}

/** The largest error of each stride, so that no peak is lost. */
PlotSeries errorOverTime(
    const EvaluationReport& r, std::int64_t begin_ns, double PoseError::*member, double factor,
    const std::string& colour)
{
  PlotSeries series{"", colour, {}};
  const std::size_t stride = strideFor(r.errors.size());
  const auto smaller = [member](const PoseError& a, const PoseError& b)
  { return a.*member < b.*member; };
  for (std::size_t i = 0; i < r.errors.size(); i += stride)
  {
    const auto begin = r.errors.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end =
        r.errors.begin() + static_cast<std::ptrdiff_t>(std::min(i + stride, r.errors.size()));
    const auto largest = std::max_element(begin, end, smaller);
    const auto index = static_cast<std::size_t>(largest - r.errors.begin());
    const double seconds = toSeconds(r.aligned.estimate[index].stamp_ns - begin_ns);
    series.points.push_back({seconds, (*largest).*member * factor});
  }
  return series;
}

PlotPanel topView(const std::vector<NamedReport>& reports)
{
  const EvaluationReport& longest = longestOf(reports);
  PlotPanel panel{
      "Top view, aligned: " + toString(longest.options.alignment), "x [m]", "y [m]", {}, true};
  panel.series.push_back(pathFromAbove(longest.aligned.reference, kReferenceColour, 5.0));
  for (std::size_t i = 0; i < reports.size(); ++i)
    panel.series.push_back(pathFromAbove(reports[i].report.aligned.estimate, colourOf(i), 1.5));
  panel.marks = {{panel.series.front().points.front(), "start", "#222222"}};
  return panel;
}

PlotPanel heightPanel(const std::vector<NamedReport>& reports, std::int64_t begin_ns)
{
  PlotPanel panel{"Height, with three standard deviations", "time [s]", "z [m]", {}};
  panel.series.push_back(
      heightOverTime(longestOf(reports).aligned.reference, begin_ns, kReferenceColour, 4.0));
  bool banded = false;
  for (std::size_t i = 0; i < reports.size(); ++i)
  {
    const EvaluationReport& r = reports[i].report;
    panel.series.push_back(heightOverTime(r.aligned.estimate, begin_ns, colourOf(i), 1.5));
    panel.bands.push_back(heightBand(r, begin_ns, colourOf(i)));
    banded = banded || !panel.bands.back().intervals.empty();
  }
  if (!banded) panel.title = "Height";
  return panel;
}

PlotPanel errorPanel(
    const std::vector<NamedReport>& reports, std::int64_t begin_ns, const char* title,
    const char* unit, double PoseError::*member, double factor)
{
  PlotPanel panel{title, "time [s]", unit, {}, false, true};
  for (std::size_t i = 0; i < reports.size(); ++i)
    panel.series.push_back(errorOverTime(reports[i].report, begin_ns, member, factor, colourOf(i)));
  return panel;
}

std::string legendLine(const std::string& name, const std::string& colour, std::size_t line)
{
  const double y = kLegendTop + kLegendLine * static_cast<double>(line);
  return "<rect x='" + tickText(kLegendLeft) + "' y='" + tickText(y) +
         "' width='14' height='10' style='fill:" + colour + "'/>\n<text x='" +
         tickText(kLegendLeft + 20.0) + "' y='" + tickText(y + 10.0) + "'>" + escapeXml(name) +
         "</text>\n";
}

/** A line per name, above the panels: names may be long. */
std::string legendOf(const std::vector<NamedReport>& reports)
{
  std::string text = legendLine("reference", kReferenceColour, 0);
  for (std::size_t i = 0; i < reports.size(); ++i)
    text += legendLine(reports[i].name, colourOf(i), i + 1);
  return text;
}
}  // namespace

std::string toSvg(const std::vector<NamedReport>& reports)
{
  if (reports.empty()) throw std::invalid_argument("there is no estimate to draw");
  const std::int64_t begin_ns = beginOf(reports);
  std::string drawing = legendOf(reports);
  double y = kLegendTop + kLegendLine * static_cast<double>(reports.size() + 1);
  const auto add = [&](const PlotPanel& panel, double height)
  {
    drawing += drawPanel(panel, {0.0, y, kWidth, height});
    y += height;
  };
  add(topView(reports), kTopViewHeight);
  add(heightPanel(reports, begin_ns), kOverTimeHeight);
  add(errorPanel(
          reports, begin_ns, "Absolute translation error", "[m]", &PoseError::translation, 1.0),
      kOverTimeHeight);
  add(errorPanel(
          reports, begin_ns, "Absolute rotation error", "[deg]", &PoseError::rotation,
          toDegrees(1.0)),
      kOverTimeHeight);
  return svgDocument(kWidth, y, drawing);
}

std::string toSvg(const EvaluationReport& report)
{
  return toSvg(std::vector<NamedReport>{{"estimate", report}});
}

}  // namespace fastlio
