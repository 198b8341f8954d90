// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "anderson.h"
#include "one_rig.h"
#include "rotation_by_motion.h"
#include "unknowns.h"
#include <fastlio/calibration/calibrator.h>
#include <fastlio/survey/sensor_selection.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace fastlio
{
namespace
{
constexpr std::size_t kRememberedSteps = 8;
// The last part of a single recording is not fitted to, but tried on.
constexpr double kFittedPart = 0.6;
// Who does not know how the LiDAR is turned has not measured where it is [m].
constexpr double kUnmeasuredPosition = 0.1;

Rig rigIn(const CalibrationRecording& recording, const Config& config)
{
  const SensorSelection selection = sensorsIn(recording.files, config.sensors);
  return rigOf(config, selection, planInput(selection, config.sensors, config.odometry.lidar));
}

/** The covariance with what no data determine; nothing gets more uncertain than it was before. */
CalibrationErrorMatrix widened(
    const CalibrationErrorMatrix& formal, const CalibrationErrorVector& prior_std,
    const Mat3& R_imu_lidar, double stretch_std)
{
  const Vec3 axis = R_imu_lidar.col(2);
  const Mat3 stretch = stretch_std * (Mat3::Identity() - axis * axis.transpose());
  CalibrationErrorVector direction = CalibrationErrorVector::Zero();
  direction.segment<9>(kGyroMatrixError) =
      Eigen::Map<const Eigen::Matrix<double, 9, 1>>(stretch.data());
  const CalibrationErrorMatrix covariance = formal + direction * direction.transpose();
  const CalibrationErrorVector std = covariance.diagonal().cwiseSqrt();
  const CalibrationErrorVector shrink =
      (prior_std.array() / std.array().max(1e-300)).min(1.0).matrix();
  return shrink.asDiagonal() * covariance * shrink.asDiagonal();
}

/** How well a calibration is known, in the four numbers that the options have for it. */
void setStandardDeviations(
    const CalibrationErrorMatrix& covariance, CalibrationOptions& calibration)
{
  const CalibrationErrorVector variances = covariance.diagonal();
  double scales = 0.0, misalignments = 0.0;  // sums of variances
  for (const int first : {kGyroMatrixError, kAccelMatrixError})
  {
    const Mat3 matrix = Eigen::Map<const Eigen::Matrix3d>(variances.data() + first);
    scales += matrix.trace();
    misalignments += matrix.sum() - matrix.trace();
  }
  calibration.imu_scale_std = std::sqrt(scales / 6.0);
  calibration.imu_misalignment_std = std::sqrt(misalignments / 12.0);
  calibration.extrinsic_rotation_std = std::sqrt(variances.segment<3>(kExtrinsicError).mean());
  calibration.extrinsic_translation_std =
      std::sqrt(variances.segment<3>(kExtrinsicError + 3).mean());
}

double stdOf(const Eigen::MatrixXd& covariance, Eigen::Index element)
{
  return std::sqrt(std::max(0.0, covariance(element, element)));
}
}  // namespace

bool CalibrationTrial::better() const
{
  // The thickness depends on which points find a plane: it is a guard against nonsense.
  constexpr double kLessInnovation = 0.95, kThickness = 1.05;
  return after.innovation() < kLessInnovation * before.innovation() &&
         after.mapThickness() < kThickness * before.mapThickness();
}

bool CalibrationTrial::explained() const
{
  constexpr double kTwice = 4.0;  // as squares
  return after.innovation() < kTwice;
}

Calibrator::Calibrator(
    std::vector<CalibrationRecording> recordings, Config config, int passes,
    CalibrationProgress progress)
    : recordings_(std::move(recordings)),
      config_(std::move(config)),
      passes_(passes),
      progress_(std::move(progress)),
      given_(rigIn(recordings_.at(0), config_)),
      given_noise_(config_.odometry.imu.noise)
{
  requireOneRig(recordings_, config_);
  if (const auto shown = contradictingRotation(recordings_, config_))
  {
    given_.T_imu_lidar.R = shown->R_imu_lidar;
    rotation_contradiction_ = shown->angle;
    double& position_std = config_.odometry.calibration.extrinsic_translation_std;
    position_std = std::max(position_std, kUnmeasuredPosition);
  }
  for (const CalibrationRecording& recording : recordings_)
  {
    const InertialNoise noise = measureInertialNoise(inertialSamples(recording, config_));
    if (noise.rest_seconds > noise_.rest_seconds) noise_ = noise;
  }
  // From the first pass on, and in the trial before and after: else the innovations would show the
  // noise densities, not the rig.
  config_.odometry.imu.noise = noise_.appliedTo(given_noise_);
  // The evidence about the extrinsic is collected beside the filter, which takes it for true.
  config_.odometry.calibration.estimate_extrinsic = false;
  // A pass shows what the offsets that it begins with leave.
  config_.odometry.calibration.estimate_beams = false;
  // One offset is sought. The readings of clocks that drift contradict each other.
  config_.odometry.calibration.time_offset_walk = 0.0;
}

Config Calibrator::configWith(const Rig& rig) const
{
  Config config = config_;
  apply(rig, config);
  return config;
}

Config Calibrator::configWith(const RigEstimate& estimate) const
{
  Config config = configWith(estimate.rig);
  setStandardDeviations(estimate.covariance, config.odometry.calibration);
  return config;
}

void Calibrator::report(const std::string& what) const
{
  if (progress_) progress_(what);
}

RigEstimate Calibrator::calibrate() const
{
  return calibrate(recordings_, {}, {});
}

RigEstimate Calibrator::calibrate(
    const std::vector<CalibrationRecording>& recordings, const ScanRange& range,
    const std::string& what) const
{
  const auto runAll = [&](const Rig& rig, int number)
  {
    PassFindings pass;
    for (const CalibrationRecording& recording : recordings)
    {
      report(
          what + "pass " + std::to_string(number) + " of " + std::to_string(passes_) + ", " +
          recording.name);
      pass.add(calibrationRun(recording, configWith(rig), range));
    }
    if (pass.tracked == 0)
      throw std::runtime_error(
          "no scan was tracked in " + recordings.front().name +
          ": fastlio-replay reports the reason");
    return pass;
  };
  PassFindings pass = runAll(given_, 1);
  const CalibrationUnknowns unknowns(config_.odometry.calibration, pass);
  AndersonIteration iteration(kRememberedSteps);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns.size());
  CalibrationStep step = unknowns.step(pass, x);
  x = iteration.next(x, step.step, step.covariance);
  for (int number = 2; number <= passes_; ++number)
  {
    pass = runAll(unknowns.rigAt(given_, x), number);
    step = unknowns.step(pass, x);
    x = iteration.next(x, step.step, step.covariance);
  }
  step.covariance = iteration.covariance(step.covariance);
  const CommonElevation common = unknowns.commonElevation(pass, step, given_.T_imu_lidar.R.col(2));
  const Eigen::VectorXd hidden = shareOut(common, unknowns.prior(x).std, x, step.covariance);
  RigEstimate estimate = estimateAt(unknowns, x, step);
  estimate.hidden_by_elevations = hidden.segment<3>(kExtrinsicError + 3).cwiseAbs();
  estimate.incidence = unknowns.incidenceBias(pass, step);
  const ClockContradiction clocks = clockContradiction(pass.clocks);
  estimate.clocks = clocks.advice;
  estimate.time_offset_std = std::hypot(estimate.time_offset_std, 0.5 * clocks.difference);
  estimate.problems = pass.problems;
  return estimate;
}

