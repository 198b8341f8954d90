// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file search_space.h Which keys are searched, and the values that they may take. */
#pragma once

#include <fastlio/config/config.h>

#include <string>
#include <vector>

namespace fastlio
{
/** The values of one key: a list, or a range. */
struct SearchKey
{
  std::string key;
  std::vector<std::string> values;  //!< the list; empty: a range
  double min = 0.0, max = 0.0;      //!< range, in the unit of the key's text
  bool logarithmic = false;
  bool whole = false;  //!< whole numbers only

  /** The value at a place from 0 to 1 of the range or list, with 4 significant digits. */
  [[nodiscard]] std::string at(double place) const;
};

using SearchSpace = std::vector<SearchKey>;

/** A point of the space: one text per key. */
using Candidate = std::vector<std::string>;

/** Reads a space: groups as in a parameter file; each key holds a list of values, or
 * `{min: A, max: B}` with an optional `scale: lin` or `log`.
 * \exception std::invalid_argument names file, key, what was seen and what is allowed */
[[nodiscard]] SearchSpace readSearchSpace(const std::string& path);

/** The candidate at the places (0 to 1) of all keys. */
[[nodiscard]] Candidate candidateAt(const SearchSpace& space, const std::vector<double>& places);

/** \a base with the values of a candidate. They may contradict each other or the base: validate()
 * checks. \exception std::invalid_argument a value is out of its own range */
[[nodiscard]] Config configured(
    const Config& base, const SearchSpace& space, const Candidate& candidate);

}  // namespace fastlio
