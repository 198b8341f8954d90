// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_rig.h"
#include <fastlio/calibration/calibration_run.h>
#include <fastlio/imu/imu_conditioner.h>
#include <fastlio/math/time.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/rawlog/decode_ahead_source.h>
#include <fastlio/survey/input_plan.h>
#include <fastlio/survey/sensor_selection.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace fastlio
{
namespace
{
/** Follows the results of a run. */
class RunFollower
{
 public:
  RunFollower(Odometry& odometry, const ScanRange& range)
      : odometry_(odometry), measured_from_(range.measured_from)
  {
  }

  void take(const ScanResult& scan)
  {
    if (scan.status == ScanStatus::Tracking) takeTracked(scan);
    ++result_.scans;
  }

  [[nodiscard]] CalibrationRunResult finish()
  {
    result_.findings = odometry_.calibrationFindings();
    const CalibrationSums& sums = result_.findings.sums;
    result_.agreement.innovation_squares = sums.squares - before_.squares;
    result_.agreement.innovations = sums.count - before_.count;
    return result_;
  }

 private:
  void takeTracked(const ScanResult& scan)
  {
    if (!first_ns_) first_ns_ = scan.stamp_ns;
    ++result_.tracked;
    result_.seconds = toSeconds(scan.stamp_ns - *first_ns_);
    result_.takeTimeOffset(
        scan.filter.x.time_offset,
        std::sqrt(std::max(0.0, scan.filter.P(kTimeOffset, kTimeOffset))));
    if (result_.scans < measured_from_)
    {
      before_ = odometry_.calibrationFindings().sums;
      return;
    }
    const auto points = static_cast<double>(scan.statistics.points_effective);
    result_.agreement.points += points;
    result_.agreement.residual_squares += points * std::pow(scan.statistics.residual_rms, 2);
  }

  Odometry& odometry_;
  std::size_t measured_from_;
  std::optional<std::int64_t> first_ns_;
  CalibrationSums before_;
  CalibrationRunResult result_;
};

DecodeAheadSource openedSource(const CalibrationRecording& recording, const Config& config)
{
  SensorSelection selection = sensorsIn(recording.files, config.sensors);
  const InputPlan plan = planInput(selection, config.sensors, config.odometry.lidar);
  return {RawlogSource(recording.files), ObservationBridge(std::move(selection), plan.bridge)};
}
}  // namespace

RunAgreement& RunAgreement::operator+=(const RunAgreement& other)
{
  innovation_squares += other.innovation_squares;
  innovations += other.innovations;
  residual_squares += other.residual_squares;
  points += other.points;
  return *this;
}

double RunAgreement::innovation() const
{
  return innovations > 0.0 ? innovation_squares / innovations : 0.0;
}

double RunAgreement::mapThickness() const
{
  return points > 0.0 ? std::sqrt(residual_squares / points) : 0.0;
}

void CalibrationRunResult::takeTimeOffset(double offset, double std)
{
  constexpr double kAboutAsWell = 2.0;
  if (std > 0.0) clocks.readings.push_back({offset, std});
  if (std == 0.0 || (time_offset_std > 0.0 && std > kAboutAsWell * time_offset_std)) return;
  time_offset = offset;
  time_offset_std = std;
}

CalibrationRunResult calibrationRun(
    const CalibrationRecording& recording, const Config& config, const ScanRange& range)
{
  DecodeAheadSource source = openedSource(recording, config);
  Odometry odometry(config.odometry);
  RunFollower follower(odometry, range);
  std::size_t scans = 0;
  while (scans < range.end)
  {
    auto input = source.next();
    if (!input) break;
    if (auto* sample = std::get_if<ImuSample>(&input->data))
      odometry.addImu(*sample);
    else
    {
      odometry.addScan(std::move(std::get<LidarScan>(input->data)));
      ++scans;
    }
    while (const auto result = odometry.next())
      follower.take(*result);
  }
  source.stop();
  while (const auto result = odometry.flush())
    follower.take(*result);
  CalibrationRunResult result = follower.finish();
  result.clocks.recording = recording.name;
  for (const ReadProblem& problem : source.problems())
    result.problems.push_back(recording.name + ": " + problem.message);
  return result;
}

std::vector<ImuSample> inertialSamples(const CalibrationRecording& recording, const Config& config)
{
  DecodeAheadSource source = openedSource(recording, config);
  ImuConditioner conditioner(config.odometry.imu, config.odometry.initialization.gravity);
  std::vector<ImuSample> samples;
  const auto take = [&samples](const std::vector<ConditionedSample>& ready)
  {
    for (const ConditionedSample& next : ready)
    {
      if (next.rescale_gyro != 1.0)
        for (ImuSample& earlier : samples)
          earlier.gyro *= next.rescale_gyro;
      samples.push_back(next.sample);
    }
  };
  while (const auto input = source.next())
  {
    const auto* raw = std::get_if<ImuSample>(&input->data);
    if (raw != nullptr && raw->gyro.allFinite() && raw->accel.allFinite())
      take(conditioner.add(*raw));
  }
  source.stop();
  take(conditioner.finish());
  return samples;
}

}  // namespace fastlio
