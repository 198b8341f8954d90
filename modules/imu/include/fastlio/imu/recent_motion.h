// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file recent_motion.h How far the motion departs from a straight line between two samples: what
 * a gap in the inertial data costs. */
#pragma once

#include <fastlio/imu/imu_buffer.h>

#include <cstdint>
#include <optional>

namespace fastlio
{
/** Errors of the mean rate and the mean specific force over a gap, where the samples on both sides
 * of it are interpolated: standard deviations of the axis with the largest one. */
struct InterpolationError
{
  double gyro_std = 0.0;   //!< [rad/s]
  double accel_std = 0.0;  //!< [m/s^2]
};

/** The samples of the last seconds. They show what a gap costs: had the same gap been at any other
 * place among them, how wrong would its interpolation have been? A car loses little in 0.2 s, a
 * sensor in a shaking hand much. */
class RecentMotion
{
 public:
  /** Takes the next sample. \param after_gap the motion since the sample before is unknown */
  void add(const ImuSample& sample, bool after_gap);

  /** Of the latest sample [ns]; nothing before the first one. */
  [[nodiscard]] std::optional<std::int64_t> newestStamp() const;

  /** The error of interpolating from the latest sample to \a next.
   *
   * With the errors e of the mean over windows of this length and the differences d of the samples
   * at their ends, the variance is max(e^2) / 2, times d^2 / E[d^2] where the difference across
   * this gap is larger than usual: then the motion has changed in it.
   * \return nothing when the samples cover too little time to tell */
  [[nodiscard]] std::optional<InterpolationError> errorUntil(const ImuSample& next) const;

 private:
  ImuBuffer samples_;  // with the gaps between them
};

}  // namespace fastlio
