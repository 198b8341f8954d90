// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file cpu_growth.h How the cost of a call grows, whatever else the machine does. */
#pragma once

#include <algorithm>
#include <ctime>
#include <limits>

namespace fastlio::testing
{
/** Processor time of \a call(size), the least of three [s]. */
template <typename Call>
double cpuSeconds(const Call& call, int size)
{
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i)
  {
    const std::clock_t begin = std::clock();
    call(size);
    least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return least;
}

/** True when ten times the size takes less than forty times as long: in proportion to the size it
 * takes ten times as long, with its square a hundred times. \param size large enough to take more
 * than the clock's step */
template <typename Call>
bool growsInProportion(const Call& call, int size)
{
  return cpuSeconds(call, 10 * size) < 40.0 * cpuSeconds(call, size);
}
}  // namespace fastlio::testing
