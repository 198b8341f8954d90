// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "report_advice.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/plot/report_figure.h>
#include <fastlio/report/report_page.h>

#include <algorithm>

namespace fastlio
{
namespace
{
struct TableRow
{
  std::string name;   //!< text
  std::string value;  //!< HTML
};

std::string tableOf(const std::vector<TableRow>& rows)
{
  std::string html = "<table>\n";
  for (const TableRow& row : rows)
    html += "<tr><th>" + htmlText(row.name) + "</th><td>" + row.value + "</td></tr>\n";
  return html + "</table>\n";
}

/** A list that stays readable. \param items HTML \param where all of them are, as text */
std::string listOfHtml(const std::vector<std::string>& items, const char* where)
{
  constexpr std::size_t kMost = 50;
  std::string html = "<ul>\n";
  for (std::size_t i = 0; i < std::min(kMost, items.size()); ++i)
    html += "<li>" + items[i] + "</li>\n";
  if (items.size() > kMost)
    html += "<li>and " + std::to_string(items.size() - kMost) + " more: " + where + "</li>\n";
  return html + "</ul>\n";
}

std::string listOf(const std::vector<std::string>& texts)
{
  std::vector<std::string> items;
  items.reserve(texts.size());
  for (const std::string& text : texts)
    items.push_back(htmlText(text));
  return listOfHtml(items, "summary.json");
}

std::string degenerateText(const DegenerateDirections& open)
{
  if (open.scans == 0) return "none";
  return countText(open.scans) + " scans; the weakest is a " + directionText(open.weakest);
}

std::string pointsText(const PointTotals& points)
{
  std::string text = countText(points.in) + " delivered, " + countText(points.downsampled) +
                     " after downsampling, " + countText(points.effective) + " matched";
  if (points.own_body > 0)
    text += "; " + countText(points.own_body) + " on the LiDAR's own carrier, left out";
  return text;
}

std::string imuText(const ImuReport& imu)
{
  const std::string longest =
      imu.gaps > 0 ? " (longest " + fixedText(imu.longest_gap, 3) + " s)" : "";
  return fixedText(imu.rate, 1) + " Hz, " + toString(imu.accel_unit) + ", " +
         toString(imu.gyro_unit) + "; gaps: " + countText(imu.gaps) + longest +
         ", samples missing: " + countText(imu.missing) + ", clipped: " + countText(imu.saturated) +
         ", spikes: " + countText(imu.spikes);
}

std::string vectorText(const Vec3& v, const Vec3& sigma, int decimals)
{
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += (i == 0 ? "" : ", ") + fixedText(v[i], decimals) + " \u00b1 " +
            fixedText(3.0 * sigma[i], decimals);
  return text;
}
std::string healthText(const RunHealth& health)
{
  if (health.scans() == 0) return "no pose";
  return "mean " + fixedText(health.mean(), 3) + ", worst " + fixedText(health.worst(), 3) + "; " +
         countText(health.troubled()) + " of " + countText(health.scans()) + " scans in trouble";
}
}  // namespace

std::string factsHtml(const RunSummary& run)
{
  const RunStatistics& s = run.statistics;
  return tableOf(
      {{"Status", statusText(exitStatusOf(run))},
       {"Time", fixedText(s.duration(), 3) + " s, from " + secondsText(s.beginNs()) + " to " +
                    secondsText(s.endNs())},
       {"Scans", htmlText(scanCountsText(s))},
       {"Poses", countText(s.poses()) + " of the body \u201c" + htmlText(run.frame) + "\u201d"},
       {"Path", fixedText(s.pathLength(), 3) + " m"},
       {"End known to", s.poses() > 0 ? endUncertaintyText(s) : "-"},
       {"Points", pointsText(s.points())},
       {"Health", healthText(s.health())},
       {"Degenerate directions", htmlText(degenerateText(s.degenerateDirections()))},
       {"Inertial data", htmlText(imuText(run.imu))}});
}

std::string untrustedHtml(const RunHealth& health)
{
  const auto stretches = health.untrusted();
  if (stretches.empty()) return "<p>None.</p>\n";
  std::vector<std::string> items;
  items.reserve(stretches.size());
  for (const UntrustedStretch& s : stretches)
    items.push_back(
        "<b>" + fixedText(s.begin_s, 1) + " to " + fixedText(s.end_s, 1) + " s</b> (" +
        countText(s.scans) + " scans), " + causeLink(s.cause) + ": " + htmlText(s.reason));
  return listOfHtml(items, "untrusted.csv");
}

std::string lossesHtml(const RunSummary& run)
{
  const std::vector<NamedCount> lost = losses(run);
  if (lost.empty()) return "<p>Nothing was dropped.</p>\n";
  std::vector<TableRow> rows;
  rows.reserve(lost.size());
  for (const NamedCount& count : lost)
    rows.push_back({count.name, countText(count.count)});
  return tableOf(rows);
}

std::string sensorsHtml(const RunSummary& run)
{
  std::vector<std::string> files;
  for (const InputFile& file : run.inputs)
    files.push_back(file.path + " (" + countText(file.bytes) + " bytes)");
  return "<h3>Recording</h3>\n" + listOf(files) + "<h3>Sensors and poses</h3>\n" +
         listOf(run.sensors);
}

std::string calibrationHtml(const RunSummary& run)
{
  if (run.statistics.poses() == 0) return "<p>No scan has a pose.</p>\n";
  const CalibrationCheck& check = run.statistics.calibration();
  return tableOf(
             {{"Pose of the LiDAR, error of rotation [deg]",
               vectorText(kDegPerRad * check.rotation, kDegPerRad * check.rotation_std, 3)},
              {"Pose of the LiDAR, error of translation [m]",
               vectorText(check.translation, check.translation_std, 4)},
              {"Innovations over their covariance", fixedText(check.innovation_scale, 3)},
              {"Beams: common range error [m]", fixedText(check.range_offset, 4)},
              {"Beams: common elevation error [deg]",
               fixedText(kDegPerRad * check.elevation_offset, 4)},
              {"Beams: common azimuth error [deg]",
               fixedText(kDegPerRad * check.azimuth_offset, 4)},
              {"Sides: common range error [m]", fixedText(check.side_range_offset, 4)}}) +
         "<p class=\"note\">How wrong the calibration in use seems to be by the innovations of the "
         "whole run, with three standard deviations. An error beyond them deserves a look at the "
         "pose of the LiDAR.</p>\n";
}

std::string diagnosticsHtml(const RunSummary& run)
{
  if (run.diagnostics.empty()) return "<p>None.</p>\n";
  std::vector<std::string> texts;
  for (const Diagnostic& diagnostic : run.diagnostics)
    texts.push_back(secondsText(diagnostic.stamp_ns) + ": " + diagnostic.text);
  return listOf(texts);
}

std::string measuredFactsHtml(const RunSummary& run)
{
  return tableOf(
      {{"Computation per scan", scanTimesText(run.statistics.scanTimes())},
       {"Speed", fixedText(realTimeFactor(run), 1) + " x real time"},
       {"Whole run", fixedText(run.wall_seconds, 2) + " s, of which " +
                         fixedText(run.statistics.computeSeconds(), 2) + " s odometry"}});
}

std::string adviceHtml()
{
  std::string html;
  for (const HealthCause cause : allHealthCauses())
  {
    const HealthAdvice advice = adviceOf(cause);
    const std::string name = toString(cause);  // of its section in the document, too
    html += "<h3 id=\"" + name + "\">" + name + "</h3>\n<p>" + htmlText(advice.meaning) +
            " <b>Try:</b> " + htmlText(advice.remedy) +
            " <span class=\"note\">More: docs/troubleshooting.md#" + name + "</span></p>\n";
  }
  return html;
}

}  // namespace fastlio
