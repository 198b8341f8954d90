// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "online_sensors.h"

#include <fastlio/config/presets.h>
#include <fastlio/survey/input_plan.h>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostKept = 5000;
}  // namespace

OnlineSensors::OnlineSensors(const Config& config, OptionFilter is_given)
    : config_(config), is_given_(std::move(is_given)), patterns_(patternsOf(config.sensors))
{
  patterns_.further_lidar_labels.clear();  // one LiDAR is used here
  (void)isComplete(survey_, patterns_);    // reports labels that are no patterns
}

std::vector<BridgeOutput> OnlineSensors::convert(
    const mrpt::obs::CObservation::ConstPtr& observation)
{
  std::vector<BridgeOutput> outputs;
  if (bridge_)
  {
    outputs.push_back(bridge_->convert(*observation));
    return outputs;
  }
  if (failed_) return outputs;
  kept_.push_back(observation);
  if (kept_.size() > kMostKept) kept_.pop_front();
  noteObservation(survey_, *observation);
  if (isComplete(survey_, patterns_)) start();
  if (!bridge_) return outputs;
  for (const auto& kept : std::exchange(kept_, {}))
    outputs.push_back(bridge_->convert(*kept));
  return outputs;
}

void OnlineSensors::start()
{
  try
  {
    SensorSelection selection = selectSensors(survey_, patterns_);
    const auto preset = takePreset(selection, is_given_, config_);
    const InputPlan plan = planInput(selection, config_.sensors, config_.odometry.lidar);
    message_ = describe(selection);
    if (preset) message_ += "\n" + preset->text;
    for (const auto* sentences : {&plan.notes, &plan.warnings})
      for (const auto& sentence : *sentences)
        message_ += "\n" + sentence;
    bridge_.emplace(std::move(selection), plan.bridge);
  }
  catch (const std::exception& e)
  {
    failed_ = true;
    kept_.clear();
    message_ = std::string("the odometry cannot start: ") + e.what();
  }
}

std::optional<LidarScan> OnlineSensors::decode(const mrpt::obs::CObservation& observation)
{
  if (!bridge_ || bridge_->lidarOf(observation) != std::optional<std::size_t>(0))
    return std::nullopt;
  BridgeOutput output = bridge_->convert(observation);
  auto* scan = std::get_if<LidarScan>(&output);
  return scan == nullptr ? std::nullopt : std::optional<LidarScan>(std::move(*scan));
}

Pose OnlineSensors::T_vehicle_imu() const
{
  return bridge_ ? bridge_->T_vehicle_imu() : Pose{};
}

}  // namespace fastlio