RigEstimate Calibrator::estimateAt(
    const CalibrationUnknowns& unknowns, const Eigen::VectorXd& x,
    const CalibrationStep& step) const
{
  RigEstimate estimate;
  estimate.rig = unknowns.rigAt(given_, x);
  estimate.correction = x.head<kCalibrationErrorDim>();
  estimate.prior_std = unknowns.prior(x).std;
  estimate.covariance = widened(
      step.covariance.topLeftCorner<kCalibrationErrorDim, kCalibrationErrorDim>(),
      estimate.prior_std, given_.T_imu_lidar.R, unknowns.stretchStd(step));
  estimate.time_offset_std = stdOf(step.covariance, kTimeOffsetIndex);
  for (std::size_t i = 0; i < unknowns.elevations().size(); ++i)
    estimate.beam_stds.push_back(
        {stdOf(step.covariance, unknowns.beamIndex(i)),
         stdOf(step.covariance, unknowns.beamIndex(i) + 1)});
  estimate.innovation_scale = step.innovation_scale;
  estimate.rotation_contradiction = rotation_contradiction_;
  estimate.passes = passes_;
  estimate.given_noise = given_noise_;
  estimate.noise = noise_;
  return estimate;
}

CalibrationTrial Calibrator::tryOut() const
{
  if (recordings_.size() == 1) return tryLastPart();
  CalibrationTrial trial;
  for (std::size_t left_out = 0; left_out < recordings_.size(); ++left_out)
  {
    auto others = recordings_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
    const RigEstimate estimate =
        calibrate(others, {}, "trial without " + recordings_[left_out].name + ": ");
    const auto before = calibrationRun(recordings_[left_out], configWith(given_));
    trial.before += before.agreement;
    trial.after += calibrationRun(recordings_[left_out], configWith(estimate.rig)).agreement;
    trial.seconds += before.seconds;
  }
  return trial;
}

CalibrationTrial Calibrator::tryLastPart() const
{
  const CalibrationRecording& recording = recordings_.front();
  const CalibrationRunResult whole = calibrationRun(recording, configWith(given_));
  const auto split = static_cast<std::size_t>(kFittedPart * static_cast<double>(whole.scans));
  const RigEstimate estimate = calibrate(recordings_, {split, 0}, "trial on the last part: ");
  const ScanRange last{std::numeric_limits<std::size_t>::max(), split};
  CalibrationTrial trial;
  trial.before = calibrationRun(recording, configWith(given_), last).agreement;
  trial.after = calibrationRun(recording, configWith(estimate.rig), last).agreement;
  trial.seconds = (1.0 - kFittedPart) * whole.seconds;
  return trial;
}

}  // namespace fastlio
