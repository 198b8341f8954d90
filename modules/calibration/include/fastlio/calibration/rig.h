// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file rig.h The calibration of a rig: what all its recordings have in common. */
#pragma once

#include <fastlio/config/config.h>
#include <fastlio/errormodel/calibration_sums.h>
#include <fastlio/survey/input_plan.h>

#include <array>
#include <vector>

namespace fastlio
{
/** Errors that the beams of one elevation share. */
struct BeamRow
{
  double elevation = 0.0;         //!< [rad]
  double range = 0.0;             //!< measured less true [m]
  double elevation_offset = 0.0;  //!< in use less true [rad]
};

/** How the sensors of a rig sit and measure. */
struct Rig
{
  Pose T_vehicle_imu;  //!< as given; calibration leaves it
  Pose T_imu_lidar;
  double time_offset = 0.0;              //!< added to the stamps of the LiDAR [s]
  Mat3 gyro_matrix = Mat3::Identity();   //!< reading = matrix * rate + bias
  Mat3 accel_matrix = Mat3::Identity();  //!< the same of the specific force
  std::vector<BeamRow> beams;            //!< ascending by elevation
};

/** The values of a configuration and the recording. */
[[nodiscard]] Rig rigOf(
    const Config& config, const SensorSelection& selection, const InputPlan& plan);

/** Sets the options of the calibration. */
void apply(const Rig& rig, Config& config);

/** The rig without an error of extrinsic and matrices. */
[[nodiscard]] Rig corrected(const Rig& rig, const CalibrationErrorVector& error);

/** The rig with offsets of beams beside those in use. */
[[nodiscard]] Rig withBeams(const Rig& rig, const std::vector<BeamRow>& more);

}  // namespace fastlio
