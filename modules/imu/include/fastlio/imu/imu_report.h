// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_report.h Findings about the inertial sensor. */
#pragma once

#include <fastlio/imu/imu_units.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace fastlio
{
/** Something that the user should know, reported once. */
struct Diagnostic
{
  std::int64_t stamp_ns = 0;
  std::string text;
};

/** Units, rate and faults of the inertial sensor. */
struct ImuReport
{
  AccelUnit accel_unit = AccelUnit::Auto;  //!< in use; Auto: not known yet
  GyroUnit gyro_unit = GyroUnit::Radians;  //!< in use
  double rate = 0.0;                       //!< samples per second, median of the latest [Hz]
  double jitter = 0.0;        //!< standard deviation of the intervals, fraction of the period; gaps
                              //!< do not count
  double longest_gap = 0.0;   //!< [s]
  std::size_t gaps = 0;       //!< longer than four sampling periods
  std::size_t missing = 0;    //!< samples that the intervals leave room for, except in breaks
  std::size_t spikes = 0;     //!< samples left out
  std::size_t saturated = 0;  //!< samples with a clipped axis
  std::size_t bad_stamps = 0;   //!< samples with absurd stamps, left out
  std::size_t late = 0;         //!< samples of a stretch that came too late
  std::size_t clock_steps = 0;  //!< the clock was set back; stamps go on as before
};

}  // namespace fastlio
