// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "config_proposal.h"

#include <fastlio/config/presets.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/gravity.h>
#include <fastlio/options/printable.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <vector>

namespace fastlio
{
namespace
{
using mrpt::format;

// In motion a sensor vibrates: the defaults are as far above the data sheets of their sensors.
constexpr double kNoiseInMotion = 2.5;
constexpr double kLeastTimeOffset = 0.005;  // the odometry finds smaller ones by itself [s]
constexpr double kDegreesPerRadian = 30.0;  // a ratio of the rates beyond it: the gyro is in deg/s
constexpr double kTurned =
    3.0 / kDegPerRad;  // axes of two sensors that are not mounted alike [rad]

/** As a regular expression that matches this label alone. */
std::string patternOf(const std::string& label)
{
  std::string pattern;
  for (const char c : label)
  {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ||
                       c == '/' || c == ' ';
    pattern += (plain ? "" : "\\") + std::string(1, c);
  }
  return pattern;
}

/** Keys with their reasons, and what to say beside them. */
class Proposal
{
 public:
  explicit Proposal(const RecordingSurvey& survey, const Config& given)
      : survey_(survey), config_(given), given_(given)
  {
  }

  [[nodiscard]] std::string text()
  {
    takeLabels();
    takePoses();
    takePointTimes();
    takeNoise();
    takeTimeOffset();
    takePresetValues();
    return header() + body();
  }

 private:
  /** Sets a value unless it is given. */
  template <typename Value>
  void set(const char* key, Value& member, const Value& value, const std::string& reason)
  {
    const auto& row = *findOption(configTable(), key);
    if (valueText(row, given_) != valueText(row, defaults_)) return;
    member = value;
    reasons_[key] = reason;
  }

  [[nodiscard]] const SensorSummary& lidar() const
  {
    return survey_.sensors[survey_.lidars.front().index].summary;
  }
  [[nodiscard]] const SensorSummary& imu() const
  {
    return survey_.sensors[*survey_.imu_index].summary;
  }

  void takeLabels()
  {
    SensorOptions& sensors = config_.sensors;
    set("input.lidar_sensor_label", sensors.lidar_sensor_label, patternOf(lidar().label),
        printable(lidar().detail.empty() ? lidar().class_name : lidar().detail));
    set("input.imu_sensor_label", sensors.imu_sensor_label, patternOf(imu().label),
        printable(imu().detail));
  }

  void takePoses()
  {
    if (hasKnownMounting(lidar()) || hasKnownMounting(imu()) || given_.sensors.T_vehicle_lidar ||
        given_.sensors.T_vehicle_imu)
      return;
    const auto& motion = survey_.motion;
    if (motion && motion->rotation_known &&
        survey_.rotation_error > std::max(kTurned, 2.0 * motion->rotation_std))
      set("input.T_vehicle_lidar", config_.sensors.T_vehicle_lidar,
          std::optional<Pose>(Pose{motion->R_imu_lidar, Vec3::Zero()}),
          "the axes as the motion shows them, to a few degrees; measure the position [m]. "
          "fastlio-calibrate finds both better");
    else
      notes_.emplace_back(
          "The recording has no poses of its sensors: LiDAR and IMU count as one place. Measure "
          "the "
          "LiDAR's pose in the frame of the IMU and set input.T_vehicle_lidar: [x, y, z, yaw, "
          "pitch, roll] (m, deg); fastlio-calibrate finds the rest.");
  }

  void takePointTimes()
  {
    const LidarPlan& plan = survey_.lidars.front().plan;
    if (lidar().times_by_sensor || !plan.timing.reading) return;
    set("input.point_time_unit", config_.sensors.point_time_unit, plan.timing.reading->unit,
        printable(plan.finding.evidence));
    set("input.point_time_reference", config_.sensors.point_time_reference,
        plan.timing.reading->reference, "as above");
  }

