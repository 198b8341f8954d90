// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file search.h Which points of the unit cube are tried next. */
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace fastlio
{
using Places = std::vector<double>;  //!< one number from 0 to 1 per key

/** Proposes batches of points. The same seed and scores give the same points. */
class Search
{
 public:
  virtual ~Search() = default;
  /** The next points; empty when the search is complete. */
  [[nodiscard]] virtual std::vector<Places> ask() = 0;
  /** Scores of the points of the last ask(), in their order; smaller is better. */
  virtual void tell(const std::vector<double>& scores) = 0;
};

/** All combinations; key i takes \a steps[i] places, evenly spread. */
[[nodiscard]] std::unique_ptr<Search> gridSearch(const std::vector<std::size_t>& steps);

/** \a budget uniform points. */
[[nodiscard]] std::unique_ptr<Search> randomSearch(
    std::size_t keys, std::size_t budget, std::uint64_t seed);

/** CMA-ES (Hansen 2016) in the unit cube: a normal distribution that follows the better half of
 * each batch; points beyond the cube are mirrored into it. Ends with \a budget points. */
[[nodiscard]] std::unique_ptr<Search> cmaesSearch(
    std::size_t keys, std::size_t budget, std::uint64_t seed);

}  // namespace fastlio
