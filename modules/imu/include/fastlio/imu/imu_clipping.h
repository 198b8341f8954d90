// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_clipping.h Samples at the end of the sensor's range. */
#pragma once

#include <fastlio/filter/imu.h>

#include <array>

namespace fastlio
{
/** Finds clipped readings of one sensor with three axes. */
class ClippingDetector
{
 public:
  /** \param range full scale; 0: a value above \a floor that repeats at an axis' extreme */
  ClippingDetector(double range, double floor) : range_(range), floor_(floor) {}

  /** Takes the next reading.
   * \return the full scale when an axis is clipped, otherwise 0 */
  double add(const Vec3& reading);
  /** The result of add() for the reading before the latest one; 0 when there was none. */
  [[nodiscard]] double before() const { return before_; }

 private:
  [[nodiscard]] double clippedRange(const Vec3& reading);

  struct Axis
  {
    double extreme = 0.0;
    int repeats = 0;  // consecutive readings at the extreme
  };

  double range_, floor_;
  double latest_ = 0.0, before_ = 0.0;  // full scales of clipped readings
  std::array<Axis, 3> axes_;
};

}  // namespace fastlio
