// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/survey/input_plan.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
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
  if (periods.empty()) return kUsualPeriod;
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  return *middle;
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

/** The revolution that tells the times, if the parameters and the data allow one. */
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

Pose imuPose(const SensorSelection& selection, const SensorOptions& parameters)
{
  return parameters.T_vehicle_imu.value_or(selection.imu.T_vehicle_sensor);
}

/** The parameters of those that are asked for, in the order of the selection's. */
std::vector<FurtherLidarOptions> furtherLidars(const Parameters& parameters)
{
  std::vector<FurtherLidarOptions> asked;
  for (const FurtherLidarOptions& lidar : parameters.further_lidars)
    if (!lidar.sensor_label.empty()) asked.push_back(lidar);
  return asked;
}

void requireUnambiguous(const SensorSummary& sensor, const LidarPlan& plan)
{
  if (plan.finding.verdict == PointTimeVerdict::Ambiguous)
    throw std::runtime_error("LiDAR '" + sensor.label + "': " + plan.finding.evidence + ".");
}

void add(InputPlan& plan, const SensorSummary& sensor, LidarPlan lidar)
{
  requireUnambiguous(sensor, lidar);
  (lidar.loud ? plan.warnings : plan.notes)
      .push_back("LiDAR '" + sensor.label + "': " + lidar.text + ".");
  plan.lidars.push_back(std::move(lidar));
}

/** LiDARs that could be used and are not. */
void noteUnused(InputPlan& plan, const SensorSelection& selection)
{
  for (const SensorSummary& sensor : selection.ignored)
    if (sensor.kind == SensorKind::Lidar && sensor.usable)
      plan.notes.push_back(
          "LiDAR '" + sensor.label +
          "' is not used; lidar_2.sensor_label (and lidar_3, lidar_4) lets its points join.");
}
}  // namespace

SensorPatterns patternsOf(const Parameters& parameters)
{
  SensorPatterns patterns{
      parameters.input.lidar_sensor_label, parameters.input.imu_sensor_label, {}};
  for (const FurtherLidarOptions& lidar : furtherLidars(parameters))
    patterns.further_lidar_labels.push_back(lidar.sensor_label);
  return patterns;
}

LidarPlan planLidar(const SensorSummary& sensor, const SensorOptions& parameters)
{
  LidarPlan plan;
  if (sensor.times_by_sensor)
  {
    plan.text = "the sensor's own data tell the time of each point";
    return plan;
  }
  plan.finding = findPointTimes(
      sensor.point_times, {parameters.point_time_unit, parameters.point_time_reference});
  plan.text = plan.finding.evidence;
  switch (plan.finding.verdict)
  {
    case PointTimeVerdict::Found:
      plan.timing.reading = plan.finding.reading;
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

InputPlan planInput(const SensorSelection& selection, const Parameters& parameters)
{
  InputPlan plan;
  const SensorOptions& input = parameters.input;
  plan.bridge.T_vehicle_imu = input.T_vehicle_imu;
  const Pose T_imu_vehicle = imuPose(selection, input).inverse();
  if (input.T_vehicle_lidar) plan.bridge.T_imu_lidar = T_imu_vehicle * *input.T_vehicle_lidar;
  add(plan, selection.lidar, planLidar(selection.lidar, input));
  plan.bridge.timing = plan.lidars.front().timing;

  plan.bridge.further_min_range = parameters.lidar.min_range;
  const auto further = furtherLidars(parameters);
  for (std::size_t i = 0; i < std::min(further.size(), selection.further_lidars.size()); ++i)
  {
    add(plan, selection.further_lidars[i], planLidar(selection.further_lidars[i], input));
    FurtherLidarConversion options;
    options.timing = plan.lidars.back().timing;
    // The offset of the first LiDAR is added to all points later on.
    options.stamp_shift_ns =
        std::llround(toNanoseconds(further[i].time_offset - parameters.lidar.time_offset));
    if (further[i].T_vehicle_lidar)
      options.T_imu_lidar = T_imu_vehicle * *further[i].T_vehicle_lidar;
    plan.bridge.further_lidars.push_back(options);
  }
  noteUnused(plan, selection);
  return plan;
}

}  // namespace fastlio
