// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file statistics.h Summary of a list of errors. */
#pragma once

#include <cstddef>
#include <vector>

namespace fastlio
{
/** In the unit of the errors. All zero when there are none. */
struct ErrorStatistics
{
  std::size_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double max = 0.0;
  double std = 0.0;  //!< about the mean, of the population (divided by count)
};

/** \param errors non-negative */
[[nodiscard]] ErrorStatistics summarize(std::vector<double> errors);

}  // namespace fastlio
