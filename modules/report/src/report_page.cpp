// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "report_charts.h"
#include <fastlio/math/angles.h>
#include <fastlio/options/number_text.h>
#include <fastlio/plot/report_figure.h>
#include <fastlio/report/report_page.h>

#include <filesystem>
#include <map>

namespace fastlio
{
namespace
{
std::string nameOfRun(const RunSummary& run)
{
  if (run.inputs.empty()) return "run";
  const std::string first = std::filesystem::path(run.inputs.front().path).filename().string();
  const std::size_t further = run.inputs.size() - 1;
  return further == 0 ? first : first + " and " + std::to_string(further) + " more";
}

std::string optionRow(const OptionText& option, const std::string* standard)
{
  return "<tr><td><code>" + htmlText(option.key) + "</code></td><td>" + htmlText(option.text) +
         "</td>" + (standard != nullptr ? "<td>" + htmlText(*standard) + "</td>" : "") + "</tr>\n";
}

std::string errorRow(const char* name, const char* unit, const ErrorStatistics& s, double factor)
{
  if (s.count == 0) return {};
  return "<tr><th>" + std::string(name) + " [" + unit + "]</th><td class=\"n\">" +
         fixedText(s.rmse * factor, 4) + "</td><td class=\"n\">" + fixedText(s.median * factor, 4) +
         "</td><td class=\"n\">" + fixedText(s.max * factor, 4) + "</td></tr>\n";
}

// Errors of neighbouring poses are nearly the same: one bad stretch of a good run has a tenth of
// them beyond the bound of 95 %.
constexpr double kFewInside = 0.9;

std::string neesSentence(const NeesSummary& nees)
{
  return "<p>NEES of the pose: " + fixedText(nees.mean, 2) + " (" + std::to_string(nees.degrees) +
         " is expected); " + fixedText(100.0 * nees.coverage, 1) +
         " % of the poses lie below the 95 % bound. " +
         (nees.coverage < kFewInside
              ? "The errors of this run are larger than the covariance says."
              : "The errors of this run are as the covariance says, or smaller.") +
         "</p>\n";
}

std::string errorTableHtml(const EvaluationReport& r)
{
  return "<table>\n<tr><th></th><th class=\"n\">RMSE</th><th class=\"n\">median</th>"
         "<th class=\"n\">max</th></tr>\n" +
         errorRow("APE, translation", "m", r.ape.translation, 1.0) +
         errorRow("APE, rotation", "deg", r.ape.rotation, kDegPerRad) +
         errorRow("RPE over 1 s, translation", "m/s", r.rpe_second.translation, 1.0) +
         errorRow("RPE over 1 s, rotation", "deg/s", r.rpe_second.rotation, kDegPerRad) +
         "</table>\n";
}

/** Everything that the same input gives again. */
std::string resultsHtml(const ReportContent& content)
{
  const RunSummary& run = content.run;
  return sectionHtml("The run", factsHtml(run), "facts") +
         sectionHtml(
             "Stretches not to rely on", untrustedHtml(run.statistics.health()), "untrusted") +
         sectionHtml("Trajectory and map", figureGrid(mapFigures(content.map)), "map") +
         (content.reference.file.empty()
              ? ""
              : sectionHtml(
                    "Against the reference",
                    referenceHtml(content.reference) +
                        figureGrid(errorCharts(content.reference, content.series)),
                    "reference")) +
         sectionHtml("Over time", figureGrid(timeCharts(content.series)), "charts") +
         sectionHtml("Diagnostics", diagnosticsHtml(run), "diagnostics") +
         sectionHtml("Dropped data", lossesHtml(run), "losses") +
         sectionHtml("Sensors", sensorsHtml(run), "sensors") +
         sectionHtml("Check of the calibration", calibrationHtml(run), "calibration") +
         sectionHtml("Parameters", parametersHtml(run), "parameters") +
         sectionHtml("Causes of trouble", adviceHtml(), "advice");
}
}  // namespace

std::string parametersHtml(const RunSummary& run)
{
  std::map<std::string, std::string> standard;
  for (const OptionText& option : run.defaults)
    standard[option.key] = option.text;
  std::string changed, all;
  for (const OptionText& option : run.options)
  {
    all += optionRow(option, nullptr);
    const auto found = standard.find(option.key);
    if (found != standard.end() && found->second != option.text)
      changed += optionRow(option, &found->second);
  }
  const std::string differing =
      changed.empty()
          ? "<p>All parameters have their default values.</p>\n"
          : "<div class=\"wide\"><table>\n<tr><th>key</th><th>value</th><th>default</th></tr>\n" +
                changed + "</table></div>\n";
  return (standard.empty() ? "" : differing) +
         "<details><summary>All parameters</summary><div class=\"wide\"><table>\n" + all +
         "</table></div></details>\n";
}

std::string referenceHtml(const ReferenceFindings& findings)
{
  const std::string file = "<code>" + htmlText(findings.file) + "</code>";
  if (!findings.report)
    return "<p>The reference " + file + " could not be used: " + htmlText(findings.problem) +
           "</p>\n";
  const EvaluationReport& r = *findings.report;
  std::string html =
      "<p>" + file + ": " + countText(r.association.used) + " of " +
      countText(r.association.estimated) + " poses have a reference, " +
      fixedText(100.0 * r.association.coverage, 1) +
      " % of its time. Alignment of APE: " + toString(r.options.alignment) +
      "; errors over time are relative to the first pose. Both are taken as poses of the "
      "body \u201c" +
      htmlText(findings.body) + "\u201d (--frame).</p>\n";
  if (findings.poses_per_sample > 1)
    html += "<p>The run is long: of each " + std::to_string(findings.poses_per_sample) +
            " poses one is compared. fastlio-eval compares all.</p>\n";
  return html + errorTableHtml(r) + (r.nees ? neesSentence(r.nees->pose) : "");
}

std::string reportPage(const ReportContent& content)
{
  const RunSummary& run = content.run;
  const std::string measured = measuredFactsHtml(run) + figureGrid(measuredCharts(content.series));
  const RunVerdict verdict = verdictOf(run);
  Page page;
  page.title = nameOfRun(run) + ": report";
  page.tone = verdict.tone;
  page.headline = verdict.headline;
  page.headline_id = "verdict";
  page.source = nameOfRun(run) + ", " + run.program + " " + run.version +
                ", parameters: " + run.configuration;
  page.details = verdict.details;
  page.content = resultsHtml(content) +
                 "<!-- measured: these numbers differ from run to run -->\n" +
                 sectionHtml("Time and memory", measured, "measured");
  return pageHtml(page);
}

}  // namespace fastlio
