// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "survey_diagnostics.h"
#include "survey_pass.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>
#include <fastlio/survey/recording_survey.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr double kMatchedScans = 100;  // for the check of motion

std::size_t indexOf(const RecordingSurvey& survey, const SensorSummary& summary)
{
  const auto same = [&](const SurveyedSensor& sensor)
  {
    return sensor.summary.label == summary.label && sensor.summary.class_name == summary.class_name;
  };
  const auto found = std::find_if(survey.sensors.begin(), survey.sensors.end(), same);
  return static_cast<std::size_t>(found - survey.sensors.begin());
}

ClockOverlap overlapOf(
    const StampReport& lidar, const StampReport& imu, const std::vector<double>& leads)
{
  ClockOverlap overlap;
  const std::int64_t begin_ns = std::max(lidar.first_ns, imu.first_ns);
  const std::int64_t end_ns = std::min(lidar.last_ns, imu.last_ns);
  overlap.seconds = toSeconds(end_ns - begin_ns);
  const auto length = toSeconds(lidar.last_ns - lidar.first_ns);
  overlap.fraction = length > 0 ? std::clamp(overlap.seconds / length, 0.0, 1.0) : 0.0;
  overlap.lead = median(leads);
  return overlap;
}

/** How well a rate shows in the match of two scans: better the faster, up to where they hardly
 * overlap any more.
 * \param rate [rad/s] */
double usefulness(double rate)
{
  constexpr double kFast = 1.5, kTooFast = 3.0;
  if (rate <= kFast) return rate * rate;
  return rate <= kTooFast ? kFast * kFast : -kFast * kFast;
}

/** The stretch of a given length in which the motion shows best. */
ScanSpan liveliest(const std::vector<ImuSample>& samples, double gyro_max, double seconds)
{
  // Rates that no platform has are in deg/s.
  constexpr double kLargestRate = 40.0;
  const double scale = gyro_max > kLargestRate ? kRadPerDeg : 1.0;
  const auto length_ns = toNanoseconds(seconds);
  const auto useful = [&](const ImuSample& s) { return usefulness(scale * s.gyro.norm()); };
  ScanSpan best{0, -1};
  double best_sum = 0.0, sum = 0.0;
  for (std::size_t first = 0, i = 0; i < samples.size(); ++i)
  {
    sum += useful(samples[i]);
    for (; samples[i].stamp_ns - samples[first].stamp_ns > length_ns; ++first)
      sum -= useful(samples[first]);
    if (sum <= best_sum) continue;
    best_sum = sum;
    best = {samples[first].stamp_ns, samples[i].stamp_ns};
  }
  return best;
}

/** Sensors, their rhythm, and which of them are used. */
std::optional<SensorSelection> chooseSensors(
    RecordingSurvey& survey, const FirstPass& pass, const SensorOptions& sensors)
{
  for (std::size_t i = 0; i < pass.survey.sensors.size(); ++i)
    survey.sensors.push_back({pass.survey.sensors[i], reportOn(pass.stamps[i])});
  survey.problems = pass.survey.problems;
  try
  {
    return selectSensors(pass.survey, patternsOf(sensors));
  }
  catch (const std::runtime_error& e)
  {
    survey.unusable = e.what();
    return std::nullopt;
  }
}

void planLidars(
    RecordingSurvey& survey, const SensorSelection& selection, const SensorOptions& parameters)
{
  std::vector<SensorSummary> lidars{selection.lidar};
  lidars.insert(lidars.end(), selection.further_lidars.begin(), selection.further_lidars.end());
  for (const SensorSummary& lidar : lidars)
    survey.lidars.push_back(
        {indexOf(survey, lidar), planLidar(lidar, parameters), LidarLook{}, PresetMatch{}});
}

/** How replay would read the sensors; the message of an ambiguity if it would not. */
BridgeOptions planBridge(
    RecordingSurvey& survey, const SensorSelection& selection, const SensorOptions& sensors,
    const LidarOptions& lidar)
{
  try
  {
    InputPlan plan = planInput(selection, sensors, lidar);
    survey.notes = std::move(plan.notes);
    survey.warnings = std::move(plan.warnings);
    return std::move(plan.bridge);
  }
  catch (const std::runtime_error& e)
  {
    survey.unusable = e.what();
    return {};
  }
}

void recogniseModels(RecordingSurvey& survey, SecondPass& pass)
{
  for (std::size_t i = 0; i < survey.lidars.size(); ++i)
  {
    SurveyedLidar& lidar = survey.lidars[i];
    lidar.look = std::move(pass.looks[i]);
    const SensorSummary& summary = survey.sensors[lidar.index].summary;
    lidar.preset = fittingPreset(
        {summary.label + " " + summary.detail, lidar.look.lines(), lidar.look.lowest(),
         lidar.look.highest(), lidar.look.coverage()});
  }
}

/** Progress of one half of the work. */
SurveyProgress half(const SurveyOptions& options, double begin)
{
  if (!options.progress) return {};
  return [&options, begin](double fraction) { options.progress(begin + 0.5 * fraction); };
}
}  // namespace

RecordingSurvey surveyRecording(
    const std::vector<std::string>& files, const SensorOptions& sensors,
    const OdometryOptions& odometry, const SurveyOptions& options)
{
  RecordingSurvey survey;
  survey.files = files;
  const FirstPass first = readFirst(files, half(options, 0.0));
  const auto selection = chooseSensors(survey, first, sensors);
  if (!selection) return survey;
  planLidars(survey, *selection, sensors);
  const BridgeOptions bridge = planBridge(survey, *selection, sensors, odometry.lidar);

  const std::size_t imu = indexOf(survey, selection->imu), lidar = survey.lidars.front().index;
  survey.imu_index = imu;
  const std::vector<ImuSample>& samples = first.samples[imu];
  survey.imu = surveyImu(samples, survey.sensors[imu].stamps.rate());
  survey.overlap =
      overlapOf(survey.sensors[lidar].stamps, survey.sensors[imu].stamps, first.leads[lidar]);

  const double seconds = kMatchedScans * survey.sensors[lidar].stamps.period;
  ScanSpan lively{0, -1};
  if (options.check_motion) lively = liveliest(samples, survey.imu.gyro_max, seconds);
  SecondPass second =
      readSecond(files, ObservationBridge(*selection, bridge), lively, half(options, 0.5));
  recogniseModels(survey, second);
  if (options.check_motion)
  {
    survey.motion = checkMotion(second.turns, samples);
    survey.rotation_error =
        logSO3(second.T_imu_lidar.R.transpose() * survey.motion->R_imu_lidar).norm();
  }
  addRemarks(survey, withFactoryMounting(*selection, sensors), odometry);
  return survey;
}

}  // namespace fastlio
