// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file verdict.h Whether the best parameters also hold on recordings that did not choose them. */
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace fastlio
{
/** Error divided by that of the base, per candidate and recording. */
using Ratios = std::vector<std::vector<double>>;

struct Verdict
{
  std::size_t best =
      0;  //!< candidate with the smallest geometric mean, of those that are worse on none
  std::vector<double> left_out;  //!< per recording: ratio of the candidate that the others choose
  bool recommended = false;      //!< better on the recordings left out, worse on none of them
};

/** Geometric mean. */
[[nodiscard]] double meanRatio(const std::vector<double>& ratios);

/** Candidate 0 is the base (all ratios 1). With one recording nothing is recommended. */
[[nodiscard]] Verdict leaveOneOut(const Ratios& ratios);

}  // namespace fastlio
