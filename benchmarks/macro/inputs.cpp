// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "inputs.h"

#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/simulation/recording.h>
#include <fastlio/simulation/simulation.h>
#include <fastlio/survey/sensor_selection.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace fastlio::benchmarks
{
Inputs inputsOfRecording(const std::string& rawlog, const Config& config)
{
  Inputs inputs{std::filesystem::path(rawlog).stem().string(), {}, config.odometry};
  const SensorPatterns patterns{config.sensors.lidar_sensor_label, config.sensors.imu_sensor_label};
  ObservationBridge bridge(selectSensors(surveySensors({rawlog}, patterns), patterns));
  RawlogSource source({rawlog});
  while (const auto observation = source.next())
  {
    BridgeOutput output = bridge.convert(*observation);
    if (const auto* sample = std::get_if<ImuSample>(&output)) inputs.data.emplace_back(*sample);
    if (auto* scan = std::get_if<LidarScan>(&output)) inputs.data.emplace_back(std::move(*scan));
  }
  if (!source.problems().empty()) throw std::runtime_error(source.problems().front().message);
  return inputs;
}

Inputs inputsOfScenario(const std::string& scenario, double duration)
{
  SimulationSettings settings = defaultSettings(scenario);
  if (duration > 0.0) settings.duration = duration;
  const Simulation simulation(settings);
  Inputs inputs{scenario, {}, matchingParameters(settings)};
  std::size_t scan = 0;
  LidarScan next = simulation.scan(scan);
  for (const ImuSample& sample : simulation.imu().samples)
  {
    inputs.data.emplace_back(sample);
    if (scan == simulation.scanCount() || sample.stamp_ns < spanOf(next).end_ns) continue;
    inputs.data.emplace_back(std::exchange(next, LidarScan{}));
    if (++scan < simulation.scanCount()) next = simulation.scan(scan);
  }
  return inputs;
}

}  // namespace fastlio::benchmarks
