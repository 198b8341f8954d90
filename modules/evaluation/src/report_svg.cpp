// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "units.h"
#include <fastlio/evaluation/report.h>
#include <fastlio/math/time.h>
#include <fastlio/plot/svg_plot.h>

#include <algorithm>

namespace fastlio
{
namespace
{
constexpr double kWidth = 900.0, kTopViewHeight = 520.0, kErrorHeight = 200.0;  // [px]
constexpr std::size_t kMaxPoints = 4000;  // more than pixels; bounds the size of the file
constexpr const char* kReferenceColour = "#9bb8d3";
constexpr const char* kEstimateColour = "#c0392b";

/** Poses that one drawn point stands for. */
std::size_t strideFor(std::size_t count)
{
  return (count + kMaxPoints - 1) / kMaxPoints;
}

PlotSeries pathFromAbove(
    const std::vector<StampedPose>& poses, const char* name, const char* colour, double width)
{
  PlotSeries series{name, colour, {}, width};
  for (std::size_t i = 0; i < poses.size(); i += strideFor(poses.size()))
    series.points.push_back({poses[i].T_world_body.p.x(), poses[i].T_world_body.p.y()});
  return series;
}

/** The largest error of each stride, so that no peak is lost. */
PlotSeries errorOverTime(const EvaluationReport& r, double PoseError::*member, double factor)
{
  PlotSeries series{"", kEstimateColour, {}};
  const std::size_t stride = strideFor(r.errors.size());
  const auto smaller = [member](const PoseError& a, const PoseError& b)
  { return a.*member < b.*member; };
  for (std::size_t i = 0; i < r.errors.size(); i += stride)
  {
    const auto begin = r.errors.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end =
        r.errors.begin() + static_cast<std::ptrdiff_t>(std::min(i + stride, r.errors.size()));
    const auto largest = std::max_element(begin, end, smaller);
    const auto& poses = r.aligned.estimate;
    const auto index = static_cast<std::size_t>(largest - r.errors.begin());
    const double seconds = toSeconds(poses[index].stamp_ns - poses.front().stamp_ns);
    series.points.push_back({seconds, (*largest).*member * factor});
  }
  return series;
}

PlotPanel topView(const EvaluationReport& r)
{
  return {
      "Top view, aligned: " + toString(r.options.alignment),
      "x [m]",
      "y [m]",
      {pathFromAbove(r.aligned.reference, "reference", kReferenceColour, 5.0),
       pathFromAbove(r.aligned.estimate, "estimate", kEstimateColour, 1.5)},
      true,
      false};
}

PlotPanel errorPanel(const char* title, const char* unit, PlotSeries series)
{
  return {title, "time [s]", unit, {std::move(series)}, false, true};
}

}  // namespace

std::string toSvg(const EvaluationReport& report)
{
  const PlotPanel translation = errorPanel(
      "Absolute translation error", "[m]", errorOverTime(report, &PoseError::translation, 1.0));
  const PlotPanel rotation = errorPanel(
      "Absolute rotation error", "[deg]",
      errorOverTime(report, &PoseError::rotation, toDegrees(1.0)));
  const double rotation_top = kTopViewHeight + kErrorHeight;
  return svgDocument(
      kWidth, rotation_top + kErrorHeight,
      drawPanel(topView(report), {0.0, 0.0, kWidth, kTopViewHeight}) +
          drawPanel(translation, {0.0, kTopViewHeight, kWidth, kErrorHeight}) +
          drawPanel(rotation, {0.0, rotation_top, kWidth, kErrorHeight}));
}

}  // namespace fastlio
