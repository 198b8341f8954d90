// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file input_plan.h The planned treatment of a recording's sensors: from the data,
 * or given by parameters. */
#pragma once

#include <fastlio/lidar/lidar_options.h>
#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/sensors/sensor_options.h>
#include <fastlio/survey/sensor_selection.h>

#include <string>
#include <vector>

namespace fastlio
{
/** How the points of one LiDAR get their times. */
struct LidarPlan
{
  PointTimeFinding finding;  //!< about the time field of its clouds
  CloudTiming timing;
  bool compensated = true;  //!< false: no point has a time of its own, no motion compensation
  std::string text;         //!< for people: where the times come from, with the numbers
  bool loud = false;        //!< text is about something that people should look at
};

/** Where a sensor in use is mounted. */
struct SensorPlace
{
  SensorKind kind = SensorKind::Lidar;
  std::string label;
  Pose T_vehicle_sensor;
  std::string origin;  //!< for people: who says so
};

/** The plan for all sensors. */
struct InputPlan
{
  BridgeOptions bridge;
  Pose T_vehicle_imu;                 //!< in use
  std::vector<LidarPlan> lidars;      //!< the first LiDAR, then the further ones
  std::vector<SensorPlace> places;    //!< of the LiDARs, then of the IMU
  std::vector<std::string> notes;     //!< for people
  std::vector<std::string> warnings;  //!< for people, to be looked at
};

/** The labels that options ask for. */
[[nodiscard]] SensorPatterns patternsOf(const SensorOptions& sensors);

/** The sensors of a recording that options ask for.
 * \param files its parts, in order
 * \exception std::exception as surveySensors() and selectSensors() */
[[nodiscard]] SensorSelection sensorsIn(
    const std::vector<std::string>& files, const SensorOptions& sensors);

/** Whether the recording says where the sensor is mounted. */
[[nodiscard]] bool hasKnownMounting(const SensorSummary& sensor);

/** Decides for one LiDAR. An Ambiguous finding leaves the points without times.
 * \param sensor with what surveySensors() saw of its times */
[[nodiscard]] LidarPlan planLidar(const SensorSummary& sensor, const SensorOptions& parameters);

/** Decides for all of them.
 * \exception std::runtime_error times of points can be read in two ways: the message shows both and
 * says which parameter decides */
[[nodiscard]] InputPlan planInput(
    const SensorSelection& selection, const SensorOptions& sensors, const LidarOptions& lidar);

/** Sensor options with the factory mounting in place of the poses, where it applies: the recording
 * gives neither LiDAR nor IMU a pose, and the options give none either. The frame of the LiDAR is
 * that of the vehicle then. */
[[nodiscard]] SensorOptions withFactoryMounting(
    const SensorSelection& selection, SensorOptions sensors);

}  // namespace fastlio
