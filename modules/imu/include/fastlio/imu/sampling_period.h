// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sampling_period.h The usual time between the samples of a sensor. */
#pragma once

#include <array>
#include <cstddef>

namespace fastlio
{
/** Median and scatter of the intervals between samples. */
class SamplingPeriod
{
 public:
  /** \param interval to the sample before [s]
   * \param gap_periods longer intervals are gaps and say
   * nothing about the scatter */
  void add(double interval, double gap_periods);

  /** Median of the latest intervals [s]; 0 until there are enough of them. */
  [[nodiscard]] double median() const { return median_; }
  /** Standard deviation of the intervals, gaps left out, as a fraction of the median. */
  [[nodiscard]] double jitter() const;

 private:
  static constexpr std::size_t kLatest = 64;

  std::array<double, kLatest> latest_{};
  std::size_t count_ = 0;
  double median_ = 0.0;
  double n_ = 0.0, mean_ = 0.0, squares_ = 0.0;  // Welford's sums of the intervals
};

}  // namespace fastlio
