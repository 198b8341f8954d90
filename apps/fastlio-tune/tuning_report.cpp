// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "tuning_report.h"

#include "tuning_text.h"
#include <fastlio/options/number_text.h>
#include <fastlio/plot/report_figure.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace fastlio
{
namespace
{
constexpr PlotRectangle kWide{0, 0, 900, 300};
constexpr PlotRectangle kHalf{0, 0, 440, 280};
// Sets that are far worse would leave no height for those that matter.
constexpr double kHighestRatio = 3.0;
constexpr const char* kEach = "var(--s1)";
constexpr const char* kBest = "var(--s2)";

/** Mean ratio of each set; nothing where a run was lost or failed. */
std::vector<double> ratiosOf(const SearchInputs& inputs, const TuningResult& result)
{
  const auto all = recordingsWithout(inputs, inputs.recordings.size());
  std::vector<double> ratios;
  for (const JudgedRuns& runs : result.trials.runs)
  {
    const Score score = scoreOf(result.trials.runs.front(), runs, all);
    const bool lost = score.failed > 0 || score.lost > 0;
    ratios.push_back(lost ? std::numeric_limits<double>::quiet_NaN() : score.mean_ratio);
  }
  return ratios;
}

PlotPanel ratioPanel(const std::string& x_label)
{
  PlotPanel panel;
  panel.x_label = x_label;
  panel.y_label = "error / error of the base";
  panel.bare = true;
  panel.from_zero = true;
  return panel;
}

std::string courseFigure(const std::vector<double>& ratios)
{
  PlotPanel panel = ratioPanel("parameter set, in the order of the search");
  PlotSeries best{"best so far", kBest, {}, 2.0};
  double least = std::numeric_limits<double>::infinity();
  std::size_t lost = 0;
  for (std::size_t i = 0; i < ratios.size(); ++i)
  {
    const auto at = static_cast<double>(i);
    if (std::isnan(ratios[i]))
    {
      ++lost;
      continue;
    }
    panel.marks.push_back({{at, std::min(ratios[i], kHighestRatio)}, "", kEach});
    least = std::min(least, ratios[i]);
    best.points.push_back({at, std::min(least, kHighestRatio)});
  }
  panel.series = {best};
  return figureHtml(
      panel, kWide, "Course of the search", {{"a set", kEach}, {"best so far", kBest}},
      "Geometric means over the recordings; larger ones than " + fixedText(kHighestRatio, 0) +
          " are drawn there. Set 0 is the base, set 1 has the defaults of the searched keys." +
          (lost == 0
               ? ""
               : " Sets with a lost or failed run are left out: " + std::to_string(lost) + "."));
}

/** A number, or the place in the list of a value that is none. */
double numberOf(const SearchKey& key, const std::string& value)
{
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (end != value.c_str() && *end == '\0') return key.logarithmic ? std::log10(number) : number;
  const auto found = std::find(key.values.begin(), key.values.end(), value);
  return static_cast<double>(found - key.values.begin());
}

bool isNumber(const std::string& value)
{
  char* end = nullptr;
  (void)std::strtod(value.c_str(), &end);
  return end != value.c_str() && *end == '\0';
}

std::string keyFigure(
    const SearchInputs& inputs, const TuningResult& result, const std::vector<double>& ratios,
    std::size_t k)
{
  const SearchKey& key = inputs.space[k];
  const bool numbers = std::all_of(key.values.begin(), key.values.end(), isNumber);
  PlotPanel panel = ratioPanel((key.logarithmic ? "log10 of " : "") + key.key);
  for (std::size_t i = 0; i < ratios.size(); ++i)
  {
    if (std::isnan(ratios[i])) continue;
    const double x = numberOf(key, result.trials.sets[i].values[k]);
    const bool is_best = i == result.best;
    panel.marks.push_back({{x, std::min(ratios[i], kHighestRatio)}, "", is_best ? kBest : kEach});
  }
  std::string note;
  for (std::size_t v = 0; !numbers && v < key.values.size(); ++v)
    note += (v == 0 ? "" : ", ") + std::to_string(v) + ": " + htmlText(key.values[v]);
  return figureHtml(panel, kHalf, key.key, {{"a set", kEach}, {"the best", kBest}}, note);
}

std::string inOneLine(std::string text)
{
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string cell(const std::string& text)
{
  return "<td>" + htmlText(text) + "</td>";
}

std::string recordingsTable(const SearchInputs& inputs, const TuningResult& result)
{
  const JudgedRuns& base = result.trials.runs.front();
  const JudgedRuns& best = result.trials.runs[result.best];
  std::string rows;
  for (std::size_t r = 0; r < base.size(); ++r)
    rows += "<tr>" + cell(fileNameOf(inputs.recordings[r].path)) + cell(textOf(base[r])) +
            cell(textOf(best[r])) + cell(ratioText(base[r], best[r])) +
            cell(result.left_out.empty() ? "-" : ratioText(base[r], result.left_out[r])) +
            "</tr>\n";
  return "<div class=\"wide\"><table>\n<tr><th>recording</th><th>base</th><th>best</th>"
         "<th>ratio</th><th>left out</th></tr>\n" +
         rows +
         "</table></div>\n<p><i>left out</i>: the ratio of the parameters that the other "
         "recordings choose. It shows what to expect on a recording that took no part.</p>\n";
}

std::string keysTable(const SearchInputs& inputs, const TuningResult& result)
{
  const Candidate& before = result.trials.sets.front().values;
  const Candidate& after = result.trials.sets[result.best].values;
  std::string rows;
  for (std::size_t k = 0; k < inputs.space.size(); ++k)
  {
    const std::string& name = inputs.space[k].key;
    const auto effect = std::find_if(
        result.effects.begin(), result.effects.end(),
        [&name](const KeyEffect& one) { return one.key == name; });
    std::string size, levels;
    if (effect != result.effects.end())
    {
      size = fixedText(effect->effect, 2) + (effect->certain ? "" : " (may be chance)");
      for (const KeyLevel& level : effect->levels)
        levels += (levels.empty() ? "" : ", ") + level.values + ": " +
                  (std::isfinite(level.mean_ratio) ? fixedText(level.mean_ratio, 2) : "lost");
    }
    rows += "<tr>" + cell(name) + cell(before[k]) + cell(after[k]) + cell(size) + cell(levels) +
            "</tr>\n";
  }
  return "<div class=\"wide\"><table>\n<tr><th>key</th><th>base</th><th>best</th>"
         "<th>effect</th><th>errors per values</th></tr>\n" +
         rows + "</table></div>\n";
}

std::string paragraphs(const std::vector<std::string>& texts)
{
  std::string html;
  for (const std::string& text : texts)
    if (!text.empty()) html += "<p class=\"note\">" + htmlText(text) + "</p>\n";
  return html;
}

std::string inputText(const TuneCommand& command, const TuningResult& result)
{
  return "fastlio-tune " + programVersion() + "; " + command.search.method + ", seed " +
         std::to_string(command.search.seed) + ", " + std::to_string(result.trials.sets.size()) +
         " parameter sets; base: " +
         (command.files.base.empty() ? "the defaults" : fileNameOf(command.files.base));
}
}  // namespace

std::string toPage(
    const TuneCommand& command, const SearchInputs& inputs, const TuningResult& result)
{
  const std::vector<double> ratios = ratiosOf(inputs, result);
  std::string figures;
  for (std::size_t k = 0; k < inputs.space.size(); ++k)
    figures += keyFigure(inputs, result, ratios, k);
  return pageHtml(
      {"Tuning: " + fileNameOf(command.files.space),
       result.conclusion == Conclusion::Better ? "good" : "warn",
       inOneLine(conclusionText(command, result)), inputText(command, result),
       sectionHtml(
           "Errors, " + nameWithUnit(inputs.measure),
           recordingsTable(inputs, result) + paragraphs({costText(inputs, result)})) +
           sectionHtml(
               "Keys", "<p>Effect: " + htmlText(effectsTitle(command)) + ".</p>\n" +
                           keysTable(inputs, result) + "<br/>\n<div class=\"grid-of\">\n" +
                           figures + "</div>\n") +
           sectionHtml("Search", courseFigure(ratios)) +
           (result.failures.empty() ? "" : sectionHtml("Failures", paragraphs(result.failures)))});
}
}  // namespace fastlio
