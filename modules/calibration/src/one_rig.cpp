// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_rig.h"

#include <fastlio/math/so3.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/survey/input_plan.h>

#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
// Drivers and rewritten recordings round poses.
constexpr double kSamePlace = 1e-3;     // [m]
constexpr double kSameRotation = 1e-3;  // [rad]
constexpr int kDigits = 6;

/** What a recording says of its sensors. */
struct RigSensors
{
  std::string lidar;  //!< class, and model where the observations name it
  Pose T_vehicle_lidar, T_vehicle_imu;
};

RigSensors sensorsOf(const CalibrationRecording& recording, const Config& config)
{
  const SensorSelection selection = sensorsIn(recording.files, config.sensors);
  const SensorSummary& lidar = selection.lidar;
  RigSensors sensors;
  sensors.lidar = lidar.class_name;
  // "VLP-16, 76 packets with 29000 points"; what others say has no model.
  if (lidar.class_name == "mrpt::obs::CObservationVelodyneScan")
    sensors.lidar += " of a " + lidar.detail.substr(0, lidar.detail.find(','));
  sensors.T_vehicle_lidar = config.sensors.T_vehicle_lidar.value_or(lidar.T_vehicle_sensor);
  sensors.T_vehicle_imu = config.sensors.T_vehicle_imu.value_or(selection.imu.T_vehicle_sensor);
  return sensors;
}

bool isSame(const Pose& a, const Pose& b)
{
  return (a.p - b.p).norm() < kSamePlace && logSO3(a.R.transpose() * b.R).norm() < kSameRotation;
}

/** Sentences on what differs; empty: nothing. */
std::string differences(const RigSensors& first, const RigSensors& other)
{
  std::string text;
  if (other.lidar != first.lidar)
    text += "\n  its LiDAR is " + printable(other.lidar) + ", not " + printable(first.lidar);
  const auto compare = [&text](const char* sensor, const Pose& a, const Pose& b)
  {
    if (!isSame(a, b))
      text += std::string("\n  its ") + sensor + " sits at " + poseText(b, kDigits) + ", not at " +
              poseText(a, kDigits) + " [m, deg]";
  };
  compare("LiDAR", first.T_vehicle_lidar, other.T_vehicle_lidar);
  compare("IMU", first.T_vehicle_imu, other.T_vehicle_imu);
  return text;
}
}  // namespace

void requireOneRig(const std::vector<CalibrationRecording>& recordings, const Config& config)
{
  if (recordings.size() < 2) return;
  const RigSensors first = sensorsOf(recordings.front(), config);
  for (std::size_t i = 1; i < recordings.size(); ++i)
  {
    const std::string text = differences(first, sensorsOf(recordings[i], config));
    if (!text.empty())
      throw std::runtime_error(
          "'" + printable(recordings[i].name) + "' is of another rig than '" +
          printable(recordings.front().name) + "':" + text + "\nCalibrate each rig by itself.");
  }
}

}  // namespace fastlio
