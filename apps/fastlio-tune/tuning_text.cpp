// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "tuning_text.h"

#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/options/split_text.h>

#include <cmath>
#include <filesystem>

namespace fastlio
{
namespace
{
constexpr int kErrorDecimals = 4;
constexpr int kRatioDecimals = 3;
}  // namespace

std::string textOf(const Judged& run)
{
  std::string state = run.state == RunState::Complete ? "" : std::string(toText(run.state));
  if (!run.error) return state;
  return fixedText(*run.error, kErrorDecimals) + (state.empty() ? "" : " " + state);
}

std::string ratioText(const Judged& base, const Judged& run)
{
  const auto ratio = ratioOf(base, run);
  const std::string number = ratio ? fixedText(*ratio, kRatioDecimals) : "";
  if (run.state == base.state) return ratio ? number : "-";
  return (ratio ? number + " " : "") + std::string(toText(run.state));
}

std::string fileNameOf(const std::string& path)
{
  return printable(std::filesystem::path(path).filename().string());
}

std::string sizeText(const KeyEffect& effect)
{
  return fixedText(effect.effect, 2) + (effect.certain ? "" : " (may be chance)");
}

std::string levelsText(const KeyEffect& effect)
{
  std::string text;
  for (const KeyLevel& level : effect.levels)
    text += (text.empty() ? "" : ", ") + level.values + ": " +
            (std::isfinite(level.mean_ratio) ? fixedText(level.mean_ratio, 2) : "lost");
  return text;
}

std::string effectsTitle(const TuneCommand& command)
{
  return std::string("largest by smallest mean error; mean error per values, 1: of ") +
         (command.search.method == "each" ? "the base" : "all sets");
}

std::string atBaseText(const TuningResult& result)
{
  if (result.at_base.empty()) return {};
  return "at the base's value, as the effect may be chance and nothing gets worse: " +
         joined(result.at_base);
}

std::string conclusionText(const TuneCommand& command, const TuningResult& result)
{
  switch (result.conclusion)
  {
    case Conclusion::Better:
      return "Better parameters: " + command.files.output + "\n";
    case Conclusion::WorseOnLeftOut:
      return "Keep your parameters: those found are worse on a recording that took no part in the "
             "choice (column 'left out').\nMore recordings, or fewer keys, may help.\n";
    case Conclusion::TooFewRecordings:
      return "Keep your parameters: one recording cannot show that others gain too. Give more.\n";
    default:
      return "Keep your parameters: none were better by 5 % on recordings that took no part in the "
             "choice.\n";
  }
}

std::string costText(const SearchInputs& inputs, const TuningResult& result)
{
  const auto& runs = result.trials.runs;
  const auto all = allRecordings(inputs);
  std::size_t best = 0;
  for (std::size_t i = 1; i < runs.size(); ++i)
    if (scoreOf(runs[0], runs[i], all) < scoreOf(runs[0], runs[best], all)) best = i;
  std::string text;
  for (const std::size_t r : all)
    if (isWorse(runs[0][r], runs[best][r]))
      text += "Warning: a set with the mean ratio " +
              fixedText(scoreOf(runs[0], runs[best], all).mean_ratio, kRatioDecimals) +
              " was not taken, as it makes " + fileNameOf(inputs.recordings[r].path) +
              " worse: " + ratioText(runs[0][r], runs[best][r]) + "\n";
  return text;
}

}  // namespace fastlio
