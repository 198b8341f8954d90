// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scan_pipeline.h"

#include "map_factory.h"
#include "stopwatch.h"

#include <Eigen/Eigenvalues>
#include <mrpt/core/format.h>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kNsToS = 1e-9;

ReductionLimits reductionLimits(const Parameters& p)
{
  return {
      static_cast<float>(p.lidar.min_range), static_cast<float>(p.lidar.max_range),
      static_cast<std::size_t>(p.reduction.target_points)};
}

ResidualModel residualModel(const MeasurementParameters& p, const FilterState& predicted)
{
  ResidualModel model;
  model.range_variance = p.range_noise * p.range_noise;
  model.gate = p.max_normalized_residual;
  model.prior_position_variance = predicted.P.block<3, 3>(kPosition, kPosition).trace();
  model.prior_attitude_variance = predicted.P.block<3, 3>(kAttitude, kAttitude).trace();
  return model;
}

Vector6 eigenvalues(const Matrix6& m)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(m, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

void describeUpdate(const UpdateResult& update, ScanStatistics& statistics)
{
  const InformationSums& sums = update.last;
  statistics.points_effective = sums.count;
  statistics.iterations = update.iterations;
  statistics.converged = update.converged;
  if (sums.count == 0) return;
  const double n = static_cast<double>(sums.count);
  statistics.residual_rms = std::sqrt(sums.squares / n);
  statistics.normalized_innovation = sums.weighted_squares / n;
  statistics.information_eigenvalues = eigenvalues(sums.HtRinvH);
}
}  // namespace

ScanPipeline::ScanPipeline(const Parameters& parameters)
    : parameters_(parameters), map_(makeSurfaceMap(parameters))
{
}

void ScanPipeline::start(const FilterState& state, std::int64_t stamp_ns)
{
  filter_ = state;
  state_ns_ = stamp_ns;
}

ScanResult ScanPipeline::process(const LidarScan& scan, const ScanSpan& span, const ImuBuffer& imu)
{
  const Stopwatch total;
  timings_ = {};
  ScanResult result;
  result.begin_ns = span.begin_ns;
  result.stamp_ns = span.end_ns;

  const FilterState predicted = propagateTo(span.end_ns, imu);  // eq. 4-8
  reducer_.select(scan.points, reductionLimits(parameters_), selection_);
  compensate(scan, span, predicted);                      // eq. 9-10
  const UpdateResult update = updateWithScan(predicted);  // eq. 12-20
  filter_ = update.posterior;
  state_ns_ = span.end_ns;
  describeUpdate(update, result.statistics);
  decideStatus(update, result);
  result.filter = considerMapError(predicted);
  growMap(scan.T_imu_lidar.p, result.filter);  // eq. 21

  timings_.total = total.milliseconds();
  result.milliseconds = timings_;
  result.statistics.points_in = scan.points.size();
  result.statistics.dropped_invalid = scan.dropped_invalid + selection_.dropped_invalid;
  result.statistics.dropped_near = selection_.dropped_near;
  result.statistics.dropped_far = selection_.dropped_far;
  result.statistics.points_reduced = selection_.indices.size();
  result.statistics.imu_samples = inputs_.size();
  result.statistics.map_points = map_->pointCount();
  return result;
}

FilterState ScanPipeline::propagateTo(std::int64_t end_ns, const ImuBuffer& imu)
{
  const Stopwatch watch;
  imu.inputsBetween(state_ns_, end_ns, parameters_.imu.hold, inputs_);
  FilterState s = filter_;
  for (std::size_t i = 0; i < inputs_.size(); ++i)
  {
    const std::int64_t stop_ns = i + 1 < inputs_.size() ? inputs_[i + 1].stamp_ns : end_ns;
    const double dt = static_cast<double>(stop_ns - inputs_[i].stamp_ns) * kNsToS;
    s = propagate(s, inputs_[i].gyro, inputs_[i].accel, dt, parameters_.imu.noise);
  }
  timings_.propagate = watch.milliseconds();
  return s;
}

void ScanPipeline::compensate(
    const LidarScan& scan, const ScanSpan& span, const FilterState& predicted)
{
  const Stopwatch watch;
  if (parameters_.lidar.deskew && scan.has_point_times)
  {
    backwardPropagate(predicted.x, span.end_ns, inputs_, knots_);
    deskew(scan, selection_.indices, knots_, body_);
  }
  else
    transformToBody(scan, selection_.indices, body_);
  timings_.deskew = watch.milliseconds();
}

MeasurementEvaluation ScanPipeline::evaluate(
    const NavState& iterate, const FilterState& predicted, int iteration)
{
  const Stopwatch associate;
  if (iteration < parameters_.measurement.association_iterations)
  {
    transformToWorld(body_, iterate.pose(), world_);
    map_->match(world_, 0, world_.size(), matches_);
  }
  timings_.associate += associate.milliseconds();
  MeasurementEvaluation evaluation;
  const bool stack = parameters_.gain == GainForm::Standard;
  evaluation.sums = accumulate(
      iterate.pose(), body_, matches_, residualModel(parameters_.measurement, predicted),
      stack ? &evaluation.stacked : nullptr);
  return evaluation;
}

UpdateResult ScanPipeline::updateWithScan(const FilterState& predicted)
{
  const Stopwatch watch;
  matches_.resize(body_.size());
  const auto model = [&](const NavState& iterate, int iteration)
  {
    MeasurementEvaluation e = evaluate(iterate, predicted, iteration);
    if (e.sums.count < static_cast<std::size_t>(parameters_.measurement.min_effective_points))
      e = {};
    return e;
  };
  UpdateResult update = iteratedUpdate(predicted, model, parameters_.update, parameters_.gain);
  timings_.update = watch.milliseconds() - timings_.associate;
  return update;
}

void ScanPipeline::decideStatus(const UpdateResult& update, ScanResult& result)
{
  result.status = ScanStatus::Tracking;
  if (map_->pointCount() == 0)
    result.status = ScanStatus::FirstScan;
  else if (!update.updated)
  {
    ++scans_without_update_;
    result.status = ScanStatus::PredictionOnly;
    result.message = "too few points match the map";
  }
  else
    scans_without_update_ = 0;
}

FilterState ScanPipeline::considerMapError(const FilterState& predicted)
{
  FilterState total = filter_;
  total.P.topLeftCorner<6, 6>() += map_error_.update(
      filter_.x.pose(), filter_.P.topLeftCorner<6, 6>(), body_, matches_,
      residualModel(parameters_.measurement, predicted));
  return total;
}

void ScanPipeline::growMap(const Vec3& p_imu_lidar, const FilterState& total)
{
  const Stopwatch watch;
  if (scans_without_update_ == 0)
  {
    transformToWorld(body_, filter_.x.pose(), world_);
    map_error_.recordInsertion(++insertions_, total.P.topLeftCorner<6, 6>(), filter_.x.pose());
    map_->insert(world_, filter_.x.pose() * p_imu_lidar);
    map_->removeOutside(filter_.x.p, parameters_.map.radius);
  }
  timings_.insert = watch.milliseconds();
}

}  // namespace fastlio
