// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_options.h Options of the inertial data: noise, units, gaps, rest. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/imu/imu_buffer.h>
#include <fastlio/imu/imu_units.h>

namespace fastlio
{
/** Group `imu`. */
struct ImuOptions
{
  ImuNoise noise;
  ImuHold hold = ImuHold::Midpoint;  //!< how samples are held between their stamps
  double max_gap = 0.5;              //!< longer gaps between samples split the run [s]
  AccelUnit accel_unit = AccelUnit::Auto;
  GyroUnit gyro_unit = GyroUnit::Auto;
  bool invert_acceleration = false;          //!< the sensor gives gravity, not specific force
  double gyro_range = 0.0;                   //!< full scale [rad/s]; 0: found
  double accel_range = 0.0;                  //!< full scale [m/s^2]; 0: found
  double saturation_std = 0.5;               //!< of a clipped axis, fraction of the full scale
  double gap_periods = 4.0;                  //!< so many periods without a sample are a gap
  double gap_gyro_std = 0.5235987755982988;  //!< of the rate in a gap of max_gap [rad/s]; 30 deg/s
  double gap_accel_std = 2.0;                //!< of the force in a gap of max_gap [m/s^2]
  double spike_gyro = 10.471975511965978;    //!< a lone sample off by more is gated [rad/s]
  double spike_accel = 100.0;                //!< a lone sample off by more is gated [m/s^2]
};

/** Group `rest`: standing still in the middle of a run. */
struct RestOptions
{
  bool at_start = true;                           //!< a start at rest goes on resting
  bool enabled = false;                           //!< detect rest, and then keep still
  double duration = 2.0;                          //!< quiet for so long is rest [s]
  double max_speed = 0.01;                        //!< trend of the positions since then [m/s]
  double max_velocity = 0.1;                      //!< of the filter, after a scan [m/s]
  double max_displacement = 0.03;                 //!< from where the quiet time began [m]
  double max_rotation = 0.008726646259971648;     //!< since then [rad]; 0.5 deg
  double max_rate_change = 0.008726646259971648;  //!< of the angular rate [rad/s]; 0.5 deg/s
  double max_accel_change = 0.1;                  //!< of the specific force [m/s^2]
  double velocity_std = 0.01;                     //!< of the pseudo-measurement v = 0 [m/s]
  double rate_std = 0.0008726646259971648;        //!< of w = gyro bias [rad/s]; 0.05 deg/s
  double map_time = 3.0;  //!< at rest for longer than this, scans do not join the map [s]
};

}  // namespace fastlio
