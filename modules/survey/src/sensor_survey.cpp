// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/options/label_pattern.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/imu_conversion.h>
#include <fastlio/sensors/point_cloud_conversion.h>
#include <fastlio/sensors/rotating_scan.h>
#include <fastlio/sensors/velodyne_decoder.h>
#include <fastlio/sensors/xyzirt_access.h>
#include <fastlio/survey/sensor_selection.h>

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/rtti/CObject.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace fastlio;
using mrpt::obs::CObservation;

// The meaning of point times shows from several scans that have points.
constexpr std::size_t kFewestScans = 5;
// A LiDAR may begin with empty scans (its motor starts, a cover is on it). A minute of them at 10
// Hz is waited for, so that a LiDAR that never has points is told in time.
constexpr std::size_t kMostEmptyScans = 600;

// The facts of one observation about its sensor.
struct Appearance
{
  SensorKind kind = SensorKind::Other;
  bool usable = false;
  std::string detail;
};

Appearance appearanceOf(const mrpt::obs::CObservationIMU& imu)
{
  const ImuDefect defect = toImuSample(imu).defect;
  // A single bad value does not make a sensor unusable.
  const bool usable = defect == ImuDefect::None || defect == ImuDefect::NotFinite;
  return {SensorKind::Imu, usable, usable ? "acceleration and angular rate" : toString(defect)};
}

Appearance appearanceOf(const mrpt::obs::CObservationVelodyneScan& scan)
{
  const std::string model = velodyneModelName(scan);
  if (scan.scan_packets.empty())
    return {
        SensorKind::Lidar, true,
        model + ", no packets, " + std::to_string(scan.point_cloud.size()) + " cached points" +
            (scan.point_cloud.timestamp.empty() ? ", no time per point" : " with time per packet")};
  try
  {
    const std::size_t points = decodeVelodyne(scan).points.size();
    return {
        SensorKind::Lidar, true,
        model + ", " + std::to_string(scan.scan_packets.size()) + " packets with " +
            std::to_string(points) + " points"};
  }
  catch (const std::runtime_error& e)
  {
    return {SensorKind::Lidar, false, e.what()};
  }
}

Appearance appearanceOf(const mrpt::obs::CObservationPointCloud& scan)
{
  if (!scan.pointcloud) return {SensorKind::Lidar, false, "no points"};
  const CloudColumns columns = readColumns(*scan.pointcloud);
  return {
      SensorKind::Lidar, true,
      std::string(scan.pointcloud->GetRuntimeClass()->className) + " of " +
          std::to_string(columns.size()) + " points" +
          (columns.time.empty() ? ", no time per point" : " with time per point")};
}

Appearance appearanceOf(const mrpt::obs::CObservationRotatingScan& scan)
{
  try
  {
    const RotatingScanPoints points = pointsOf(scan);
    return {
        SensorKind::Lidar, true,
        scan.lidarModel + ", " + std::to_string(scan.rowCount) + " rows, " +
            std::to_string(points.points.size()) + " points" +
            (points.has_point_times ? " with time per column" : ", no time per point")};
  }
  catch (const std::runtime_error& e)
  {
    return {SensorKind::Lidar, false, e.what()};
  }
}

Appearance appearanceOf(const CObservation& observation)
{
  if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation))
    return appearanceOf(*imu);
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservationVelodyneScan*>(&observation))
    return appearanceOf(*scan);
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation))
    return appearanceOf(*scan);
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservationRotatingScan*>(&observation))
    return appearanceOf(*scan);
  return {};
}

SensorSummary firstSight(const CObservation& observation)
{
  const Appearance appearance = appearanceOf(observation);
  SensorSummary sensor;
  sensor.label = observation.sensorLabel;
  sensor.class_name = observation.GetRuntimeClass()->className;
  sensor.detail = appearance.detail;
  sensor.kind = appearance.kind;
  sensor.usable = appearance.usable;
  mrpt::poses::CPose3D T_vehicle_sensor;
  observation.getSensorPose(T_vehicle_sensor);
  sensor.T_vehicle_sensor = toPose(T_vehicle_sensor);
  sensor.first_stamp_ns = toNanoseconds(observation.timestamp);
  return sensor;
}

