// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file stamp_report.h The rhythm of a sensor: rate, jitter, gaps, order. */
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** Findings about the stamps of a sensor, in the order of their arrival. */
struct StampReport
{
  std::size_t count = 0;
  std::int64_t first_ns = 0, last_ns = 0;  //!< earliest and latest
  double period = 0;                //!< median of the intervals [s]; 0: fewer than two stamps
  double jitter = 0;                //!< standard deviation of the intervals that are no gaps [s]
  std::size_t gaps = 0;             //!< intervals of more than kGapPeriods periods
  double longest_gap = 0;           //!< longest interval [s]
  std::int64_t longest_gap_ns = 0;  //!< stamp where it begins
  std::size_t duplicates = 0;       //!< stamps equal to the one before
  std::size_t backwards = 0;        //!< stamps before the one before

  [[nodiscard]] double rate() const { return period > 0 ? 1.0 / period : 0.0; }
};

/** From this many periods on an interval is a gap. */
constexpr double kGapPeriods = 2.5;

[[nodiscard]] StampReport reportOn(const std::vector<std::int64_t>& stamps_ns);

}  // namespace fastlio
