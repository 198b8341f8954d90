// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "survey_diagnostics.h"

#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/options/printable.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kSteepTilt = 30.0;     // [deg]
constexpr double kOnItsHead = 150.0;    // [deg]
constexpr double kOddScale = 0.1;       // of the gyro; the check is rough
constexpr double kOddRotation = 10.0;   // between found and given mounting [deg]
constexpr double kOddOffset = 0.02;     // the check is rough [s]
constexpr double kDegreesScale = 10.0;  // rates differ by more: the gyro is in deg/s
constexpr double kLittleOverlap = 0.9;
// No inertial sensor is so quiet: these are readings that repeat, and rounding.
constexpr double kNoGyroNoise = 1e-7;   // [rad/s/sqrt(Hz)]
constexpr double kNoAccelNoise = 1e-6;  // [m/s^2/sqrt(Hz)]
constexpr double kSlowImu = 50.0;       // [Hz]

void warn(RecordingSurvey& survey, std::string text)
{
  survey.warnings.push_back(std::move(text));
}

void reportRhythm(RecordingSurvey& survey, const SurveyedSensor& sensor, const char* what)
{
  const StampReport& stamps = sensor.stamps;
  const std::string shown = printable(sensor.summary.label);
  const char* label = shown.c_str();
  if (stamps.gaps > 0)
    warn(
        survey, mrpt::format(
                    "%s '%s': %zu %s of %.3f s at %.3f s after its start.", what, label,
                    stamps.gaps, stamps.gaps == 1 ? "gap" : "gaps, the longest", stamps.longest_gap,
                    toSeconds(stamps.longest_gap_ns - stamps.first_ns)));
  if (stamps.backwards + stamps.duplicates > 0)
    warn(
        survey, mrpt::format(
                    "%s '%s': %zu repeated stamps, %zu out of order.", what, label,
                    stamps.duplicates, stamps.backwards));
}

/** Only scans with points are looked at. */
void reportPoints(RecordingSurvey& survey)
{
  const SurveyedLidar& lidar = survey.lidars.front();
  if (!survey.unusable.empty() || lidar.look.scans() > 0) return;
  survey.unusable = "none of the scans of LiDAR '" +
                    printable(survey.sensors[lidar.index].summary.label) +
                    "' has a point: was its view covered, or did it not turn?";
}

void reportOverlap(RecordingSurvey& survey)
{
  const ClockOverlap& overlap = survey.overlap;
  if (overlap.seconds <= 0)
    warn(
        survey,
        mrpt::format(
            "LiDAR and IMU have no time in common: %.3f s lie between them. Are their clocks "
            "the same? lidar.time_offset shifts the LiDAR's.",
            -overlap.seconds));
  else if (overlap.fraction < kLittleOverlap)
    warn(
        survey,
        mrpt::format("The IMU covers %.0f %% of the LiDAR's time only.", 100.0 * overlap.fraction));
}

