// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "info_report.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/plain_zero.h>
#include <fastlio/options/printable.h>

#include <mrpt/core/format.h>

#include <array>
#include <cmath>

namespace fastlio
{
namespace
{
using mrpt::format;

std::string line(const char* label, const std::string& text)
{
  return format("  %-12s", label) + text + "\n";
}

std::string kindText(SensorKind kind)
{
  switch (kind)
  {
    case SensorKind::Lidar:
      return "LiDAR";
    case SensorKind::Imu:
      return "IMU";
    case SensorKind::Other:
      break;
  }
  return "not used";
}

std::string rhythmText(const StampReport& stamps)
{
  std::string text = format(
      "%zu observations in %.2f s, %.2f Hz, jitter %.2f ms, longest interval %.3f s", stamps.count,
      toSeconds(stamps.last_ns - stamps.first_ns), stamps.rate(), 1e3 * stamps.jitter,
      stamps.longest_gap);
  if (stamps.gaps > 0) text += ", " + countedText(stamps.gaps, "gap");
  if (stamps.backwards > 0) text += ", " + countedText(stamps.backwards, "stamp") + " out of order";
  if (stamps.duplicates > 0) text += ", " + countedText(stamps.duplicates, "stamp") + " twice";
  return text;
}

std::string poseLine(const Pose& T)
{
  auto n = sixNumbers(T);
  for (std::size_t i = 0; i < n.size(); ++i)
    n[i] = plainZero(n[i], i < 3 ? 3 : 2);
  return format(
      "x %.3f y %.3f z %.3f m, yaw %.2f pitch %.2f roll %.2f deg", n[0], n[1], n[2], n[3], n[4],
      n[5]);
}

/** Whether the recording is damaged, so that a run ends with another status. */
std::string endText(const RecordingSurvey& survey)
{
  if (!survey.unusable.empty()) return "fastlio-replay CANNOT run on this: " + survey.unusable;
  if (survey.problems.empty() && survey.warnings.empty()) return "fastlio-replay can run on this.";
  if (survey.problems.empty())
    return "fastlio-replay can run on this, but read what is marked WARNING above first.";
  return "fastlio-replay can run on what could be read of this. The recording is damaged (see "
         "trouble above): a run ends with exit status 3.";
}

std::string sensorText(const SurveyedSensor& sensor)
{
  const SensorSummary& s = sensor.summary;
  std::string text = "'" + printable(s.label) + "'  " + kindText(s.kind) +
                     (s.kind != SensorKind::Other && !s.usable ? ", not usable" : "") + "\n";
  text += line("class", s.class_name);
  if (!s.detail.empty()) text += line("content", printable(s.detail));
  text += line(
      "stamps", secondsText(sensor.stamps.first_ns) + " to " + secondsText(sensor.stamps.last_ns));
  text += line("rhythm", rhythmText(sensor.stamps));
  return text + line("pose", poseLine(s.T_vehicle_sensor));
}

std::string presetText(const PresetMatch& match, bool automatic)
{
  if (match.preset == nullptr) return "none: " + match.reason;
  return "params/" + std::string(match.preset->name) + ".yaml (" +
         std::string(match.preset->title) + "): " + match.reason +
         (automatic ? "; fastlio-replay uses its values by itself" : "");
}

std::string lidarText(const RecordingSurvey& survey, const SurveyedLidar& lidar)
{
  const LidarLook& look = lidar.look;
  std::string text = "LiDAR '" + printable(survey.sensors[lidar.index].summary.label) + "'\n";
  text += line("times", lidar.plan.text);
  text += line(
      "points", format("%.0f per scan", look.pointsPerScan()) +
                    (look.lines() > 0 ? format(" in %i lines", look.lines()) : std::string()));
  text += line(
      "view", format(
                  "elevations %.1f to %.1f deg, %.0f %% of the azimuths", look.lowest(),
                  look.highest(), 100.0 * look.coverage()));
  text += line(
      "ranges", format(
                    "%.2f m (1 %%), %.2f m (median), %.2f m (99 %%)", look.rangeQuantile(0.01),
                    look.rangeQuantile(0.5), look.rangeQuantile(0.99)));
  const SensorSummary& sensor = survey.sensors[lidar.index].summary;
  const bool named = namedModel(sensor.label + " " + sensor.detail) != nullptr;
  return text + line("preset", presetText(lidar.preset, named && &lidar == &survey.lidars.front()));
}

/** As far as the motion of the LiDAR tells it; else what MRPT prescribes. */
std::string gyroUnit(const RecordingSurvey& survey)
{
  constexpr double kDegrees = 10.0;  // times as fast as the LiDAR
  const bool degrees =
      survey.motion && survey.motion->conclusive && survey.motion->scale > kDegrees;
  return degrees ? "deg/s" : "rad/s";
}

std::string imuText(const RecordingSurvey& survey)
{
  const ImuSurvey& imu = survey.imu;
  std::string text = "IMU '" + printable(survey.sensors[*survey.imu_index].summary.label) + "'\n";
  text += line(
      "largest", format(
                     "angular rate %.3g, acceleration %.4g, in the units of the recording",
                     imu.gyro_max, imu.accel_max));
  if (!imu.rests) return text + line("rest", "never for a second");
  const auto& stamps = survey.sensors[*survey.imu_index].stamps;
  text += line(
      "rest", format(
                  "%.2f s, beginning %.2f s after the start", imu.rest_seconds,
                  toSeconds(imu.rest_begin_ns - stamps.first_ns)));
  const std::string gyro_unit = gyroUnit(survey);
  const std::string unit = imu.accel_unit.empty() ? "(unit unclear)" : imu.accel_unit;
  const auto [x, y, z] =
      std::array{plainZero(imu.up.x(), 3), plainZero(imu.up.y(), 3), plainZero(imu.up.z(), 3)};
  text += line(
      "gravity", format("%.4f ", imu.accel_norm) + unit +
                     format(" at rest, up is [%.3f %.3f %.3f] in the IMU's frame", x, y, z));
  text += line(
      "gyro bias",
      format("[%.5f %.5f %.5f] ", imu.gyro_mean.x(), imu.gyro_mean.y(), imu.gyro_mean.z()) +
          gyro_unit + " at rest");
  return text +
         line(
             "noise", format(
                          "gyro %.2g %s/sqrt(Hz), acceleration %.2g ", imu.gyro_noise_density,
                          gyro_unit.c_str(), imu.accel_noise_density) +
                          unit + "/sqrt(Hz), at rest");
}

std::string motionText(const RecordingSurvey& survey)
{
  std::string text = "LiDAR and IMU\n";
  text += line(
      "clocks",
      format(
          "%.2f s in common (%.0f %% of the LiDAR's); in the file a scan's stamp is %.3f s "
          "after the newest IMU stamp",
          survey.overlap.seconds, 100.0 * survey.overlap.fraction, survey.overlap.lead));
  if (!survey.motion) return text;
  const MotionCheck& motion = *survey.motion;
  if (motion.conclusive)
  {
    text += line(
        "offset",
        format(
            "lidar.time_offset of about %.3f s +- %.3f s (%zu pairs of scans, correlation %.2f)",
            motion.time_offset, motion.time_offset_std, motion.turns, motion.correlation));
    text += line("gyro", format("turns %.2f times as fast as the LiDAR", motion.scale));
  }
  else
  {
    const std::string sharpness =
        std::isfinite(motion.time_offset_std)
            ? format(", time offset known to %.3f s", motion.time_offset_std)
            : "";
    text += line(
        "motion", format(
                      "not conclusive: %zu pairs of scans, correlation %.2f", motion.turns,
                      motion.correlation) +
                      sharpness);
  }
  const std::string rotation =
      motion.rotation_known
          ? format(
                "the given rotation of the LiDAR differs by %.1f deg +- %.1f deg from the one that "
                "both motions show",
                kDegPerRad * survey.rotation_error, kDegPerRad * motion.rotation_std)
          : std::string("not known: turn fast, about more than one axis");
  return text + line("rotation", rotation);
}

std::string listText(const char* title, const std::vector<std::string>& sentences)
{
  std::string text;
  for (const std::string& sentence : sentences)
    text += std::string(title) + sentence + "\n";
  return text;
}
}  // namespace

std::string toTable(const RecordingSurvey& survey)
{
  std::string text;
  for (const std::string& file : survey.files)
    text += file + "\n";
  // Where nothing can be read, the last line names the problems.
  if (!survey.sensors.empty())
    for (const ReadProblem& problem : survey.problems)
      text += "trouble: " + sentenceOf(problem) + "\n";
  for (const SurveyedSensor& sensor : survey.sensors)
    text += "\n" + sensorText(sensor);
  for (const SurveyedLidar& lidar : survey.lidars)
    text += "\n" + lidarText(survey, lidar);
  if (survey.imu_index) text += "\n" + imuText(survey) + "\n" + motionText(survey);
  text += "\n" + listText("note: ", survey.notes) + listText("WARNING: ", survey.warnings);
  return text + endText(survey) + "\n";
}

}  // namespace fastlio
