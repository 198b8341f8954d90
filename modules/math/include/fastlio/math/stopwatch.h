// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file stopwatch.h Wall-clock milliseconds since construction. */
#pragma once

#include <chrono>

namespace fastlio
{
class Stopwatch
{
 public:
  [[nodiscard]] double milliseconds() const
  {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace fastlio
