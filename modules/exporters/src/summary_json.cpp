// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_file_exporter.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/math/angles.h>
#include <fastlio/options/json_text.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/option_table.h>
#include <fastlio/sensors/conversions.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace fastlio
{
namespace
{
Json parametersJson(const std::vector<OptionText>& options)
{
  Json json = Json::object();
  for (const OptionText& option : options)
  {
    const std::string group(groupOf(option.key));
    (group.empty() ? json : json[group])[std::string(nameOf(option.key))] =
        option.is_text ? Json(option.text) : jsonValue(option.text);
  }
  return json;
}

Json filesJson(const std::vector<OutputFile>& files)
{
  Json json = Json::array();
  for (const auto& file : files)
    json.push_back({{"path", file.path}, {"bytes", file.bytes}});
  return json;
}

Json placesJson(const std::vector<SensorPlace>& places)
{
  Json json = Json::array();
  for (const SensorPlace& place : places)
  {
    const auto pose = toMrptPose(place.T_vehicle_sensor);
    json.push_back(
        {{"sensor", place.kind == SensorKind::Imu ? "IMU" : "LiDAR"},
         {"label", place.label},
         {"xyz_m", {pose.x(), pose.y(), pose.z()}},
         {"yaw_pitch_roll_deg",
          {kDegPerRad * pose.yaw(), kDegPerRad * pose.pitch(), kDegPerRad * pose.roll()}},
         {"origin", place.origin}});
  }
  return json;
}

Json inputJson(const RunSummary& run)
{
  Json files = Json::array();
  for (const auto& file : run.inputs)
    files.push_back({{"path", file.path}, {"bytes", file.bytes}});
  Json counts = Json::object();
  for (const auto& count : run.input_counts)
    counts[count.name] = count.count;
  return {
      {"files", files},
      {"sensors", run.sensors},
      {"sensor_poses", placesJson(run.places)},
      {"counts", counts},
      {"problems", run.input_problems}};
}

Json scansJson(const RunStatistics& statistics)
{
  Json json = {{"processed", statistics.scans()}, {"with_pose", statistics.poses()}};
  for (std::size_t i = 0; i < kScanStatusCount; ++i)
  {
    const auto status = static_cast<ScanStatus>(i);
    json[machineName(status)] = statistics.count(status);
  }
  return json;
}

Json pointsJson(const PointTotals& points)
{
  return {
      {"in", points.in},
      {"dropped_invalid", points.invalid},
      {"dropped_near", points.near},
      {"dropped_far", points.far},
      {"dropped_own_body", points.own_body},
      {"after_downsampling", points.downsampled},
      {"effective", points.effective}};
}

Json troubleJson(const Trouble& trouble)
{
  return {
      {"scan", trouble.scan_index},
      {"stamp", secondsText(trouble.stamp_ns)},
      {"status", machineName(trouble.status)},
      {"message", trouble.message}};
}

Json troublesJson(const RunStatistics& statistics)
{
  Json json = Json::array();
  for (const auto& trouble : statistics.troubles())
    json.push_back(troubleJson(trouble));
  return json;
}

Json degenerateDirectionsJson(const DegenerateDirections& open)
{
  if (open.scans == 0) return {{"scans", 0}};
  return {
      {"scans", open.scans},
      {"first", secondsText(open.first_ns)},
      {"last", secondsText(open.last_ns)},
      {"weakest",
       {{open.weakest.is_rotation ? "rotation_about_imu_axis" : "translation_along_world_axis",
         vectorJson(open.weakest.axis)},
        {"signal_to_noise", open.signal_to_noise}}}};
}

/** The calibration as estimated at the end: changes against what was given, and their standard
 * deviations; null when nothing of it is estimated. */
Json calibrationJson(const RunSummary& run)
{
  const CalibrationOptions& p = run.odometry.calibration;
  const std::optional<FilterState>& last = run.statistics.lastState();
  Json json = nullptr;
  if (!last) return json;
  const auto sigma = [&](StateBlock block)
  { return Vec3(last->P.diagonal().segment<3>(block).cwiseMax(0.0).cwiseSqrt()); };
  if (p.estimate_extrinsic)
  {
    const Pose& C = last->x.extrinsic_correction;
    json["rotation_correction_deg"] = vectorJson(kDegPerRad * logSO3(C.R));
    json["rotation_sigma_deg"] = vectorJson(kDegPerRad * sigma(kExtrinsicRotation));
    json["translation_correction_m"] = vectorJson(C.p);
    json["translation_sigma_m"] = vectorJson(sigma(kExtrinsicTranslation));
  }
  if (p.estimate_time_offset)
  {
    json["time_offset_s"] = run.odometry.lidar.time_offset + last->x.time_offset;
    const double variance = last->P(kTimeOffset, kTimeOffset);
    // Not a part of the state before the map makes it observable: as uncertain as given.
    json["time_offset_sigma_s"] = variance > 0.0 ? std::sqrt(variance) : p.time_offset_std;
  }
  return json;
}

/** How wrong the calibration in use is, by the innovations of the whole run. */
Json calibrationCheckJson(const CalibrationCheck& check)
{
  return {
      {"extrinsic_rotation_error_deg", vectorJson(kDegPerRad * check.rotation)},
      {"extrinsic_rotation_sigma_deg", vectorJson(kDegPerRad * check.rotation_std)},
      {"extrinsic_translation_error_m", vectorJson(check.translation)},
      {"extrinsic_translation_sigma_m", vectorJson(check.translation_std)},
      {"innovation_scale", check.innovation_scale},
      {"beam_range_offset_m", check.range_offset},
      {"beam_elevation_offset_deg", kDegPerRad * check.elevation_offset},
      {"beam_azimuth_offset_deg", kDegPerRad * check.azimuth_offset},
      {"side_range_offset_m", check.side_range_offset}};
}

Json healthJson(const RunHealth& health)
{
  Json causes = Json::object();
  for (const auto& [cause, count] : health.causes())
    causes[toString(cause)] = count;
  Json first = nullptr;
  if (const auto& trouble = health.firstTrouble())
    first = {
        {"second", trouble->second},
        {"scan", trouble->scan},
        {"stamp", secondsText(trouble->stamp_ns)},
        {"value", trouble->health.value},
        {"cause", toString(trouble->health.cause)},
        {"reason", trouble->health.reason}};
  Json untrusted = Json::array();
  for (const UntrustedStretch& stretch : health.untrusted())
    untrusted.push_back(
        {{"from_s", stretch.begin_s},
         {"to_s", stretch.end_s},
         {"from", secondsText(stretch.begin_ns)},
         {"to", secondsText(stretch.end_ns)},
         {"scans", stretch.scans},
         {"cause", toString(stretch.cause)},
         {"reason", stretch.reason}});
  return {{"scans", health.scans()}, {"troubled", health.troubled()}, {"mean", health.mean()},
          {"worst", health.worst()}, {"first_trouble", first},        {"causes", causes},
          {"untrusted", untrusted}};
}

Json imuJson(const ImuReport& imu)
{
  return {
      {"accel_unit", toString(imu.accel_unit)},
      {"gyro_unit", toString(imu.gyro_unit)},
      {"rate_hz", imu.rate},
      {"jitter", imu.jitter},
      {"gaps", imu.gaps},
      {"missing", imu.missing},
      {"longest_gap_s", imu.longest_gap},
      {"spikes", imu.spikes},
      {"saturated", imu.saturated},
      {"bad_stamps", imu.bad_stamps},
      {"clock_steps", imu.clock_steps}};
}

Json diagnosticsJson(const std::vector<Diagnostic>& diagnostics)
{
  Json json = Json::array();
  for (const Diagnostic& diagnostic : diagnostics)
    json.push_back({{"stamp", secondsText(diagnostic.stamp_ns)}, {"text", diagnostic.text}});
  return json;
}

Json timeJson(const RunSummary& run)
{
  const ScanTimeSummary ms = run.statistics.scanTimes();
  return {
      {"begin", secondsText(run.statistics.beginNs())},
      {"end", secondsText(run.statistics.endNs())},
      {"duration_s", run.statistics.duration()},
      {"wall_s", run.wall_seconds},
      {"compute_s", run.statistics.computeSeconds()},
      {"real_time_factor", realTimeFactor(run)},
      {"ms_per_scan",
       {{"mean", ms.mean}, {"median", ms.median}, {"p99", ms.p99}, {"max", ms.max}}}};
}

Json summaryJson(const RunSummary& run)
{
  const ExitStatus status = exitStatusOf(run);
  const auto trouble = run.statistics.firstTrouble();
  return {
      {"program", run.program},
      {"version", run.version},
      {"status", toString(status)},
      {"exit_status", static_cast<int>(status)},
      {"configuration", run.configuration},
      {"frame", run.frame},
      {"map_origin_m", vectorJson(run.map_origin)},
      {"input", inputJson(run)},
      {"scans", scansJson(run.statistics)},
      {"points", pointsJson(run.statistics.points())},
      {"path_length_m", run.statistics.pathLength()},
      {"time", timeJson(run)},
      {"degenerate_directions", degenerateDirectionsJson(run.statistics.degenerateDirections())},
      {"calibration", calibrationJson(run)},
      {"calibration_check", calibrationCheckJson(run.statistics.calibration())},
      {"health", healthJson(run.statistics.health())},
      {"imu", imuJson(run.imu)},
      {"diagnostics", diagnosticsJson(run.diagnostics)},
      {"first_trouble", trouble ? troubleJson(*trouble) : Json(nullptr)},
      {"troubles", troublesJson(run.statistics)},
      {"outputs", filesJson(run.outputs)},
      {"failure", run.failure},
      {"output_problems", run.output_problems},
      {"parameters", parametersJson(run.options)}};
}
}  // namespace

std::unique_ptr<Exporter> makeSummaryExporter(const std::string& path)
{
  return writtenAtEnd(
      path,
      [](const RunEnd& end, AtomicFile& file) { file.write(jsonText(summaryJson(end.summary))); });
}

}  // namespace fastlio
