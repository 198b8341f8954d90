// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file tuning_result.h The result of a search, as table, parameter file and JSON. */
#pragma once

#include "trials.h"
#include <fastlio/tuning/statistics.h>

#include <string>
#include <vector>

namespace fastlio
{
struct TuningResult
{
  Trials trials;                      //!< of the search on all recordings
  std::size_t best = 0;               //!< of those trials
  std::vector<Candidate> chosen;      //!< per recording: values that the others choose
  JudgedRuns left_out;                //!< their runs on it
  std::vector<std::string> failures;  //!< reasons, each once
  Conclusion conclusion = Conclusion::NothingBetter;
  std::vector<KeyEffect> effects;
  std::vector<std::string> at_base;  //!< keys that keep the base's value: others may be chance
};

/** The effect of each key: of `each`, error by error of the base per value; else main effects. */
[[nodiscard]] std::vector<KeyEffect> effectsOf(
    const TuneCommand& command, const SearchInputs& inputs, const Trials& trials);

/** For the terminal. */
[[nodiscard]] std::string toTable(
    const TuneCommand& command, const SearchInputs& inputs, const TuningResult& result);

/** With which every parameter file of the program begins. */
inline constexpr const char* kParameterMark = "# Chosen by fastlio-tune ";

/** The parameters, with what speaks for them as comments. */
[[nodiscard]] std::string toParameterFile(
    const TuneCommand& command, const SearchInputs& inputs, const TuningResult& result);

[[nodiscard]] std::string toJson(
    const TuneCommand& command, const SearchInputs& inputs, const TuningResult& result);
}  // namespace fastlio
