// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file search_inputs.h What a search works on, checked. */
#pragma once

#include "command_line.h"
#include <fastlio/tuning/search_space.h>

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
  std::vector<RecordingInput> recordings;
  std::string measure;  //!< ape, rpe or proxy
  std::string id;       //!< digest of everything that outcomes and points depend on
};

/** Reads and checks all inputs, and that no output would destroy one.
 * \exception std::invalid_argument says what is wrong */
[[nodiscard]] SearchInputs readInputs(const TuneCommand& command);

/** "ape [m]", "rpe [m/s]", "proxy". */
[[nodiscard]] std::string nameWithUnit(const std::string& measure);
}  // namespace fastlio
