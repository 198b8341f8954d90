// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "units.h"
#include <fastlio/evaluation/report.h>

#include <array>
#include <cstdio>

namespace fastlio
{
namespace
{
/** printf into a string. */
template <typename... Args>
std::string format(const char* pattern, const Args&... args)
{
  const int size = std::snprintf(nullptr, 0, pattern, args...);
  std::string text(static_cast<std::size_t>(size) + 1, '\0');
  std::snprintf(text.data(), text.size(), pattern, args...);
  text.pop_back();
  return text;
}

std::string describeAlignment(const EvaluationReport& r)
{
  const Pose& T = r.alignment.T_ref_est;
  std::string text = toString(r.options.alignment);
  if (r.options.alignment == Alignment::None) return text;
  text += format(
      ": rotated by %.3f deg, moved by (%.3f, %.3f, %.3f) m", toDegrees(rotationAngle(T.R)),
      T.p.x(), T.p.y(), T.p.z());
  if (r.options.alignment == Alignment::Sim3) text += format(", scaled by %.6f", r.alignment.scale);
  return text;
}

std::string holeText(const AssociationCounts& c)
{
  return c.longest_hole > 0.0 ? format("; longest hole %.2f s", c.longest_hole) : "";
}

std::string turnText(const EvaluationReport& r)
{
  if (!r.uncertain_turn) return {};
  return format(
      "            The path is nearly straight: its positions leave a turn of up to %.0f deg\n"
      "            about it open, which is in the APE of the rotation. Use --align yaw or first.\n",
      toDegrees(*r.uncertain_turn));
}

std::string header(const EvaluationReport& r)
{
  const AssociationCounts& c = r.association;
  return format("reference   %s\n", r.reference_source.c_str()) +
         format("estimate    %s\n", r.estimate_source.c_str()) +
         format(
             "poses       %zu of %zu used; %zu before, %zu after, %zu in gaps of the reference\n",
             c.used, c.estimated, c.before, c.after, c.in_gap) +
         format(
             "run         %.2f s, %.2f m; %.1f %% of the reference's time%s\n", r.duration,
             r.drift.path_length, toPercent(c.coverage), holeText(c).c_str()) +
         "alignment   " + describeAlignment(r) + "\n" + turnText(r);
}

std::string statisticsRow(
    const std::string& name, const char* unit, const ErrorStatistics& s, double factor)
{
  const std::string begin = format("%-26s %-6s", name.c_str(), unit);
  if (s.count == 0) return begin + "   (the run is shorter than the span)\n";
  return begin + format(
                     " %9.4f %9.4f %9.4f %9.4f %9.4f %7zu\n", s.rmse * factor, s.mean * factor,
                     s.median * factor, s.max * factor, s.std * factor, s.count);
}

std::string errorTable(const EvaluationReport& r)
{
  const double deg = toDegrees(1.0);
  const std::string second = format("over %g s", r.options.rpe_seconds);
  const std::string metre = format("over %g m", r.options.rpe_metres);
  return format(
             "%-26s %-6s %9s %9s %9s %9s %9s %7s\n", "error", "unit", "RMSE", "mean", "median",
             "max", "std", "count") +
         statisticsRow("APE translation", "m", r.ape.translation, 1.0) +
         statisticsRow("APE rotation", "deg", r.ape.rotation, deg) +
         statisticsRow("RPE translation " + second, "m/s", r.rpe_second.translation, 1.0) +
         statisticsRow("RPE rotation " + second, "deg/s", r.rpe_second.rotation, deg) +
         statisticsRow("RPE translation " + metre, "%", r.rpe_metre.translation, 100.0) +
         statisticsRow("RPE rotation " + metre, "deg/m", r.rpe_metre.rotation, deg);
}

std::string segmentRow(const std::string& name, const SegmentError& s)
{
  return format(
      "%-26s %14.4f %14.4f %10zu\n", name.c_str(), toPercent(s.translation), toDegrees(s.rotation),
      s.count);
}

std::string segmentTable(const EvaluationReport& r)
{
  if (!r.segment_average) return "segments: none fits into the path\n";
  std::string text =
      format("%-26s %14s %14s %10s\n", "segments", "translation %", "deg/m", "count");
  for (const SegmentError& s : r.segments)
    text += segmentRow(format("%g m", s.length), s);
  return text + segmentRow("all", *r.segment_average);
}

std::string driftLine(const EndToEndDrift& d)
{
  const auto ratio = d.ratio();
  const std::string fraction =
      ratio ? format("%.4f %% of %.2f m", toPercent(*ratio), d.path_length) : "no path";
  return format(
      "end-to-end drift           %.4f m (%s), %.4f deg\n", d.error.translation, fraction.c_str(),
      toDegrees(d.error.rotation));
}

const char* verdict(const NeesSummary& s)
{
  if (s.meanInside()) return "consistent";
  return s.mean > s.mean_upper ? "overconfident" : "pessimistic";
}

std::string neesRow(const char* name, const NeesSummary& s)
{
  return format(
      "%-26s %9.3f %9d   %8.3f .. %-8.3f %11.1f %%  %s\n", name, s.mean, s.degrees, s.mean_lower,
      s.mean_upper, toPercent(s.coverage), verdict(s));
}

std::string neesTable(const EvaluationReport& r)
{
  if (!r.nees) return {};
  std::string text = format(
      "\n%-26s %9s %9s   %-20s %13s\n", "NEES", "mean", "expected", "95 % bounds of mean",
      "below 95 %");
  text += neesRow("pose", r.nees->pose) + neesRow("position", r.nees->position) +
          neesRow("rotation", r.nees->rotation);
  if (r.nees->singular > 0)
    text +=
        format("left out: %zu poses whose covariance is not positive definite\n", r.nees->singular);
  return text;
}

std::string gateLines(const std::vector<GateResult>& gates)
{
  std::string text = gates.empty() ? "" : "\n";
  for (const GateResult& g : gates)
    text += format(
        "%s  %-22s %.6g %s (limit %.6g)\n", g.passed ? "passed" : "FAILED", g.name.c_str(),
        g.measured, g.unit.c_str(), g.limit);
  return text;
}

}  // namespace

std::string toTable(const EvaluationReport& report, const std::vector<GateResult>& gates)
{
  return header(report) + "\n" + errorTable(report) + "\n" + segmentTable(report) + "\n" +
         driftLine(report.drift) + neesTable(report) + gateLines(gates);
}

}  // namespace fastlio
