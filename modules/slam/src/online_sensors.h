// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file online_sensors.h Which LiDAR and IMU to use, decided while observations come in. */
#pragma once

#include <fastlio/mrpt_bridge/observation_bridge.h>
#include <fastlio/odometry/parameters.h>

#include <mrpt/obs/CObservation.h>

#include <optional>
#include <regex>
#include <string>
#include <utility>

namespace fastlio
{
/** An ObservationBridge that is set up by the first usable observation of either kind. Those that
 * come before both sensors are known are not used. */
class OnlineSensors
{
 public:
  /** \exception std::regex_error a label is not a regular expression (parameters that were checked
   * have none such) */
  explicit OnlineSensors(const InputParameters& input);

  [[nodiscard]] BridgeOutput convert(const mrpt::obs::CObservation& observation);

  /** The same for scans only: others are nothing, and do not count. */
  [[nodiscard]] BridgeOutput convertScan(const mrpt::obs::CObservation& observation);

  /** What the user should know, once. */
  [[nodiscard]] std::string takeMessage() { return std::exchange(message_, {}); }

  /** IMU frame to vehicle frame; the identity as long as the sensors are not known. */
  [[nodiscard]] Pose T_vehicle_imu() const;

 private:
  void look(const mrpt::obs::CObservation& observation);
  void start();

  InputParameters input_;
  std::regex lidar_label_, imu_label_;
  std::optional<SensorSummary> lidar_, imu_;
  std::optional<ObservationBridge> bridge_;
  std::string message_;
};

}  // namespace fastlio
