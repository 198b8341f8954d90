// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "report_advice.h"
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/plot/report_figure.h>
#include <fastlio/report/report_page.h>

#include <algorithm>

namespace fastlio
{
namespace
{
constexpr double kLongStart = 1.0 / 3.0;  // a start that takes this part of a run is no success

std::string paragraph(const std::string& html)
{
  return "<p>" + html + "</p>\n";
}

double untrustedSeconds(const std::vector<UntrustedStretch>& stretches)
{
  double seconds = 0.0;
  for (const UntrustedStretch& stretch : stretches)
    seconds += stretch.end_s - stretch.begin_s;
  return seconds;
}

/** Its meaning, advice, and a link to the document. */
std::string adviceParagraphs(HealthCause cause)
{
  const HealthAdvice advice = adviceOf(cause);
  if (cause == HealthCause::None) return {};
  return paragraph(causeLink(cause) + ": " + htmlText(advice.meaning)) +
         paragraph("<b>Try:</b> " + htmlText(advice.remedy));
}

std::string firstTroubleHtml(const RunHealth::Trouble& first)
{
  return paragraph(
             "<b>First bad second: " + fixedText(first.second, 1) + " s</b> (stamp " +
             secondsText(first.stamp_ns) + ", scan " + std::to_string(first.scan) +
             "): " + htmlText(first.health.reason)) +
         adviceParagraphs(first.health.cause);
}

RunVerdict withoutPose(const RunStatistics& statistics)
{
  const auto trouble = statistics.firstTrouble();
  const std::string why =
      statistics.scans() == 0
          ? "No scan could be processed: no inertial samples cover a scan. Check that both sensors "
            "recorded at the same time and that their clocks agree."
          : "The odometry never initialised" + (trouble ? ": " + trouble->message : std::string()) +
                ".";
  return {
      "bad", "There is no pose: nothing of this run can be used.",
      paragraph(htmlText(why)) + adviceParagraphs(HealthCause::Starting)};
}

RunVerdict withoutMap()
{
  return {
      "bad", "There is no map: nothing of this run can be used.",
      paragraph(
          "No point of any scan joined it. Check the pose of the LiDAR (input.T_vehicle_lidar), "
          "and the unit of its points.")};
}

std::string untrustedTime(const std::vector<UntrustedStretch>& stretches, double duration)
{
  const std::string number = std::to_string(stretches.size());
  return fixedText(untrustedSeconds(stretches), 1) + " of " + fixedText(duration, 1) +
         " s of this run (" + number + (stretches.size() == 1 ? " stretch)" : " stretches)");
}

/** Of the longest stretch, where the first trouble names no cause. */
std::string longestStretchHtml(const RunHealth& health, const std::vector<UntrustedStretch>& all)
{
  const auto shorter = [](const UntrustedStretch& a, const UntrustedStretch& b)
  { return a.end_s - a.begin_s < b.end_s - b.begin_s; };
  const auto longest = std::max_element(all.begin(), all.end(), shorter);
  const auto& first = health.firstTrouble();
  if (longest == all.end() || (first && first->health.cause == longest->cause)) return {};
  return paragraph(
             "<b>Longest stretch: " + fixedText(longest->begin_s, 1) + " to " +
             fixedText(longest->end_s, 1) + " s</b>: " + htmlText(longest->reason)) +
         adviceParagraphs(longest->cause);
}

/** Behind the headline, where also poses that can be trusted may be far away. */
std::string uncertainEnd(const RunStatistics& statistics)
{
  constexpr double kFar = 1.0;  // [m]
  const double std = statistics.endPositionStd();
  return std < kFar ? std::string()
                    : " The place of its end is uncertain by " + fixedText(std, 1) + " m.";
}

RunVerdict ofHealth(const RunStatistics& statistics)
{
  const RunHealth& health = statistics.health();
  const auto stretches = health.untrusted();
  const auto& first = health.firstTrouble();
  const std::string details =
      (first ? firstTroubleHtml(*first) : std::string()) + longestStretchHtml(health, stretches);
  if (statistics.count(ScanStatus::Diverged) > 0)
    return {
        "bad",
        "The odometry lost its pose: do not rely on " +
            untrustedTime(stretches, statistics.duration()) + ".",
        details};
  if (!stretches.empty())
    return {
        "warn", "Do not rely on " + untrustedTime(stretches, statistics.duration()) + ".", details};
  const std::string scans = countText(health.scans()) + " scans";
  const std::size_t starting = statistics.count(ScanStatus::Initializing);
  if (static_cast<double>(starting) > kLongStart * static_cast<double>(statistics.scans()))
    return {
        "warn",
        "What there is can be trusted, but " + countText(starting) + " of " +
            countText(statistics.scans()) +
            " scans have no pose: the odometry waited for its start.",
        details + adviceParagraphs(HealthCause::Starting)};
  if (first)
    return {
        "good",
        "The run can be trusted: of " + scans + ", " + countText(health.troubled()) +
            " were in trouble, none of them for long.",
        details};
  return {"good", "The run can be trusted: none of " + scans + " was in trouble.", ""};
}

/** Further problems. */
std::vector<std::string> furtherProblems(const RunSummary& run)
{
  std::vector<std::string> sentences;
  if (run.interrupted) sentences.emplace_back("The run was interrupted: results end there.");
  if (!run.failure.empty()) sentences.push_back(run.failure);
  for (const auto* problems : {&run.input_problems, &run.output_problems})
    sentences.insert(sentences.end(), problems->begin(), problems->end());
  return sentences;
}
}  // namespace

RunVerdict verdictOf(const RunSummary& run)
{
  const RunStatistics& statistics = run.statistics;
  RunVerdict verdict = statistics.poses() == 0          ? withoutPose(statistics)
                       : statistics.health().hasNoMap() ? withoutMap()
                                                        : ofHealth(statistics);
  const std::vector<std::string> problems = furtherProblems(run);
  std::string text;
  for (const std::string& problem : problems)
    text += paragraph(htmlText(problem));
  if (verdict.tone != "good")
    for (const std::string& loss : lossSentences(run))
      text += paragraph(htmlText(loss + "."));
  verdict.details = text + verdict.details;
  if (verdict.tone != "good" && !run.diagnostics.empty())
    verdict.details += paragraph("See also the <a href=\"#diagnostics\">diagnostics</a> below.");
  if (!problems.empty() && verdict.tone == "good")
  {
    verdict.tone = "warn";
    verdict.headline = run.interrupted ? "The run was interrupted. What there is can be trusted."
                                       : "The run is not complete. What there is can be trusted.";
  }
  if (!statistics.health().hasNoMap()) verdict.headline += uncertainEnd(statistics);
  return verdict;
}

}  // namespace fastlio