void reportImu(
    RecordingSurvey& survey, const SensorOptions& sensors, const OdometryOptions& odometry)
{
  const ImuSurvey& imu = survey.imu;
  const SurveyedSensor& sensor = survey.sensors[*survey.imu_index];
  if (sensor.stamps.rate() < kSlowImu)
    warn(survey, mrpt::format("The IMU is slow: %.1f Hz.", sensor.stamps.rate()));
  const bool must_rest = odometry.initialization.mode == InitializationMode::Rest;
  if (!imu.rests)
  {
    if (must_rest)
      warn(
          survey,
          "The platform is never at rest for a second: start in motion (initialization.mode: "
          "auto).");
    else
      survey.notes.emplace_back(
          "The platform is never at rest for a second: the odometry starts in motion.");
    return;
  }
  const double before = toSeconds(imu.rest_begin_ns - sensor.stamps.first_ns);
  if (before > odometry.initialization.duration && must_rest)
    survey.notes.push_back(mrpt::format(
        "The longest rest (%.1f s) begins %.1f s after the start; initialization.mode: auto does "
        "not wait for it.",
        imu.rest_seconds, before));
  if (imu.gyro_noise_density < kNoGyroNoise && imu.accel_noise_density < kNoAccelNoise)
    warn(
        survey,
        mrpt::format(
            "All inertial readings are the same for %.1f s: has the driver or the bus of the IMU "
            "stopped?",
            imu.rest_seconds));
  if (imu.accel_unit.empty())
    warn(
        survey, mrpt::format(
                    "The specific force at rest is %.4g, which is gravity neither in m/s^2, g nor "
                    "mg: is the rest one, is the sensor calibrated?",
                    imu.accel_norm));
  else if (imu.accel_unit != "m/s^2")
    warn(survey, "The specific force is in " + imu.accel_unit + ", not in m/s^2.");
  const double tilt = kDegPerRad * tiltOf(survey, sensors);
  if (tilt > kOnItsHead)
    survey.notes.push_back(mrpt::format(
        "By its sensor pose and the specific force the vehicle stands on its head at rest (%.0f "
        "deg). If it does not, the specific force has the wrong sign: at rest it points up (+9.81 "
        "m/s^2 along the axis that points up); the odometry cannot run with the other sign.",
        tilt));
  else if (tilt > kSteepTilt)
    survey.notes.push_back(mrpt::format(
        "By its sensor pose the vehicle stands tilted by %.0f deg at rest; the odometry does not "
        "mind, but is the pose of the IMU right?",
        tilt));
}

void diagnoseRates(
    const MotionCheck& motion, const OdometryOptions& odometry, RecordingSurvey& survey)
{
  if (motion.scale > kDegreesScale)
    warn(
        survey, mrpt::format(
                    "The gyro turns %.1f times as fast as the LiDAR: it is in deg/s, not rad/s.",
                    motion.scale));
  else if (std::abs(motion.scale - 1.0) > kOddScale)
    warn(
        survey, mrpt::format(
                    "The gyro turns %.2f times as fast as the LiDAR, and deg/s would be 57 times: "
                    "its readings have another unit or a wrong scale. Correct them in the "
                    "recording; imu.gyro_matrix takes off some per cent.",
                    motion.scale));
  const double offset = motion.time_offset - odometry.lidar.time_offset;
  if (std::abs(offset) > kOddOffset)
    warn(
        survey, mrpt::format(
                    "The stamps of LiDAR and IMU differ: lidar.time_offset should be about %.3f s "
                    "(correlation %.2f). Half or a whole scan period means that the stamp's "
                    "reference is another (input.point_time_reference).",
                    motion.time_offset, motion.correlation));
}

void diagnoseMotion(RecordingSurvey& survey, const OdometryOptions& odometry)
{
  if (!survey.motion) return;
  const MotionCheck& motion = *survey.motion;
  if (motion.conclusive) diagnoseRates(motion, odometry, survey);
  const double angle = kDegPerRad * survey.rotation_error;
  if (motion.rotation_known && angle > kOddRotation)
    warn(
        survey, mrpt::format(
                    "The given poses turn the LiDAR by %.0f deg from what both motions "
                    "show; check sensorPose, input.T_vehicle_lidar and input.T_vehicle_imu. "
                    "fastlio-calibrate finds the right one.",
                    angle));
}
}  // namespace

double tiltOf(const RecordingSurvey& survey, const SensorOptions& sensors)
{
  const Pose T_vehicle_imu =
      sensors.T_vehicle_imu.value_or(survey.sensors[*survey.imu_index].summary.T_vehicle_sensor);
  const Vec3 up = T_vehicle_imu.R * survey.imu.up;
  return std::acos(std::clamp(up.z(), -1.0, 1.0));
}

void addRemarks(
    RecordingSurvey& survey, const SensorOptions& sensors, const OdometryOptions& odometry)
{
  for (const SurveyedLidar& lidar : survey.lidars)
    reportRhythm(survey, survey.sensors[lidar.index], "LiDAR");
  reportRhythm(survey, survey.sensors[*survey.imu_index], "IMU");
  reportOverlap(survey);
  reportImu(survey, sensors, odometry);
  diagnoseMotion(survey, odometry);
  reportPoints(survey);
}

}  // namespace fastlio
