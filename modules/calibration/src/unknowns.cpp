// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "unknowns.h"

#include <fastlio/errormodel/calibration_evidence.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
// Errors of a laser that data sheets admit. The prior decides where beams and inertial sensor
// explain the same: elevations that are stretched look like a gyro with another scale.
constexpr double kRangeStd = 0.01;       // [m]
constexpr double kElevationStd = 0.001;  // [rad]; 0.06 deg
constexpr double kIncidenceStd = 0.02;   // of the range at 80 deg of incidence [m]
// Not every LiDAR has a bias of the shape that incidenceShape() has: over simulated rigs that have
// one of 20 mm, two thirds of it are found.
constexpr double kIncidenceShapeStd = 0.007;  // [m]
constexpr double kFarOff = 3.0;               // of the prior of the LiDAR's rotation
constexpr double kKnown = 0.3;                // of the prior: a beam that the data determine
constexpr std::size_t kFewestBeams = 3;       // of which constant and stretch are parts

}  // namespace

void PassFindings::add(const CalibrationRunResult& run)
{
  sums += run.findings.sums;
  for (const BeamSums& more : run.findings.beams)
  {
    BeamSums& beam = beams[more.elevation];
    beam.information += more.information;
    beam.weighted += more.weighted;
  }
  if (run.time_offset_std > 0.0)
  {
    time_information += std::pow(run.time_offset_std, -2);
    time_weighted += run.time_offset * std::pow(run.time_offset_std, -2);
  }
  clocks.push_back(run.clocks);
  incidence.information += run.findings.incidence.information;
  incidence.weighted += run.findings.incidence.weighted;
  upright_weight += run.findings.upright_weight;
  upright_range += run.findings.upright_range;
  tracked += run.tracked;
  problems.insert(problems.end(), run.problems.begin(), run.problems.end());
}

CalibrationUnknowns::CalibrationUnknowns(const CalibrationOptions& prior, const PassFindings& pass)
    : prior_(prior)
{
  for (const auto& [elevation, sums] : pass.beams)
    elevations_.push_back(elevation);
}

CalibrationPrior CalibrationUnknowns::prior(const Eigen::VectorXd& x) const
{
  CalibrationPrior prior = calibrationPriorOf(prior_);
  prior.mean = -x.head<kCalibrationErrorDim>();
  // Gyro, accelerometer and LiDAR may turn together without any data showing it. What the LiDAR is
  // off by is its own then, and not shared with axes that a factory has put in order.
  const double turned = x.segment<3>(kExtrinsicError).norm();
  auto rotation_std = prior.std.segment<3>(kExtrinsicError);
  if (turned > kFarOff * rotation_std.norm()) rotation_std = rotation_std.cwiseMax(turned).eval();
  return prior;
}

Eigen::Index CalibrationUnknowns::size() const
{
  return beamIndex(elevations_.size());
}

Eigen::Index CalibrationUnknowns::beamIndex(std::size_t beam) const
{
  return kTimeOffsetIndex + 1 + 2 * static_cast<Eigen::Index>(beam);
}

Rig CalibrationUnknowns::rigAt(const Rig& given, const Eigen::VectorXd& x) const
{
  const CalibrationErrorVector error = x.head<kCalibrationErrorDim>();
  Rig rig = corrected(given, error);
  rig.time_offset += x[kTimeOffsetIndex];
  std::vector<BeamRow> beams;
  for (std::size_t i = 0; i < elevations_.size(); ++i)
    beams.push_back({elevations_[i], x[beamIndex(i)], x[beamIndex(i) + 1]});
  return withBeams(rig, beams);
}

CalibrationStep CalibrationUnknowns::step(const PassFindings& pass, const Eigen::VectorXd& x) const
{
  const CalibrationEstimate errors = solve(pass.sums, prior(x), kSystematic);
  CalibrationStep step;
  step.innovation_scale = errors.innovation_scale;
  step.step = Eigen::VectorXd::Zero(size());
  step.covariance = Eigen::MatrixXd::Zero(size(), size());
  step.step.head<kCalibrationErrorDim>() = errors.mean;
  step.covariance.topLeftCorner<kCalibrationErrorDim, kCalibrationErrorDim>() = errors.covariance;
  // Surfaces that make the innovations large, like leaves, do the same to the residuals of beams.
  const double inflation = kSystematic * errors.innovation_scale;
  const double time_prior = std::pow(kTimeOffsetPriorStd, -2);
  const double time_variance = 1.0 / (pass.time_information / inflation + time_prior);
  step.step[kTimeOffsetIndex] =
      time_variance * (pass.time_weighted / inflation - time_prior * x[kTimeOffsetIndex]);
  step.covariance(kTimeOffsetIndex, kTimeOffsetIndex) = time_variance;
  const Eigen::Vector2d prior_information(std::pow(kRangeStd, -2), std::pow(kElevationStd, -2));
  for (std::size_t i = 0; i < elevations_.size(); ++i)
  {
    const auto found = pass.beams.find(elevations_[i]);
    const BeamSums sums = found == pass.beams.end() ? BeamSums{} : found->second;
    Eigen::Matrix2d information = sums.information / inflation;
    information.diagonal() += prior_information;
    const Eigen::Vector2d pull = prior_information.cwiseProduct(x.segment<2>(beamIndex(i)));
    const Eigen::Matrix2d covariance = information.inverse();
    step.step.segment<2>(beamIndex(i)) =
        covariance * (Eigen::Vector2d(sums.weighted) / inflation - pull);
    step.covariance.block<2, 2>(beamIndex(i), beamIndex(i)) = covariance;
  }
  const std::vector<std::size_t> known = knownBeams(step);
  if (known.size() >= kFewestBeams) removeCommonPart(known, x, step.step);
  return step;
}