  void takeNoise()
  {
    const ImuSurvey& seen = survey_.imu;
    if (!seen.rests) return;
    const auto& motion = survey_.motion;
    const bool degrees = motion && motion->conclusive && motion->scale > kDegreesPerRadian;
    const double to_rad = degrees ? 1.0 / kDegPerRad : 1.0;
    const double to_metres = seen.accel_unit == "g"    ? kStandardGravity
                             : seen.accel_unit == "mg" ? 1e-3 * kStandardGravity
                                                       : 1.0;
    const auto take = [&](const char* key, double& member, double measured)
    {
      const double needed = kNoiseInMotion * measured;
      if (needed <= member) return;
      set(key, member, std::stod(format("%.2g", needed)),
          format(
              "%g times the %.2g of %.1f s at rest", kNoiseInMotion, measured, seen.rest_seconds));
    };
    ImuNoise& noise = config_.odometry.imu.noise;
    take("imu.gyro_noise_density", noise.gyro_noise_density, to_rad * seen.gyro_noise_density);
    take(
        "imu.accel_noise_density", noise.accel_noise_density, to_metres * seen.accel_noise_density);
  }

  void takeTimeOffset()
  {
    const auto& motion = survey_.motion;
    if (!motion || !motion->conclusive) return;
    const double offset = motion->time_offset;
    if (std::abs(offset) < std::max(kLeastTimeOffset, 3.0 * motion->time_offset_std)) return;
    set("lidar.time_offset", config_.odometry.lidar.time_offset, std::stod(format("%.4f", offset)),
        format("+- %.4f s, from the turns that both sensors see", motion->time_offset_std));
  }

  void takePresetValues()
  {
    const PresetMatch& match = survey_.lidars.front().preset;
    if (match.preset == nullptr) return;
    const Config values = configOf(*match.preset);
    const std::string reason =
        "params/" + std::string(match.preset->name) + ".yaml: " + match.reason;
    LidarOptions& lidar = config_.odometry.lidar;
    const auto take = [&](const char* key, double& member, double value)
    {
      if (member != value) set(key, member, value, reason);
    };
    take("lidar.min_range", lidar.min_range, values.odometry.lidar.min_range);
    take("lidar.max_range", lidar.max_range, values.odometry.lidar.max_range);
    take(
        "measurement.range_noise", config_.odometry.measurement.range_noise,
        values.odometry.measurement.range_noise);
  }

  [[nodiscard]] std::string header() const
  {
    std::string text = "# Parameters for fastlio-replay -c, proposed by fastlio-info for\n";
    for (const std::string& file : survey_.files)
      text += "#   " + printable(std::filesystem::path(file).filename().string()) + "\n";
    text +=
        "# What is not here keeps its default (docs/parameters.md). Edit what you know better.\n";
    for (const std::string& note : notes_)
      text += "# " + note + "\n";
    for (const std::string& warning : survey_.warnings)
      text += "# Warning: " + printable(warning) + "\n";
    return text;
  }

  [[nodiscard]] std::string body() const
  {
    std::string text;
    std::string_view group;
    for (const auto& row : configTable())
    {
      const std::string value = valueText(row, config_);
      const auto reason = reasons_.find(std::string(row.key));
      if (reason == reasons_.end() && value == valueText(row, defaults_)) continue;
      if (groupOf(row.key) != group && !groupOf(row.key).empty())
        text += std::string(groupOf(row.key)) + ":\n";
      group = groupOf(row.key);
      text += (group.empty() ? "" : "  ") + std::string(nameOf(row.key)) + ": " + value + "  # " +
              (reason == reasons_.end() ? std::string("given") : reason->second) + "\n";
    }
    return text;
  }

  const RecordingSurvey& survey_;
  Config config_;
  const Config given_, defaults_{};
  std::map<std::string, std::string> reasons_;  // by key
  std::vector<std::string> notes_;
};
}  // namespace

std::string proposedConfig(const RecordingSurvey& survey, const Config& given)
{
  return Proposal(survey, given).text();
}

}  // namespace fastlio
