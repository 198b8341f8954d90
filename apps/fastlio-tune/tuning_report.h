// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file tuning_report.h The result of a search, as a page. */
#pragma once

#include "tuning_result.h"

#include <string>

namespace fastlio
{
/** With which the titles of its pages begin. */
inline constexpr const char* kPageTitle = "Tuning: ";

/** One file that opens offline: conclusion, errors per recording, every set, every key. */
[[nodiscard]] std::string toPage(
    const TuneCommand& command, const SearchInputs& inputs, const TuningResult& result);
}  // namespace fastlio
