// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_options.h Options of the inertial data: noise, units, gaps, rest. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/imu/imu_buffer.h>
#include <fastlio/imu/imu_units.h>
#include <fastlio/math/so3.h>

#include <vector>

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
  bool invert_acceleration = false;  //!< the sensor gives gravity, not specific force
  double gyro_range = 0.0;           //!< full scale [rad/s]; 0: found
  double accel_range = 0.0;          //!< full scale [m/s^2]; 0: found
  /** Readings are matrix * truth + bias; row by row, nothing: the identity. */
  std::vector<double> gyro_matrix, accel_matrix;
};

/** The matrix of nine numbers row by row, or the identity. */
[[nodiscard]] Mat3 sensorMatrix(const std::vector<double>& rows);

/** Group `rest`: standing still in the middle of a run. */
struct RestOptions
{
  bool at_start = true;     //!< a start at rest goes on resting
  bool enabled = false;     //!< detect rest, and then keep still
  double duration = 2.0;    //!< quiet for so long is rest [s]
  double max_speed = 0.01;  //!< trend of the positions since then [m/s]
};

}  // namespace fastlio
