// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "online_sensors.h"

#include <mrpt/rtti/CObject.h>

namespace fastlio
{
namespace
{
std::regex patternOf(const std::string& label)
{
  return std::regex(label.empty() ? ".*" : label);
}

void takeIfUsable(
    const SensorSummary& sensor, SensorKind kind, const std::regex& label,
    std::optional<SensorSummary>& chosen)
{
  if (chosen || sensor.kind != kind || !sensor.usable) return;
  if (std::regex_match(sensor.label, label)) chosen = sensor;
}
}  // namespace

OnlineSensors::OnlineSensors(const InputParameters& input)
    : input_(input),
      lidar_label_(patternOf(input.lidar_sensor_label)),
      imu_label_(patternOf(input.imu_sensor_label))
{
}

BridgeOutput OnlineSensors::convert(const mrpt::obs::CObservation& observation)
{
  if (!bridge_) look(observation);
  if (!bridge_) return std::monostate{};
  return bridge_->convert(observation);
}

BridgeOutput OnlineSensors::convertScan(const mrpt::obs::CObservation& observation)
{
  const bool is_scan = bridge_ && observation.sensorLabel == lidar_->label &&
                       observation.GetRuntimeClass()->className == lidar_->class_name;
  return is_scan ? bridge_->convert(observation) : BridgeOutput{};
}

void OnlineSensors::look(const mrpt::obs::CObservation& observation)
{
  const SensorSummary sensor = summarizeSensor(observation);
  takeIfUsable(sensor, SensorKind::Lidar, lidar_label_, lidar_);
  takeIfUsable(sensor, SensorKind::Imu, imu_label_, imu_);
  if (lidar_ && imu_) start();
}

void OnlineSensors::start()
{
  SensorSelection selection;
  selection.lidar = *lidar_;
  selection.imu = *imu_;
  BridgeOptions options;
  options.T_vehicle_imu = input_.T_vehicle_imu;
  const Pose T_vehicle_imu = input_.T_vehicle_imu.value_or(imu_->T_vehicle_sensor);
  if (input_.T_vehicle_lidar)
    options.T_imu_lidar = T_vehicle_imu.inverse() * *input_.T_vehicle_lidar;
  message_ = describe(selection);
  bridge_.emplace(std::move(selection), std::move(options));
}

Pose OnlineSensors::T_vehicle_imu() const
{
  return bridge_ ? bridge_->T_vehicle_imu() : Pose{};
}

}  // namespace fastlio