std::vector<std::size_t> CalibrationUnknowns::knownBeams(const CalibrationStep& step) const
{
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < elevations_.size(); ++i)
    if (step.covariance(beamIndex(i) + 1, beamIndex(i) + 1) < std::pow(kKnown * kElevationStd, 2))
      known.push_back(i);
  return known;
}

double CalibrationUnknowns::stretchStd(const CalibrationStep& step) const
{
  const std::vector<std::size_t> known = knownBeams(step);
  if (known.size() < kFewestBeams) return 0.0;
  const ElevationLever lever = leverOf(known);
  return kElevationStd / std::sqrt(lever.squares);
}

CommonElevation CalibrationUnknowns::commonElevation(
    const PassFindings& pass, const CalibrationStep& step, const Vec3& up) const
{
  CommonElevation common{Eigen::VectorXd::Zero(size()), Eigen::VectorXd::Zero(size())};
  const std::vector<std::size_t> known = knownBeams(step);
  if (known.size() < kFewestBeams || !(pass.upright_weight > 0.0)) return common;
  const double std = kElevationStd / std::sqrt(static_cast<double>(known.size()));
  for (std::size_t i = 0; i < elevations_.size(); ++i)
    common.direction[beamIndex(i) + 1] = std;
  // Points that are seen too high are those of a LiDAR that is taken to sit too high. The ground is
  // seen from one height, but walls tell the height whenever the LiDAR tilts.
  const double mean_range = pass.upright_range / pass.upright_weight;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Index i = kExtrinsicError + 3 + axis;
    const double prior = std::pow(prior_.extrinsic_translation_std, 2);
    if (!(prior > 0.0)) continue;
    const double known_part = std::max(0.0, 1.0 - step.covariance(i, i) / prior);
    common.response[i] = -known_part * std * mean_range * up[axis];
  }
  return common;
}

MeasuredBias CalibrationUnknowns::incidenceBias(
    const PassFindings& pass, const CalibrationStep& step) const
{
  const double inflation = kSystematic * step.innovation_scale;
  const double information = pass.incidence.information / inflation + std::pow(kIncidenceStd, -2);
  return {
      pass.incidence.weighted / inflation / information,
      std::hypot(1.0 / std::sqrt(information), kIncidenceShapeStd), kIncidenceStd};
}

CalibrationUnknowns::ElevationLever CalibrationUnknowns::leverOf(
    const std::vector<std::size_t>& beams) const
{
  ElevationLever lever;
  for (const std::size_t beam : beams)
    lever.mean += elevations_[beam] / static_cast<double>(beams.size());
  for (const std::size_t beam : beams)
    lever.squares += std::pow(elevations_[beam] - lever.mean, 2);
  return lever;
}

/** The mean over all beams, and the part that grows with the elevation, stay zero: of independent
 * lasers it is a fraction of one's error, and no data distinguish it from the extrinsic and the
 * gyro. */
void CalibrationUnknowns::removeCommonPart(
    const std::vector<std::size_t>& known, const Eigen::VectorXd& x, Eigen::VectorXd& step) const
{
  const ElevationLever lever = leverOf(known);
  const auto count = static_cast<double>(known.size());
  double range = 0.0, offset = 0.0, stretch = 0.0;
  for (const std::size_t beam : known)
  {
    const Eigen::Vector2d total = (x + step).segment<2>(beamIndex(beam));
    range += total[0] / count;
    offset += total[1] / count;
    stretch += total[1] * (elevations_[beam] - lever.mean) / lever.squares;
  }
  for (std::size_t i = 0; i < elevations_.size(); ++i)
  {
    step[beamIndex(i)] -= range;
    step[beamIndex(i) + 1] -= offset + stretch * (elevations_[i] - lever.mean);
  }
}

}  // namespace fastlio
