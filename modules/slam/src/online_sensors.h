// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file online_sensors.h Which LiDAR and IMU to use, decided while observations come in. */
#pragma once

#include <fastlio/config/config.h>
#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/survey/sensor_selection.h>

#include <mrpt/obs/CObservation.h>

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fastlio
{
/** An ObservationBridge that is set up by what comes in: observations are kept until the sensors
 * and what their times mean are known, and converted then. */
class OnlineSensors
{
 public:
  /** \exception std::invalid_argument a label is not a regular expression */
  explicit OnlineSensors(const Config& config);

  /** Everything that this observation makes available, in order. */
  [[nodiscard]] std::vector<BridgeOutput> convert(
      const mrpt::obs::CObservation::ConstPtr& observation);

  /** A scan of the LiDAR in use; nothing for others, and as long as the sensors are not known. */
  [[nodiscard]] std::optional<LidarScan> decode(const mrpt::obs::CObservation& observation);

  /** What the user should know, once. */
  [[nodiscard]] std::string takeMessage() { return std::exchange(message_, {}); }

  /** IMU frame to vehicle frame; the identity as long as the sensors are not known. */
  [[nodiscard]] Pose T_vehicle_imu() const;

 private:
  void start();

  Config config_;
  SensorPatterns patterns_;
  SensorSurvey survey_;
  std::deque<mrpt::obs::CObservation::ConstPtr> kept_;
  std::optional<ObservationBridge> bridge_;
  bool failed_ = false;
  std::string message_;
};

}  // namespace fastlio
