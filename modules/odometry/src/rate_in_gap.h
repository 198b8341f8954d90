// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rate_in_gap.h How a platform turns while inertial samples are missing, as scans show it. */
#pragma once

#include <fastlio/math/so3.h>

namespace fastlio
{
/** Each scan of a gap shows by how much the angular rate has changed since the scan before. */
class RateInGap
{
 public:
  /** Takes the change that a scan showed [rad/s]. */
  void add(const Vec3& change)
  {
    squares_ += change.squaredNorm() / 3.0;
    ++changes_;
  }
  /** The rate of the next scans is off by \a rate_error less [rad/s]. */
  void correct(const Vec3& rate_error) { correction_ += rate_error; }
  /** What to add to the rates that the samples around the gap show [rad/s]. */
  [[nodiscard]] const Vec3& correction() const { return correction_; }

  /** By how much the rate changes from scan to scan, per axis [rad/s]. \param expected_std by the
   * samples around the gap; it counts as one change */
  [[nodiscard]] double changeStd(double expected_std) const;

 private:
  Vec3 correction_ = Vec3::Zero();
  double squares_ = 0.0;  // of the changes, per axis
  int changes_ = 0;
};
}  // namespace fastlio
