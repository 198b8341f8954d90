// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_time_facts.h The numbers that findPointTimes() decides on (internal). */
#pragma once

#include <fastlio/lidar/point_time.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** Medians over the scans that have times. Times are in the field's own unit unless said otherwise.
 */
struct PointTimeFacts
{
  explicit PointTimeFacts(const std::vector<PointTimeSample>& samples);

  std::size_t scans = 0;
  double span = 0;          //!< of a scan's times
  double min = 0, max = 0;  //!< of the scan in the middle
  double resolution = 0;    //!< of the stored numbers
  double stamp_s = 0;       //!< of the scan in the middle [s]

  /** Median time between stamps; a usual one when there is a single scan [s]. */
  [[nodiscard]] double period() const;
  [[nodiscard]] std::string periodText() const;

  /** Fraction of the intervals between scans in which the times advance as the stamps do. */
  [[nodiscard]] double fractionOfAdvances(double unit, double tolerance) const;

  /** Median of the earliest time minus the stamp [s]. */
  [[nodiscard]] double clockOffset(double unit) const;

  /** A time of the scan in the middle. */
  [[nodiscard]] double secondsAfterStamp(double time, const PointTimeReading& reading) const;

  double measured_period = 0;  //!< [s]; 0: unknown

 private:
  std::vector<PointTimeSample> samples_;  // in the order of their stamps, no stamp twice
};

/** A finding with the facts filled in. */
[[nodiscard]] PointTimeFinding startOf(const PointTimeFacts& facts);

/** Four significant digits. */
[[nodiscard]] std::string numberText(double number);

/** The same with the unit. */
[[nodiscard]] std::string durationText(double seconds);

}  // namespace fastlio
