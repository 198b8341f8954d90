// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "import_inputs.h"

#include <fastlio/options/printable.h>
#include <fastlio/survey/sensor_selection.h>

#include <mrpt/obs/CObservationIMU.h>

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
  std::set<std::string> taken;
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    std::set<std::string> own;
    for (const SensorSummary& sensor : surveySensors({files[i]}, {}).sensors)
      if (sensor.kind == SensorKind::Imu) own.insert(sensor.label);
    for (const std::string& label : own)
    {
      std::string free = label;
      for (int n = 2; taken.count(free) + (free == label ? 0 : own.count(free)) > 0; ++n)
        free = label + "_" + std::to_string(n);
      taken.insert(free);
      if (free == label) continue;
      inputs_[i].labels[label] = free;
      notes_.push_back(
          "another input has an IMU '" + printable(label) + "', too: that of '" +
          printable(files[i]) + "' is written as '" + printable(free) +
          "'; --imu-sensor-label of fastlio-replay chooses between them");
    }
  }
}

std::vector<std::string> ImportInputs::newLabels() const
{
  std::vector<std::string> labels;
  for (const Input& input : inputs_)
    for (const auto& [before, now] : input.labels)
      labels.push_back(now);
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
  const auto label = first->labels.find(observation->sensorLabel);
  if (label != first->labels.end() &&
      dynamic_cast<const mrpt::obs::CObservationIMU*>(observation.get()) != nullptr)
    observation->sensorLabel = label->second;
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
