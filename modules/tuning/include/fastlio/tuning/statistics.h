// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file statistics.h Ranks, and what each key does to the error. */
#pragma once

#include <fastlio/tuning/search_space.h>

#include <string>
#include <vector>

namespace fastlio
{
/** Spearman's correlation of ranks, equal values sharing theirs; 0 when one side is constant.
 * \exception std::invalid_argument the sides differ in length */
[[nodiscard]] double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b);

/** A point of the space that was tried. */
struct TriedPoint
{
  Candidate values;    //!< one text per key
  double ratio = 1.0;  //!< error by error of the base: geometric mean over recordings
};

/** Statistics of the trials with some values of a key. */
struct KeyLevel
{
  std::string values;  //!< "0.01", or "0.01 to 0.05"
  std::size_t trials = 0;
  double mean_ratio =
      1.0;  //!< geometric mean, by that of all trials (keyEffects()); infinite: lost
};

/** Main effect of a key. */
struct KeyEffect
{
  std::string key;
  std::vector<KeyLevel> levels;  //!< each value of a list, or thirds of the values of a range
  double effect = 1.0;           //!< largest mean ratio of a level by the smallest; 1: none
  bool certain = false;          //!< the effect is above twice its standard error
};

/** One per key, largest effect first. */
[[nodiscard]] std::vector<KeyEffect> keyEffects(
    const SearchSpace& space, const std::vector<TriedPoint>& points);

}  // namespace fastlio
