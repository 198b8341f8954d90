// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/survey/input_plan.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fastlio
{
namespace
{
constexpr const char* kNoPose = "none is given";  // where a pose comes from
constexpr double kUsualPeriod = 0.1;  // of a revolution, when there is one scan only [s]

/** Median time between the stamps of its scans [s]. */
double scanPeriod(const SensorSummary& sensor)
{
  std::vector<double> periods;
  for (std::size_t i = 1; i < sensor.point_times.size(); ++i)
  {
    const std::int64_t period_ns =
        sensor.point_times[i].stamp_ns - sensor.point_times[i - 1].stamp_ns;
    if (period_ns > 0) periods.push_back(toSeconds(period_ns));
  }
  return periods.empty() ? kUsualPeriod : median(std::move(periods));
}

std::string referenceText(PointTimeReference reference)
{
  switch (reference)
  {
    case PointTimeReference::Middle:
      return "the middle";
    case PointTimeReference::End:
      return "the end";
    default:
      return "the start";
  }
}

/** The revolution that gives the times, if the parameters and the data allow one. */
std::optional<SweepTiming> sweepOf(const SensorSummary& sensor, const SensorOptions& parameters)
{
  SweepTiming sweep;
  sweep.period = scanPeriod(sensor);
  sweep.reference = parameters.point_time_reference;
  sweep.start_azimuth = parameters.sweep_start;
  switch (parameters.missing_point_times)
  {
    case MissingPointTimes::None:
      return std::nullopt;
    case MissingPointTimes::Clockwise:
      sweep.sense = -1;
      return sweep;
    case MissingPointTimes::CounterClockwise:
      sweep.sense = 1;
      return sweep;
    case MissingPointTimes::Auto:
      break;
  }
  if (!sensor.sweep.spinning) return std::nullopt;
  sweep.sense = sensor.sweep.sense;
  sweep.start_azimuth.reset();
  return sweep;
}

std::string sweepText(
    const SensorSummary& sensor, const SweepTiming& sweep, MissingPointTimes parameter)
{
  const std::string stamps = "; a revolution takes " + std::to_string(sweep.period) +
                             " s and its stamp is taken as " + referenceText(sweep.reference) +
                             " (input.point_time_reference)";
  if (parameter != MissingPointTimes::Auto)
    return ": times are made from the azimuth, as configured with input.missing_point_times" +
           stamps;
  return ": times are made from the azimuth, because the order of the points shows a revolution (" +
         describe(sensor.sweep) + ")" + stamps +
         ". If the clouds are motion compensated already, set input.missing_point_times: none";
}

/** For clouds whose own times are not there or not to be read. */
void planWithoutTimes(LidarPlan& plan, const SensorSummary& sensor, const SensorOptions& parameters)
{
  plan.loud = true;
  plan.timing.reading.reset();
  plan.timing.sweep = sweepOf(sensor, parameters);
  plan.compensated = plan.timing.sweep.has_value();
  plan.text = plan.finding.evidence;
  if (plan.timing.sweep)
    plan.text += sweepText(sensor, *plan.timing.sweep, parameters.missing_point_times);
  else if (parameters.missing_point_times == MissingPointTimes::None)
    plan.text += ": no motion compensation, as configured with input.missing_point_times";
  else
    plan.text +=
        ": NO motion compensation, because the order of the points does not show a revolution; if "
        "the LiDAR spins, set input.missing_point_times to clockwise or counterclockwise";
}

/** The options of those that are asked for, in the order of the selection's. */
std::vector<FurtherLidarOptions> furtherLidars(const SensorOptions& sensors)
{
  std::vector<FurtherLidarOptions> asked;
  for (const FurtherLidarOptions& lidar : sensors.further_lidars)
    if (!lidar.sensor_label.empty()) asked.push_back(lidar);
  return asked;
}

void requireUnambiguous(const SensorSummary& sensor, const LidarPlan& plan)
{
  if (plan.finding.verdict == PointTimeVerdict::Ambiguous)
    throw std::runtime_error(
        "LiDAR '" + printable(sensor.label) + "': " + plan.finding.evidence + ".");
}

void add(InputPlan& plan, const SensorSummary& sensor, LidarPlan lidar)
{
  requireUnambiguous(sensor, lidar);
  (lidar.loud ? plan.warnings : plan.notes)
      .push_back("LiDAR '" + printable(sensor.label) + "': " + lidar.text + ".");
  plan.lidars.push_back(std::move(lidar));
}

/** Where the sensors are, and who says so. */
std::vector<SensorPlace> placesOf(
    const SensorSelection& selection, const SensorOptions& used, bool by_factory)
{
  std::vector<SensorPlace> places;
  const auto add = [&](const SensorSummary& sensor, const std::optional<Pose>& configured)
  {
    const std::string origin = by_factory                 ? "input.factory_T_imu_lidar"
                               : configured               ? "the configuration"
                               : hasKnownMounting(sensor) ? "the recording"
                                                          : kNoPose;
    places.push_back(
        {sensor.kind, sensor.label, configured.value_or(sensor.T_vehicle_sensor), origin});
  };
  add(selection.lidar, used.T_vehicle_lidar);
  const auto further = furtherLidars(used);
  for (std::size_t i = 0; i < std::min(further.size(), selection.further_lidars.size()); ++i)
    add(selection.further_lidars[i], further[i].T_vehicle_lidar);
  add(selection.imu, used.T_vehicle_imu);
  return places;
}

/** Logs the poses in use and where they come from. */
void notePoses(
    InputPlan& plan, const SensorSelection& selection, const SensorOptions& given,
    const SensorOptions& used)
{
  const bool by_factory = used.T_vehicle_imu.has_value() && !given.T_vehicle_imu.has_value();
  plan.places = placesOf(selection, used, by_factory);
  std::string list;
  for (const SensorPlace& place : plan.places)
    list += std::string(list.empty() ? "" : ", ") +
            (place.kind == SensorKind::Imu ? "IMU " : "LiDAR ") +
            poseText(place.T_vehicle_sensor, 6) + " (" +
            (place.origin == kNoPose ? "the recording gives none: identity" : place.origin) + ")";
  plan.notes.push_back(
      "Poses in the vehicle frame [x, y, z, yaw, pitch, roll] in m and deg: " + list + ".");
  const auto has_no_pose = [](const SensorPlace& place) { return place.origin == kNoPose; };
  if (std::all_of(plan.places.begin(), plan.places.end(), has_no_pose))
    plan.warnings.emplace_back(
        "The recording has no sensor poses: LiDAR and IMU count as one place with the same axes. "
        "Measure the pose of the LiDAR in the IMU frame and give it: --set "
        "'input.T_vehicle_lidar=[x,y,z,yaw,pitch,roll]' (m, deg).");
  if (given.factory_T_imu_lidar && !by_factory)
    plan.notes.emplace_back(
        "input.factory_T_imu_lidar is not used: the recording or the configuration gives the poses "
        "of LiDAR and IMU.");
}

/** LiDARs that could be used and are not. A single cloud is none: it may be the map of a run. */
void noteUnused(InputPlan& plan, const SensorSelection& selection)
{
  for (const SensorSummary& sensor : selection.ignored)
    if (sensor.kind == SensorKind::Lidar && sensor.usable && sensor.observations > 1)
      plan.notes.push_back(
          "LiDAR '" + printable(sensor.label) +
          "' is not used; lidar_2.sensor_label (and lidar_3, lidar_4) lets its points join.");
}
}  // namespace

SensorPatterns patternsOf(const SensorOptions& sensors)
{
  SensorPatterns patterns{sensors.lidar_sensor_label, sensors.imu_sensor_label, {}};
  for (const FurtherLidarOptions& lidar : furtherLidars(sensors))
    patterns.further_lidar_labels.push_back(lidar.sensor_label);
  return patterns;
}

SensorSelection sensorsIn(const std::vector<std::string>& files, const SensorOptions& sensors)
{
  const SensorPatterns patterns = patternsOf(sensors);
  return selectSensors(surveySensors(files, patterns), patterns);
}

bool hasKnownMounting(const SensorSummary& sensor)
{
  const Pose& T = sensor.T_vehicle_sensor;
  return !(T.R.isIdentity(0.0) && T.p.isZero(0.0));
}

/** Says so, where the times by themselves contradict a configured unit. */
void noteContradictedUnit(const SensorSummary& sensor, LidarPlan& plan)
{
  const PointTimeFinding alone =
      findPointTimes(sensor.point_times, {PointTimeUnit::Auto, plan.finding.reading.reference});
  if (alone.verdict != PointTimeVerdict::Found || alone.reading.unit == plan.finding.reading.unit)
    return;
  plan.loud = true;
  plan.text += ". input.point_time_unit says so; without it, " + alone.evidence +
               "; check the configured unit";
}

LidarPlan planLidar(const SensorSummary& sensor, const SensorOptions& parameters)
{
  LidarPlan plan;
  if (sensor.times_by_sensor)
  {
    plan.text = "the sensor's own data give the time of each point";
    return plan;
  }
  plan.finding = findPointTimes(
      sensor.point_times, {parameters.point_time_unit, parameters.point_time_reference});
  plan.text = plan.finding.evidence;
  switch (plan.finding.verdict)
  {
    case PointTimeVerdict::Found:
      plan.timing.reading = plan.finding.reading;
      noteContradictedUnit(sensor, plan);
      break;
    case PointTimeVerdict::Instantaneous:
      if (parameters.missing_point_times == MissingPointTimes::Clockwise ||
          parameters.missing_point_times == MissingPointTimes::CounterClockwise)
      {
        planWithoutTimes(plan, sensor, parameters);
        break;
      }
      plan.timing.reading.reset();
      plan.compensated = false;
      plan.loud = true;
      break;
    case PointTimeVerdict::Ambiguous:
    case PointTimeVerdict::Absent:
    case PointTimeVerdict::Unusable:
      planWithoutTimes(plan, sensor, parameters);
      break;
  }
  return plan;
}

SensorOptions withFactoryMounting(const SensorSelection& selection, SensorOptions sensors)
{
  const bool given = sensors.T_vehicle_imu || sensors.T_vehicle_lidar ||
                     hasKnownMounting(selection.imu) || hasKnownMounting(selection.lidar);
  if (given || !sensors.factory_T_imu_lidar) return sensors;
  sensors.T_vehicle_lidar = Pose{};
  sensors.T_vehicle_imu = sensors.factory_T_imu_lidar->inverse();
  return sensors;
}

InputPlan planInput(
    const SensorSelection& selection, const SensorOptions& sensors, const LidarOptions& lidar)
{
  InputPlan plan;
  const SensorOptions input = withFactoryMounting(selection, sensors);
  plan.bridge.T_vehicle_imu = input.T_vehicle_imu;
  plan.T_vehicle_imu = input.T_vehicle_imu.value_or(selection.imu.T_vehicle_sensor);
  plan.bridge.further_min_range = lidar.min_range;
  const auto take =
      [&](const SensorSummary& sensor, const std::optional<Pose>& T_vehicle_lidar, double shift)
  {
    add(plan, sensor, planLidar(sensor, input));
    LidarConversion conversion;
    conversion.timing = plan.lidars.back().timing;
    conversion.stamp_shift_ns = toNanoseconds(shift);
    if (T_vehicle_lidar) conversion.T_imu_lidar = plan.T_vehicle_imu.inverse() * *T_vehicle_lidar;
    plan.bridge.lidars.push_back(conversion);
  };
  take(selection.lidar, input.T_vehicle_lidar, 0.0);
  const auto further = furtherLidars(sensors);
  // The offset of the first LiDAR is added to all points later on.
  for (std::size_t i = 0; i < std::min(further.size(), selection.further_lidars.size()); ++i)
    take(
        selection.further_lidars[i], further[i].T_vehicle_lidar,
        further[i].time_offset - lidar.time_offset);
  notePoses(plan, selection, sensors, input);
  noteUnused(plan, selection);
  return plan;
}

}  // namespace fastlio
