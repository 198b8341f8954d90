// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/options/label_pattern.h>
#include <fastlio/options/plain_zero.h>
#include <fastlio/options/printable.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/survey/sensor_selection.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <stdexcept>

namespace
{
using fastlio::SensorKind;
using fastlio::SensorSummary;
using fastlio::SensorSurvey;

const char* nameOf(SensorKind kind)
{
  return kind == SensorKind::Imu ? "IMU" : "LiDAR";
}
const char* flagOf(SensorKind kind)
{
  return kind == SensorKind::Imu ? "--imu-sensor-label" : "--lidar-sensor-label";
}

// A screen of sensors; a damaged recording may seem to have a thousand.
constexpr std::size_t kMostListed = 40;

std::string furtherText(std::size_t count)
{
  return count == 0 ? "" : "\n  and " + std::to_string(count) + " further sensors";
}

std::string whatThereIs(const SensorSurvey& survey)
{
  std::string text;
  for (const auto& problem : survey.problems)
    text += "\n  trouble: " + problem.message;
  const std::size_t listed = std::min(survey.sensors.size(), kMostListed);
  for (std::size_t i = 0; i < listed; ++i)
    text += "\n  found: " + describe(survey.sensors[i]);
  text += furtherText(survey.sensors.size() - listed);
  if (survey.observations_beyond > 0)
    text += "\n  trouble: " + std::to_string(survey.observations_beyond) +
            " observations of further sensors, after " + std::to_string(fastlio::kMostSensors) +
            ", are left out.";
  return text.empty() ? "\n  There are no observations at all." : text;
}

std::string reasonFor(const SensorSurvey& survey, SensorKind kind, const std::string& pattern)
{
  const auto is_kind = [&](const SensorSummary& s) { return s.kind == kind; };
  const auto count = std::count_if(survey.sensors.begin(), survey.sensors.end(), is_kind);
  if (survey.sensors.empty())
    return std::string("No ") + nameOf(kind) + " found: nothing could be read.";
  if (count == 0)
    return std::string("No ") + nameOf(kind) + " found in the recording. " +
           (kind == SensorKind::Imu
                ? "Odometry needs a CObservationIMU with acceleration and angular rate."
                : "Odometry needs CObservationVelodyneScan, CObservationPointCloud or "
                  "CObservationRotatingScan.") +
           " Where it was recorded in another file, make one of both: fastlio-import --merge LIDAR "
           "IMU -o BOTH.rawlog";
  if (!pattern.empty())
    return std::string("No usable ") + nameOf(kind) + " has a label that matches '" +
           fastlio::printable(pattern) + "': the whole label must match. Give another " +
           flagOf(kind) + ".";
  return std::string("No ") + nameOf(kind) + " of the recording can be used.";
}

using Taken = std::vector<const SensorSummary*>;

const SensorSummary* bestOf(
    const SensorSurvey& survey, SensorKind kind, const fastlio::LabelPattern& pattern,
    const Taken& taken)
{
  const SensorSummary* best = nullptr;
  for (const SensorSummary& sensor : survey.sensors)
  {
    const bool free = std::find(taken.begin(), taken.end(), &sensor) == taken.end();
    const bool fits = sensor.kind == kind && sensor.usable && pattern.matches(sensor.label);
    if (free && fits && (best == nullptr || sensor.observations > best->observations))
      best = &sensor;
  }
  return best;
}

Taken askedForBeside(const SensorSurvey& survey, const fastlio::SensorPatterns& patterns)
{
  Taken asked;
  for (const std::string& label : patterns.further_lidar_labels)
  {
    const fastlio::LabelPattern pattern("lidar", label);
    for (const SensorSummary& sensor : survey.sensors)
      if (pattern.matches(sensor.label)) asked.push_back(&sensor);
  }
  return asked;
}

const SensorSummary& choose(
    const SensorSurvey& survey, SensorKind kind, const std::string& pattern, const Taken& taken)
{
  const SensorSummary* best = bestOf(
      survey, kind, fastlio::LabelPattern(kind == SensorKind::Imu ? "imu" : "lidar", pattern),
      taken);
  if (best == nullptr)
    throw std::runtime_error(reasonFor(survey, kind, pattern) + whatThereIs(survey));
  return *best;
}

/** One of those that lidar_2.sensor_label and the like ask for. */
const SensorSummary& chooseFurther(
    const SensorSurvey& survey, const std::string& pattern, const Taken& taken)
{
  const auto* best =
      bestOf(survey, SensorKind::Lidar, fastlio::LabelPattern("lidar", pattern), taken);
  if (best == nullptr)
    throw std::runtime_error(
        "No further LiDAR that can be used has a label that matches '" +
        fastlio::printable(pattern) + "' (lidar_2.sensor_label and the like)." +
        whatThereIs(survey));
  return *best;
}
}  // namespace

namespace fastlio
{
SensorSelection selectSensors(const SensorSurvey& survey, const SensorPatterns& patterns)
{
  // "Any" for the first LiDAR does not mean those that are asked for beside it.
  const Taken reserved = patterns.lidar_label.empty() ? askedForBeside(survey, patterns) : Taken{};
  Taken used{
      &choose(survey, SensorKind::Lidar, patterns.lidar_label, reserved),
      &choose(survey, SensorKind::Imu, patterns.imu_label, {})};
  SensorSelection selection{*used[0], *used[1], {}, {}};
  for (const std::string& label : patterns.further_lidar_labels)
  {
    used.push_back(&chooseFurther(survey, label, used));
    selection.further_lidars.push_back(*used.back());
  }
  for (const SensorSummary& sensor : survey.sensors)
    if (std::find(used.begin(), used.end(), &sensor) == used.end())
      selection.ignored.push_back(sensor);
  return selection;
}

std::string describe(const SensorSummary& sensor)
{
  const auto pose = toMrptPose(sensor.T_vehicle_sensor);
  const double seconds = toSeconds(sensor.last_stamp_ns - sensor.first_stamp_ns);
  std::string text =
      mrpt::format("label '%s', %s", printable(sensor.label).c_str(), sensor.class_name.c_str());
  if (!sensor.detail.empty()) text += " (" + printable(sensor.detail) + ")";
  if (seconds > 0)
    text += mrpt::format(", %.1f Hz", static_cast<double>(sensor.observations - 1) / seconds);
  return text + mrpt::format(
                    ", T_vehicle_sensor: x=%.3f y=%.3f z=%.3f m, yaw=%.2f pitch=%.2f roll=%.2f deg",
                    plainZero(pose.x(), 3), plainZero(pose.y(), 3), plainZero(pose.z(), 3),
                    plainZero(pose.yaw() * kDegPerRad, 2), plainZero(pose.pitch() * kDegPerRad, 2),
                    plainZero(pose.roll() * kDegPerRad, 2));
}

std::string describe(const SensorSelection& selection)
{
  std::string text = "LiDAR: " + describe(selection.lidar);
  for (const SensorSummary& sensor : selection.further_lidars)
    text += "\nLiDAR: " + describe(sensor);
  text += "\nIMU:   " + describe(selection.imu);
  const std::size_t listed = std::min(selection.ignored.size(), kMostListed);
  for (std::size_t i = 0; i < listed; ++i)
    text += "\nignored: " + describe(selection.ignored[i]);
  return text + furtherText(selection.ignored.size() - listed);
}

}  // namespace fastlio
