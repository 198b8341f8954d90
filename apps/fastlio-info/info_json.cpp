// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "info_report.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/options/json_text.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>

#include <nlohmann/json.hpp>

namespace fastlio
{
namespace
{
Json json(const ReadProblem& problem)
{
  return {
      {"kind", toString(problem.kind)},
      {"file", problem.file},
      {"message", problem.message},
      {"occurrences", problem.occurrences}};
}

const char* nameOf(SensorKind kind)
{
  return kind == SensorKind::Lidar ? "lidar" : kind == SensorKind::Imu ? "imu" : "other";
}

Json json(const SurveyedSensor& sensor)
{
  const SensorSummary& s = sensor.summary;
  const StampReport& stamps = sensor.stamps;
  return {
      {"label", printable(s.label)},
      {"class", s.class_name},
      {"kind", nameOf(s.kind)},
      {"usable", s.usable},
      {"content", printable(s.detail)},
      {"observations", stamps.count},
      {"first_stamp", secondsText(stamps.first_ns)},
      {"last_stamp", secondsText(stamps.last_ns)},
      {"rate_hz", stamps.rate()},
      {"jitter_s", stamps.jitter},
      {"longest_interval_s", stamps.longest_gap},
      {"gaps", stamps.gaps},
      {"out_of_order", stamps.backwards},
      {"duplicates", stamps.duplicates},
      {"T_vehicle_sensor", poseJson(s.T_vehicle_sensor)}};
}

Json timesJson(const LidarPlan& plan)
{
  const PointTimeFinding& finding = plan.finding;
  Json candidates = Json::array();
  for (const PointTimeReading& reading : finding.candidates)
    candidates.push_back(
        {{"unit", fastlio::nameOf(reading.unit)},
         {"reference", fastlio::nameOf(reading.reference)}});
  Json times{
      {"verdict", fastlio::nameOf(finding.verdict)},
      {"compensated", plan.compensated},
      {"text", plan.text}};
  if (finding.verdict == PointTimeVerdict::Found)
    times.update(
        {{"unit", fastlio::nameOf(finding.reading.unit)},
         {"reference", fastlio::nameOf(finding.reading.reference)},
         {"begin_s", finding.begin},
         {"end_s", finding.end}});
  if (!candidates.empty()) times["candidates"] = candidates;
  return times;
}

Json json(const RecordingSurvey& survey, const SurveyedLidar& lidar)
{
  const LidarLook& look = lidar.look;
  const SensorSummary& summary = survey.sensors[lidar.index].summary;
  Json times = timesJson(lidar.plan);
  if (summary.times_by_sensor) times["verdict"] = "by_sensor";
  Json preset;
  if (lidar.preset.preset != nullptr) preset = std::string(lidar.preset.preset->name);
  return {
      {"label", printable(summary.label)},
      {"point_times", times},
      {"points_per_scan", look.pointsPerScan()},
      {"lines", look.lines()},
      {"elevation_deg", {look.lowest(), look.highest()}},
      {"azimuth_coverage", look.coverage()},
      {"range_m",
       {{"p1", look.rangeQuantile(0.01)},
        {"median", look.rangeQuantile(0.5)},
        {"p99", look.rangeQuantile(0.99)}}},
      {"preset", preset},
      {"preset_reason", lidar.preset.reason}};
}

Json imuJson(const RecordingSurvey& survey)
{
  const ImuSurvey& imu = survey.imu;
  const SurveyedSensor& sensor = survey.sensors[*survey.imu_index];
  Json all{
      {"label", printable(sensor.summary.label)},
      {"rests", imu.rests},
      {"largest_rate", imu.gyro_max},
      {"largest_acceleration", imu.accel_max}};
  if (!imu.rests) return all;
  all.update(
      {{"rest_s", imu.rest_seconds},
       {"rest_begins_s", toSeconds(imu.rest_begin_ns - sensor.stamps.first_ns)},
       {"gravity", imu.accel_norm},
       {"acceleration_unit", imu.accel_unit},
       {"up", vectorJson(imu.up)},
       {"gyro_bias", vectorJson(imu.gyro_mean)},
       {"gyro_noise_density", imu.gyro_noise_density},
       {"acceleration_noise_density", imu.accel_noise_density}});
  return all;
}

Json motionJson(const RecordingSurvey& survey)
{
  const MotionCheck& motion = *survey.motion;
  Json all{
      {"conclusive", motion.conclusive},
      {"pairs", motion.turns},
      {"correlation", motion.correlation}};
  if (motion.conclusive)
  {
    all["time_offset_s"] = motion.time_offset;
    all["time_offset_std_s"] = motion.time_offset_std;
    all["imu_rate_over_lidar_rate"] = motion.scale;
  }
  if (motion.rotation_known)
  {
    all["mounting_error_deg"] = kDegPerRad * survey.rotation_error;
    all["mounting_error_std_deg"] = kDegPerRad * motion.rotation_std;
  }
  return all;
}
}  // namespace

std::string toJson(const RecordingSurvey& survey)
{
  Json problems = Json::array(), sensors = Json::array(), lidars = Json::array();
  for (const ReadProblem& problem : survey.problems)
    problems.push_back(json(problem));
  for (const SurveyedSensor& sensor : survey.sensors)
    sensors.push_back(json(sensor));
  for (const SurveyedLidar& lidar : survey.lidars)
    lidars.push_back(json(survey, lidar));
  Json all{
      {"files", survey.files},
      {"usable", survey.unusable.empty()},
      {"problems", problems},
      {"sensors", sensors},
      {"lidars", lidars}};
  if (!survey.unusable.empty()) all["reason"] = survey.unusable;
  if (survey.imu_index)
  {
    all["imu"] = imuJson(survey);
    all["overlap"] = {
        {"seconds", survey.overlap.seconds},
        {"share_of_lidar", survey.overlap.fraction},
        {"lidar_lead_s", survey.overlap.lead}};
    if (survey.motion) all["motion"] = motionJson(survey);
  }
  all["notes"] = survey.notes;
  all["warnings"] = survey.warnings;
  return jsonText(all);
}

}  // namespace fastlio
