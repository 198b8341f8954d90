// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file online_sensors.h Which LiDAR and IMU to use, decided while observations come in. */
#pragma once

#include <fastlio/config/config.h>
#include <fastlio/config/config_document.h>
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
  /** \param is_given whether the user gave a value, which the preset of a LiDAR leaves alone
   * \exception std::invalid_argument a label is not a regular expression */
  OnlineSensors(const Config& config, OptionFilter is_given);

  /** Everything that this observation makes available, in order. */
  [[nodiscard]] std::vector<BridgeOutput> convert(
      const mrpt::obs::CObservation::ConstPtr& observation);

  /** A scan of the LiDAR in use; nothing for others, and as long as the sensors are not known. */
  [[nodiscard]] std::optional<LidarScan> decode(const mrpt::obs::CObservation& observation);

  /** Diagnostics for the user, each once. */
  [[nodiscard]] std::string takeMessage() { return std::exchange(message_, {}); }

  [[nodiscard]] bool areKnown() const { return bridge_.has_value(); }

  /** The given configuration and, once the sensors are known, the preset of the LiDAR that its
   * label or its data name. */
  [[nodiscard]] const Config& config() const { return config_; }

  /** IMU frame to vehicle frame; the identity as long as the sensors are not known. */
  [[nodiscard]] Pose T_vehicle_imu() const;

 private:
  void start();

  Config config_;
  OptionFilter is_given_;
  SensorPatterns patterns_;
  SensorSurvey survey_;
  std::deque<mrpt::obs::CObservation::ConstPtr> kept_;
  std::optional<ObservationBridge> bridge_;
  bool failed_ = false;
  std::string message_;
};

}  // namespace fastlio
