// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "tuning_report.h"

#include "tuning_text.h"
#include <fastlio/config/config.h>
#include <fastlio/options/number_text.h>
#include <fastlio/plot/report_figure.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace fastlio
{
namespace
{
constexpr PlotRectangle kHalf{0, 0, 440, 280};
// Sets that are far worse would leave no height for those that matter.
constexpr double kHighestRatio = 3.0;
constexpr const char* kEach = "var(--s1)";
constexpr const char* kBest = "var(--s2)";
constexpr const char* kBeyond = "var(--soft)";

/** Mean ratio of each set; nothing where a run was lost or failed. */
std::vector<double> ratiosOf(const SearchInputs& inputs, const TuningResult& result)
{
  const auto all = allRecordings(inputs);
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
  panel.from_zero = true;
  return panel;
}

/** A set's error. Beyond the axis it is drawn at its end, and the axis says so. */
void addRatio(PlotPanel& panel, double x, double ratio, const char* colour)
{
  const bool beyond = ratio > kHighestRatio;
  panel.marks.push_back({{x, std::min(ratio, kHighestRatio)}, "", beyond ? kBeyond : colour});
  if (!beyond || panel.y_range) return;
  panel.y_range = PlotRange{0.0, 1.05 * kHighestRatio};
  for (double at = 0.0; at < kHighestRatio; at += 1.0)
    panel.y_ticks.push_back({at, tickText(at)});
  panel.y_ticks.push_back({kHighestRatio, "\u2265 " + tickText(kHighestRatio)});
}

std::vector<LegendEntry> legendOf(const PlotPanel& panel, std::vector<LegendEntry> legend)
{
  if (panel.y_range)
    legend.push_back({fixedText(kHighestRatio, 0) + " or more, drawn at the top", kBeyond});
  return legend;
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
    addRatio(panel, at, ratios[i], kEach);
    least = std::min(least, ratios[i]);
    best.points.push_back({at, std::min(least, kHighestRatio)});
  }
  panel.series = {best};
  return figureHtml(
      panel, kHalf, "Course of the search",
      legendOf(panel, {{"a set", kEach}, {"best so far", kBest}}),
      "Geometric means over the recordings. Set 0 is the base, set 1 has the defaults of the "
      "searched keys." +
          std::string(
              lost == 0
                  ? ""
                  : " Sets with a lost or failed run are left out: " + std::to_string(lost) + "."));
}

/** A number, or the place in the list of a value that is none. */
double numberOf(const SearchKey& key, const std::string& value)
{
  if (const auto number = parsed<double>(value))
    return key.logarithmic ? std::log10(*number) : *number;
  const auto found = std::find(key.values.begin(), key.values.end(), value);
  return static_cast<double>(found - key.values.begin());
}

bool isNumber(const std::string& value)
{
  return parsed<double>(value).has_value();
}

/** " [m]", or nothing. */
std::string unitOf(const std::string& key)
{
  const auto* row = findOption(configTable(), key);
  return row == nullptr || row->unit.empty() ? "" : " [" + std::string(row->unit) + "]";
}

/** 1, 2 and 5 times the powers of ten, where there is room; at their logarithms. */
std::vector<PlotTick> logarithmicTicks(const SearchKey& key)
{
  constexpr std::size_t kMost = 6;
  const auto ticksOf = [&key](const std::vector<double>& steps)
  {
    std::vector<PlotTick> ticks;
    for (double power = std::pow(10.0, std::floor(std::log10(key.min))); power <= key.max;
         power *= 10.0)
      for (const double step : steps)
        if (const double value = power * step;
            value >= (1.0 - 1e-9) * key.min && value <= (1.0 + 1e-9) * key.max)
          ticks.push_back({std::log10(value), tickText(value)});
    return ticks;
  };
  const std::vector<PlotTick> all = ticksOf({1.0, 2.0, 5.0});
  return all.size() <= kMost ? all : ticksOf({1.0});
}

/** Texts for an axis whose places are no values themselves. */
std::vector<PlotTick> ticksOf(const SearchKey& key)
{
  std::vector<PlotTick> ticks;
  if (key.values.empty()) return key.logarithmic ? logarithmicTicks(key) : ticks;
  if (std::all_of(key.values.begin(), key.values.end(), isNumber)) return ticks;
  for (std::size_t v = 0; v < key.values.size(); ++v)
    ticks.push_back({static_cast<double>(v), key.values[v]});
  return ticks;
}

std::string keyFigure(
    const SearchInputs& inputs, const TuningResult& result, const std::vector<double>& ratios,
    std::size_t k)
{
  const SearchKey& key = inputs.space[k];
  PlotPanel panel =
      ratioPanel(key.key + unitOf(key.key) + (key.logarithmic ? ", logarithmic" : ""));
  panel.x_ticks = ticksOf(key);
  // The base and the defaults may lie beside the range.
  const bool is_scale = key.values.empty() && key.logarithmic;
  PlotRange range{0.0, 0.0};
  if (is_scale) range = {std::log10(key.min), std::log10(key.max)};
  for (std::size_t i = 0; i < ratios.size(); ++i)
  {
    if (std::isnan(ratios[i])) continue;
    const double x = numberOf(key, result.trials.sets[i].values[k]);
    if (std::isfinite(x)) range = {std::min(range.low, x), std::max(range.high, x)};
    addRatio(panel, x, ratios[i], i == result.best ? kBest : kEach);
  }
  const double margin = 0.03 * (range.high - range.low);
  if (is_scale) panel.x_range = PlotRange{range.low - margin, range.high + margin};
  if (!panel.x_ticks.empty() && !is_scale && range.high >= static_cast<double>(key.values.size()))
    panel.x_ticks.push_back({static_cast<double>(key.values.size()), "other"});
  return figureHtml(
      panel, kHalf, key.key, legendOf(panel, {{"a set", kEach}, {"the best", kBest}}), "");
}

std::string inOneLine(std::string text)
{
  while (!text.empty() && text.back() == '\n')
    text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string recordingsTable(const SearchInputs& inputs, const TuningResult& result)
{
  const JudgedRuns& base = result.trials.runs.front();
  const JudgedRuns& best = result.trials.runs[result.best];
  std::vector<std::vector<std::string>> rows;
  for (std::size_t r = 0; r < base.size(); ++r)
    rows.push_back(
        {fileNameOf(inputs.recordings[r].path), textOf(base[r]), textOf(best[r]),
         ratioText(base[r], best[r]),
         result.left_out.empty() ? "-" : ratioText(base[r], result.left_out[r])});
  return tableHtml({"recording", "base", "best", "ratio", "left out"}, rows) +
         "<p><i>left out</i>: the ratio of the parameters that the other "
         "recordings choose. It shows what to expect on a recording that took no part.</p>\n";
}

std::string keysTable(const SearchInputs& inputs, const TuningResult& result)
{
  const Candidate& before = result.trials.sets.front().values;
  const Candidate& after = result.trials.sets[result.best].values;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < inputs.space.size(); ++k)
  {
    const std::string& name = inputs.space[k].key;
    const auto effect = std::find_if(
        result.effects.begin(), result.effects.end(),
        [&name](const KeyEffect& one) { return one.key == name; });
    const bool has_effect = effect != result.effects.end();
    rows.push_back(
        {name + unitOf(name), before[k], after[k], has_effect ? sizeText(*effect) : "",
         has_effect ? levelsText(*effect) : ""});
  }
  return tableHtml({"key", "base", "best", "effect", "errors per values"}, rows);
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
      {kPageTitle + fileNameOf(command.files.space),
       result.conclusion == Conclusion::Better ? "good" : "warn",
       inOneLine(conclusionText(command, result)), inputText(command, result),
       sectionHtml(
           "Errors, " + nameWithUnit(inputs.measure),
           recordingsTable(inputs, result) + notesHtml({costText(inputs, result)})) +
           sectionHtml(
               "Keys", "<p>Effect: " + htmlText(effectsTitle(command)) + ".</p>\n" +
                           keysTable(inputs, result) + notesHtml({atBaseText(result)}) + "<br/>\n" +
                           figureGrid(figures)) +
           sectionHtml("Search", figureGrid(courseFigure(ratios))) +
           (result.failures.empty() ? "" : sectionHtml("Failures", notesHtml(result.failures)))});
}
}  // namespace fastlio
