// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "tuning_result.h"

#include "tuning_text.h"
#include <fastlio/options/json_text.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace fastlio
{
namespace
{
constexpr std::size_t kColumn = 20;
constexpr std::size_t kRatioColumn = 17;
constexpr std::size_t kShownFailures = 5;
constexpr std::size_t kLongestFailure = 600;

std::string padded(const std::string& text, std::size_t width = kColumn)
{
  return text + std::string(text.size() < width ? width - text.size() : 1, ' ');
}

/** Keys whose values differ from those of the base. */
std::string changesText(
    const SearchInputs& inputs, const TuningResult& result, const std::string& indent)
{
  const Candidate& before = result.trials.sets[0].values;
  const Candidate& after = result.trials.sets[result.best].values;
  std::string text;
  for (std::size_t k = 0; k < inputs.space.size(); ++k)
    if (before[k] != after[k])
      text += indent + inputs.space[k].key + ": " + before[k] + " -> " + after[k] + "\n";
  if (text.empty()) text = indent + "none\n";
  const std::string kept = atBaseText(result);
  return kept.empty() ? text : text + indent + kept + "\n";
}

std::string effectsText(const TuningResult& result, const std::string& indent)
{
  std::string text;
  for (const KeyEffect& effect : result.effects)
    text += indent + effect.key + ": " + sizeText(effect) + ";" +
            (effect.levels.empty() ? "" : " ") + levelsText(effect) + "\n";
  return text;
}

std::string failuresText(const TuningResult& result)
{
  std::string text;
  for (std::size_t i = 0; i < std::min(result.failures.size(), kShownFailures); ++i)
    text += "Failed: " + printable(result.failures[i], kLongestFailure) + "\n";
  if (result.failures.size() > kShownFailures)
    text +=
        "... and " + std::to_string(result.failures.size() - kShownFailures) + " more reasons\n";
  return text;
}

std::vector<KeyEffect> eachEffects(const SearchInputs& inputs, const Trials& trials)
{
  const Candidate& base = trials.sets[0].values;
  const auto all = allRecordings(inputs);
  std::vector<KeyEffect> effects;
  for (std::size_t k = 0; k < inputs.space.size(); ++k)
  {
    KeyEffect effect{inputs.space[k].key, {}, 1.0, true};
    for (std::size_t i = 1; i < trials.sets.size(); ++i)
    {
      Candidate others = trials.sets[i].values;
      if (others[k] == base[k]) continue;
      const std::string value = std::exchange(others[k], base[k]);
      const Score score = scoreOf(trials.runs[0], trials.runs[i], all);
      if (others != base) continue;
      const bool lost = score.failed > 0 || score.lost > 0;
      effect.levels.push_back({value, 1, lost ? INFINITY : score.mean_ratio});
    }
    double low = 1.0;
    double high = 1.0;
    for (const KeyLevel& level : effect.levels)
      if (std::isfinite(level.mean_ratio))
        low = std::min(low, level.mean_ratio), high = std::max(high, level.mean_ratio);
    effect.effect = high / low;
    effects.push_back(effect);
  }
  return effects;
}

Json jsonOf(const Judged& run)
{
  Json json = {{"state", toText(run.state)}, {"error", nullptr}};
  if (run.error) json["error"] = *run.error;
  return json;
}

Json jsonOf(const SearchInputs& inputs, const Candidate& values)
{
  Json json = Json::object();
  for (std::size_t k = 0; k < inputs.space.size(); ++k)
    json[inputs.space[k].key] = values[k];
  return json;
}

std::string toText(Conclusion conclusion)
{
  switch (conclusion)
  {
    case Conclusion::Better:
      return "better";
    case Conclusion::WorseOnLeftOut:
      return "worse_on_left_out";
    case Conclusion::TooFewRecordings:
      return "too_few_recordings";
    default:
      return "nothing_better";
  }
}
}  // namespace

std::vector<KeyEffect> effectsOf(
    const TuneCommand& command, const SearchInputs& inputs, const Trials& trials)
{
  if (command.search.method == "each") return eachEffects(inputs, trials);
  const auto all = allRecordings(inputs);
  std::vector<TriedPoint> points;
  // The base and the defaults are no points of the search.
  for (std::size_t i = 1; i < trials.sets.size(); ++i)
  {
    const Score score = scoreOf(trials.runs[0], trials.runs[i], all);
    if (score.failed == 0 && score.lost == 0)
      points.push_back({trials.sets[i].values, score.mean_ratio});
  }
  return keyEffects(inputs.space, points);
}

std::string toTable(
    const TuneCommand& command, const SearchInputs& inputs, const TuningResult& result)
{
  const JudgedRuns& base = result.trials.runs[0];
  const JudgedRuns& best = result.trials.runs[result.best];
  std::string text = "Error: " + nameWithUnit(inputs.measure) +
                     "; left out: ratio of the parameters that the other recordings choose\n\n  " +
                     padded("base") + padded("best") + padded("ratio", kRatioColumn) +
                     padded("left out", kRatioColumn) + "recording\n";
  for (std::size_t r = 0; r < base.size(); ++r)
    text +=
        "  " + padded(textOf(base[r])) + padded(textOf(best[r])) +
        padded(ratioText(base[r], best[r]), kRatioColumn) +
        padded(
            result.left_out.empty() ? "-" : ratioText(base[r], result.left_out[r]), kRatioColumn) +
        printable(inputs.recordings[r].path) + "\n";
  text += "\nBest of " + std::to_string(result.trials.sets.size()) +
          " parameter sets, and what it changes:\n" + changesText(inputs, result, "  ") +
          "\nEffect of each key: " + effectsTitle(command) + "\n" + effectsText(result, "  ") +
          "\n" + failuresText(result) + costText(inputs, result);
  return text + conclusionText(command, result);
}

std::string toParameterFile(
    const TuneCommand& command, const SearchInputs& inputs, const TuningResult& result)
{
  const JudgedRuns& base = result.trials.runs[0];
  const JudgedRuns& best = result.trials.runs[result.best];
  std::string text =
      kParameterMark + programVersion() + " among " + std::to_string(result.trials.sets.size()) +
      " parameter sets (" + command.search.method + ", seed " +
      std::to_string(command.search.seed) + ").\n# Ratio of the error, " +
      nameWithUnit(inputs.measure) + ", to that of the base parameters (" +
      (command.files.base.empty() ? "the defaults" : fileNameOf(command.files.base)) +
      "),\n# and of what the other recordings alone choose:\n";
  for (std::size_t r = 0; r < base.size(); ++r)
    text += "#   " + padded(ratioText(base[r], best[r]), kRatioColumn) +
            padded(ratioText(base[r], result.left_out[r]), kRatioColumn) +
            fileNameOf(inputs.recordings[r].path) + "\n";
  text += "# Changes:\n" + changesText(inputs, result, "#   ") +
          "# Effect of each key: " + effectsTitle(command) + "\n" + effectsText(result, "#   ");
  return text + result.trials.sets[result.best].yaml;
}

std::string toJson(
    const TuneCommand& command, const SearchInputs& inputs, const TuningResult& result)
{
  Json json = {
      {"version", programVersion()},
      {"search", inputs.id},
      {"method", command.search.method},
      {"measure", inputs.measure},
      {"conclusion", toText(result.conclusion)},
      {"parameter_sets", result.trials.sets.size()},
      {"base", jsonOf(inputs, result.trials.sets[0].values)},
      {"best", jsonOf(inputs, result.trials.sets[result.best].values)},
      {"kept_at_base", result.at_base},
      {"failures", result.failures}};
  for (std::size_t r = 0; r < inputs.recordings.size(); ++r)
  {
    Json row = {
        {"path", inputs.recordings[r].path},
        {"base", jsonOf(result.trials.runs[0][r])},
        {"best", jsonOf(result.trials.runs[result.best][r])}};
    if (!result.left_out.empty())
    {
      row["left_out"] = jsonOf(result.left_out[r]);
      row["left_out_parameters"] = jsonOf(inputs, result.chosen[r]);
    }
    json["recordings"].push_back(row);
  }
  for (const KeyEffect& effect : result.effects)
  {
    Json levels = Json::array();
    for (const KeyLevel& level : effect.levels)
      levels.push_back(
          {{"values", level.values}, {"trials", level.trials}, {"mean_ratio", level.mean_ratio}});
    json["effects"].push_back(
        {{"key", effect.key},
         {"effect", effect.effect},
         {"certain", effect.certain},
         {"levels", levels}});
  }
  return jsonText(json);
}
}  // namespace fastlio
