// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What an update does to the state, and how uncertain the state is when it is reported.

#include "estimator.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>

namespace fastlio
{
namespace
{
void describeMatch(const MatchResult& match, ScanStatistics& statistics)
{
  const InformationSums& sums = match.update.last;
  statistics.points_mapped = match.mapped;
  statistics.points_effective = sums.count;
  statistics.iterations = match.update.iterations;
  statistics.converged = match.update.converged;
  statistics.constraints = match.constraints;
  if (sums.count == 0) return;
  const auto n = static_cast<double>(sums.count);
  statistics.residual_rms = std::sqrt(sums.squares / n);
  // What the points say, however much the filter believes a scan that may be distorted.
  const double weight = match.model.weight;
  statistics.normalized_innovation = sums.weighted_squares / weight / n;
  statistics.information_eigenvalues = symmetricEigenvalues(sums.HtRinvH) / weight;
}

LinearizedUpdate linearized(
    const CompensatedWith& compensation, const MatchResult& match, const NavState& posterior)
{
  LinearizedUpdate update;
  update.T_world_scan = scanPose(posterior, compensation);
  update.by_state = scanPoseJacobian(posterior, compensation);
  update.constraints = match.constraints;
  update.gain = match.update.gain;
  update.covariance = match.update.posterior.P;
  return update;
}

/** The error of the map comes without what the filter has counted of it as noise. Where scans
 * contradict the filter, that may be more than the filter holds: then nothing is taken off. */
StateMatrix withoutNegativePart(StateMatrix systematic, const StateMatrix& P)
{
  using Navigation = Eigen::Matrix<double, kNavigationDim, kNavigationDim>;
  auto block = systematic.topLeftCorner<kNavigationDim, kNavigationDim>();
  const Navigation sum = block + P.topLeftCorner<kNavigationDim, kNavigationDim>();
  if (Eigen::LDLT<Navigation>(sum).isPositive()) return systematic;
  const Eigen::SelfAdjointEigenSolver<Navigation> solver(Navigation{block});
  block = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() *
          solver.eigenvectors().transpose();
  return systematic;
}

// Offsets of ranges, and walls that are not quite planes, look like a LiDAR that is moved. The
// evidence of a run averages what it takes for noise, and would be surer than that [m].
constexpr double kSharedTranslationStd = 0.004;

/** A position that is given as exact stays so. */
Vec3 withSharedErrors(const Vec3& translation_std)
{
  const Vec3 all = (translation_std.array().square() + std::pow(kSharedTranslationStd, 2)).sqrt();
  return (translation_std.array() > 0.0).select(all, 0.0);
}

CalibrationCheck checkOf(const CalibrationEstimate& calibration, const BeamErrors& beams)
{
  const Vector6 error = calibration.mean.segment<6>(kExtrinsicError);
  const Vector6 std =
      calibration.covariance.diagonal().segment<6>(kExtrinsicError).cwiseMax(0.0).cwiseSqrt();
  CalibrationCheck check;
  check.rotation = error.head<3>();
  check.rotation_std = std.head<3>();
  check.translation = error.tail<3>();
  check.translation_std = withSharedErrors(std.tail<3>());
  check.innovation_scale = calibration.innovation_scale;
  check.range_offset = beams.rangeOffset();
  check.elevation_offset = beams.elevationOffset();
  check.azimuth_offset = beams.azimuthOffset();
  check.side_range_offset = beams.sideRangeOffset();
  return check;
}
}  // namespace

/** The posterior becomes the state; what the map's errors add to its covariance is reported. */
void Estimator::adopt(const MatchResult& match, Work& work, ScanResult& result)
{
  FilterState& filter = state_.filter;
  filter = match.update.posterior;
  filter.x.R = normalizeRotation(filter.x.R);  // products of rotations drift off SO(3)
  filter.P.diagonal().segment<3>(kAttitude).array() += std::pow(work.predicted.end_rotation_std, 2);
  const LinearizedUpdate update = linearized(work.deskewed.compensation, match, filter.x);
  // Residuals of a match that was refused, or of a search, may be those of a wrong pose.
  const bool refused = !match.update.updated && !map_.empty();
  const bool beams_learn = !refused && !work.searched && calibration_.expectedInnovation() == 1.0;
  const ConsideredUpdate considered =
      map_.considerUpdate(work.deskewed, match, update, beams_, beams_learn);
  work.explained = calibration_.byPrior(considered.by_calibration.correction);
  const double surprise = learnFromInnovation(match, considered, update, work);
  if (!work.searched && !run().settlingAt(state_.stamp_ns))
    ambiguity_.addCorrection(work.predicted.state.x, filter.x, surprise);
  // A start in motion does not know its biases yet, and a given map has errors of its own.
  result.statistics.inertial_step =
      calibration_.takeStep() && !run().settlingAt(state_.stamp_ns) && !map_.isGiven();
  if (result.statistics.inertial_step) releaseBiasesAndClock();
  report(result);
  if (!run().settlingAt(state_.stamp_ns)) noteOpenDirections(match, result);

  preparation_.describe(work.scan, result.statistics);
  describeMatch(match, result.statistics);
  result.statistics.imu_samples = predictor_.inputs().size();
}

/** Innovations show the errors of the calibration. Not those of a search: there the scan says how
 * far off the guess was. And not those in a given map, whose own errors look like errors of the
 * mounting.
 * \return the surprise, of CalibrationEvidence */
double Estimator::learnFromInnovation(
    const MatchResult& match, const ConsideredUpdate& considered, const LinearizedUpdate& update,
    const Work& work)
{
  if (match.constraints.unconstrained > 0)
  {
    calibration_.addDegenerateScan();
    return 0.0;
  }
  if (!match.update.updated || work.searched)
  {
    calibration_.addUnmatchedScan();
    return 0.0;
  }
  PoseByCalibration by_calibration = considered.by_calibration.innovation;
  if (map_.isGiven()) by_calibration.setZero();
  return calibration_.add(
      by_calibration, update.by_state, work.predicted.state, match.update, considered.map_mismatch);
}

/** The position is lost along them, and what shows them again may be the wrong place. */
void Estimator::noteOpenDirections(const MatchResult& match, const ScanResult& result)
{
  const Mat3 position = result.filter.P.block<3, 3>(kPosition, kPosition);
  for (const MotionDirection& open : unconstrainedMotions(match.constraints))
    if (!open.is_rotation) ambiguity_.addOpenDirection(open.axis, position);
}

/** Whether it may be another place than the map says. */
void Estimator::notePlace(const MapSearchResult& matched, const DeskewedScan& scan)
{
  if (matched.poses) ambiguity_.add(*matched.poses, matched.expects_new_view);
  const UpdateResult& update = matched.match.update;
  if (map_.empty() && hasEnoughPoints(scan))
    ambiguity_.addPose(0.0);
  else if (update.updated)
    ambiguity_.addPose(
        inlierRatio(update.last.count, scan.surfaces.size()) / map_.usualInlierRatio());
}

/** The inertial sensor has changed, by a shock, by vibration, by heat, or a clock has jumped, and
 * no scan says which: biases are as uncertain as at a start in motion, and so is the time offset.
 * Else the filter, sure of the old ones, would follow the sensor against the scans, or put down to
 * the biases what the clock did. */
void Estimator::releaseBiasesAndClock()
{
  StateMatrix& P = state_.filter.P;
  const InitializationOptions& prior = options_.initialization;
  P.diagonal().segment<3>(kGyroBias).array() += std::pow(prior.motion_gyro_bias_std, 2);
  P.diagonal().segment<3>(kAccelBias).array() += std::pow(prior.accel_bias_std, 2);
  double& time_offset = P(kTimeOffset, kTimeOffset);
  if (time_offset > 0.0) time_offset += std::pow(options_.calibration.time_offset_std, 2);
}

/** The state as it is reported: with what the errors of map and calibration add, and as uncertain
 * as the innovations show. */
void Estimator::report(ScanResult& result) const
{
  const CalibrationEstimate& calibration = calibration_.estimate();
  result.filter = state_.filter;
  result.filter.P *= calibration.innovation_scale;
  const StateMatrix by_calibration = map_.calibrationError().addition(calibration.second_moment);
  StateMatrix systematic = calibration.innovation_scale * map_.error().addition() + by_calibration;
  const Matrix6 unambiguous = systematic.topLeftCorner<6, 6>();
  ambiguity_.addTo(state_.filter.x, result.filter.P, systematic);
  systematic = withoutNegativePart(systematic, result.filter.P);
  result.filter.P += systematic;
  result.map_covariance = systematic.topLeftCorner<6, 6>();
  result.ambiguity_covariance = result.map_covariance - unambiguous;
  result.calibration_covariance = by_calibration.topLeftCorner<6, 6>();
  result.pose_by_beams =
      (std::sqrt(calibration.innovation_scale) * map_.error().poseByBeams()).cast<float>();
  result.pose_by_calibration = map_.calibrationError().poseByCalibration().cast<float>();
  result.calibration_moment = calibration.second_moment.cast<float>();
  result.filter.P.block<6, 6>(kExtrinsicRotation, kExtrinsicRotation) =
      calibration_.extrinsicCovariance();
  result.statistics.calibration = checkOf(calibration, beams_);
}

/** calibration.estimate_extrinsic: takes off the error that the innovations show. The filter itself
 * does not estimate it, because it takes the innovations for independent. The map was made with
 * that error and would go on pulling, so a new one begins. */
void Estimator::correctExtrinsic(ScanResult& result)
{
  const bool tracks = std::holds_alternative<Tracking>(mode_) && run().consistent;
  if (!tracks || result.status != ScanStatus::Tracking || map_.isGiven()) return;
  const std::optional<Vector6> error = calibration_.dueCorrection(state_.stamp_ns);
  if (!error) return;
  state_.filter.x = boxplus(state_.filter.x, map_.calibrationError().withoutExtrinsicError(*error));
  calibration_.takeOff(*error);
  useMap(map_.successor(options_, workers_));
  agreement_.restart();
  report(result);
}

CalibrationFindings Estimator::calibrationFindings() const
{
  CalibrationFindings findings;
  findings.sums = calibration_.sums();
  beams_.addTo(findings);
  return findings;
}

StateMatrix Estimator::systematicCovariance(const Prediction& prediction) const
{
  const CalibrationEstimate& calibration = calibration_.estimate();
  StateMatrix systematic =
      (calibration.innovation_scale - 1.0) * prediction.state.P +
      calibration.innovation_scale * map_.error().additionAfter(prediction.transition) +
      map_.calibrationError().additionAfter(prediction.transition, calibration.second_moment);
  ambiguity_.addTo(prediction.state.x, prediction.state.P, systematic);
  return withoutNegativePart(systematic, prediction.state.P);
}

}  // namespace fastlio
