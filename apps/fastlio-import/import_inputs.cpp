// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "import_inputs.h"

#include <fastlio/options/printable.h>
#include <fastlio/survey/sensor_selection.h>

#include <set>
#include <utility>

namespace fastlio
{
ImportInputs::ImportInputs(const std::vector<std::string>& files, bool merge)
{
  if (!merge)
    inputs_.push_back({RawlogSource(files)});
  else
    for (const std::string& file : files)
      inputs_.push_back({RawlogSource({file})});
  if (merge) relabel(files);
  for (Input& input : inputs_)
    input.waiting = input.source.next();
}

void ImportInputs::relabel(const std::vector<std::string>& files)
{
  std::vector<std::vector<SensorSummary>> sensors;
  sensors.reserve(files.size());
  for (const std::string& file : files)
    sensors.push_back(surveySensors({file}, {}).sensors);
  for (const SensorKind kind : {SensorKind::Imu, SensorKind::Lidar})
    relabel(kind, files, sensors);
}

void ImportInputs::relabel(
    SensorKind kind, const std::vector<std::string>& files,
    const std::vector<std::vector<SensorSummary>>& sensors)
{
  const bool is_imu = kind == SensorKind::Imu;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    std::map<std::string, std::string> own;  // class by label
    for (const SensorSummary& sensor : sensors[i])
      if (sensor.kind == kind) own.emplace(sensor.label, sensor.class_name);
    for (const auto& [label, class_name] : own)
    {
      std::string free = label;
      for (int n = 2; taken.count(free) + (free == label ? 0 : own.count(free)) > 0; ++n)
        free = label + "_" + std::to_string(n);
      taken.insert(free);
      if (free == label) continue;
      inputs_[i].labels[{class_name, label}] = {kind, free};
      notes_.push_back(
          std::string("another input has ") + (is_imu ? "an IMU '" : "a LiDAR '") +
          printable(label) + "', too: that of '" + printable(files[i]) + "' is written as '" +
          printable(free) + "'; --" + (is_imu ? "imu" : "lidar") +
          "-sensor-label of fastlio-replay chooses between them");
    }
  }
}

std::vector<std::string> ImportInputs::newLabels(SensorKind kind) const
{
  std::vector<std::string> labels;
  for (const Input& input : inputs_)
    for (const auto& [before, now] : input.labels)
      if (now.kind == kind) labels.push_back(now.label);
  return labels;
}

mrpt::obs::CObservation::Ptr ImportInputs::next()
{
  Input* first = nullptr;
  for (Input& input : inputs_)
    if (input.waiting && (first == nullptr || input.waiting->timestamp < first->waiting->timestamp))
      first = &input;
  if (first == nullptr) return nullptr;
  auto observation = std::move(first->waiting);
  first->waiting = first->source.next();
  const auto now =
      first->labels.find({observation->GetRuntimeClass()->className, observation->sensorLabel});
  if (now != first->labels.end()) observation->sensorLabel = now->second.label;
  return observation;
}

std::vector<ReadProblem> ImportInputs::problems() const
{
  std::vector<ReadProblem> problems;
  for (const Input& input : inputs_)
    problems.insert(problems.end(), input.source.problems().begin(), input.source.problems().end());
  return problems;
}

ReadProgress ImportInputs::progress() const
{
  ReadProgress all;
  for (const Input& input : inputs_)
  {
    const ReadProgress progress = input.source.progress();
    all.bytes_read += progress.bytes_read;
    all.bytes_total += progress.bytes_total;
  }
  return all;
}

}  // namespace fastlio