// The time field of a scan, and how its points follow each other if it has none.
void noteTimes(SensorSummary& sensor, const CObservation& observation)
{
  const std::int64_t stamp_ns = toNanoseconds(observation.timestamp);
  const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation);
  if (cloud == nullptr)
  {
    const auto* scan = dynamic_cast<const mrpt::obs::CObservationVelodyneScan*>(&observation);
    const auto* rotating = dynamic_cast<const mrpt::obs::CObservationRotatingScan*>(&observation);
    sensor.times_by_sensor |= rotating != nullptr && hasColumnTimes(*rotating);
    sensor.times_by_sensor |=
        scan != nullptr && (!scan->scan_packets.empty() || !scan->point_cloud.timestamp.empty());
    const bool no_packets = scan != nullptr && scan->scan_packets.empty();
    if (!no_packets || scan->point_cloud.size() > 0) ++sensor.scans_with_points;
    sensor.point_times.push_back(sampleOf(stamp_ns, {}, false));
    return;
  }
  if (!cloud->pointcloud) return;
  CloudColumns columns = readColumns(*cloud->pointcloud);
  if (columns.size() > 0) ++sensor.scans_with_points;
  sensor.point_times.push_back(sampleOf(stamp_ns, columns.time, columns.single_precision_time));
  // The first cloud may be an empty one.
  if (sensor.sweep.coverage > 0.0) return;
  CloudTiming untimed;
  untimed.reading.reset();
  sensor.sweep = shapeOf(toTimedPoints(std::move(columns), stamp_ns, untimed).points);
}

std::optional<std::size_t> note(SensorSurvey& survey, const CObservation& observation)
{
  std::vector<SensorSummary>& sensors = survey.sensors;
  const std::string class_name = observation.GetRuntimeClass()->className;
  auto sensor = std::find_if(
      sensors.begin(), sensors.end(),
      [&](const SensorSummary& s)
      { return s.label == observation.sensorLabel && s.class_name == class_name; });
  if (sensor == sensors.end() && sensors.size() == kMostSensors)
  {
    ++survey.observations_beyond;
    return std::nullopt;
  }
  if (sensor == sensors.end()) sensor = sensors.insert(sensors.end(), firstSight(observation));
  // A sensor that starts with an empty or incomplete observation may do better later.
  if (!sensor->usable && sensor->kind != SensorKind::Other)
  {
    const Appearance now = appearanceOf(observation);
    if (now.usable) sensor->usable = true, sensor->detail = now.detail;
  }
  if (sensor->kind == SensorKind::Lidar) noteTimes(*sensor, observation);
  ++sensor->observations;
  sensor->last_stamp_ns = toNanoseconds(observation.timestamp);
  return static_cast<std::size_t>(sensor - sensors.begin());
}

bool hasBeenSeen(const SensorSummary& sensor)
{
  return sensor.kind != SensorKind::Lidar || sensor.scans_with_points >= kFewestScans ||
         sensor.observations >= kMostEmptyScans;
}

bool hasUsable(
    const std::vector<SensorSummary>& sensors, SensorKind kind, const LabelPattern& pattern)
{
  return std::any_of(
      sensors.begin(), sensors.end(),
      [&](const SensorSummary& s)
      { return s.kind == kind && s.usable && hasBeenSeen(s) && pattern.matches(s.label); });
}

/** Patterns that are tried after each observation. */
class CompiledPatterns
{
 public:
  explicit CompiledPatterns(const SensorPatterns& patterns)
      : imu_("imu", patterns.imu_label), lidars_{{"lidar", patterns.lidar_label}}
  {
    for (const std::string& label : patterns.further_lidar_labels)
      lidars_.emplace_back("lidar", label);
  }

  [[nodiscard]] bool satisfiedBy(const SensorSurvey& survey) const
  {
    return hasUsable(survey.sensors, SensorKind::Imu, imu_) &&
           std::all_of(
               lidars_.begin(), lidars_.end(),
               [&](const LabelPattern& lidar)
               { return hasUsable(survey.sensors, SensorKind::Lidar, lidar); });
  }

 private:
  LabelPattern imu_;
  std::vector<LabelPattern> lidars_;
};
}  // namespace

namespace fastlio
{
std::optional<std::size_t> noteObservation(SensorSurvey& survey, const CObservation& observation)
{
  if (observation.timestamp == INVALID_TIMESTAMP) return std::nullopt;
  return note(survey, observation);
}

bool isComplete(const SensorSurvey& survey, const SensorPatterns& patterns)
{
  return CompiledPatterns(patterns).satisfiedBy(survey);
}

SensorSurvey surveySensors(
    const std::vector<std::string>& files, const SensorPatterns& patterns, double at_least)
{
  const std::int64_t at_least_ns = toNanoseconds(at_least);
  RawlogSource source(files);
  SensorSurvey survey;
  std::int64_t begin_ns = 0;
  const CompiledPatterns compiled(patterns);  // patterns that are none are reported before reading
  while (const auto observation = source.next())
  {
    if (observation->timestamp == INVALID_TIMESTAMP) continue;
    const std::int64_t stamp_ns = toNanoseconds(observation->timestamp);
    if (survey.sensors.empty()) begin_ns = stamp_ns;
    noteObservation(survey, *observation);
    if (stamp_ns - begin_ns >= at_least_ns && compiled.satisfiedBy(survey)) break;
  }
  survey.problems = source.problems();
  return survey;
}

}  // namespace fastlio
