// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file search_inputs.h The checked inputs of a search. */
#pragma once

#include "command_line.h"
#include <fastlio/tuning/search_space.h>

#include <functional>
#include <set>

namespace fastlio
{
struct RecordingInput
{
  std::string path;   //!< canonical
  std::string truth;  //!< canonical; empty: there is none
};

struct SearchInputs
{
  SearchSpace space;
  Config base;
  std::set<std::string, std::less<>> base_keys;  //!< that the file gives, also at their defaults
  std::vector<RecordingInput> recordings;
  std::string measure;  //!< ape, rpe or proxy
  std::string id;       //!< digest of everything that outcomes and points depend on
};

/** Reads and checks all inputs, and that no output would destroy one.
 * \exception std::invalid_argument says what is wrong */
[[nodiscard]] SearchInputs readInputs(const TuneCommand& command);

/** The base as a parameter file. */
[[nodiscard]] std::string baseYaml(const SearchInputs& inputs);

/** A configuration of the search as a parameter file: it gives all searched keys, as the preset of
 * a sensor takes the place of what is not given. */
[[nodiscard]] std::string searchedYaml(const SearchInputs& inputs, const Config& config);

/** "ape [m]", "rpe [m/s]", "proxy". */
[[nodiscard]] std::string nameWithUnit(const std::string& measure);
}  // namespace fastlio
