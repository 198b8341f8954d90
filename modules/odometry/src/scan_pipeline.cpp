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

/** Eq. 4-8 through inputs that hold until end_ns; \a visit(stamp_ns, state) after each step. */
template <typename Visit>
FilterState propagateThrough(
    FilterState s, const std::vector<ImuSample>& inputs, std::int64_t end_ns, const ImuNoise& noise,
    const Visit& visit)
{
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    const std::int64_t stop_ns = i + 1 < inputs.size() ? inputs[i + 1].stamp_ns : end_ns;
    const double dt = static_cast<double>(stop_ns - inputs[i].stamp_ns) * kNsToS;
    s = propagate(s, inputs[i].gyro, inputs[i].accel, dt, noise);
    visit(stop_ns, s);
  }
  return s;
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
    : parameters_(parameters),
      workers_(std::make_shared<const Workers>(parameters.threads)),
      map_(makeSurfaceMap(parameters, workers_)),
      reducer_(workers_),
      deskewer_(workers_)
{
}

void ScanPipeline::start(const FilterState& state, std::int64_t stamp_ns)
{
  filter_ = state;
  state_ns_ = stamp_ns;
  last_update_ns_ = stamp_ns;
}

ScanResult ScanPipeline::process(const LidarScan& scan, const ScanSpan& span, const ImuBuffer& imu)
{
  const Stopwatch total;
  timings_ = {};
  ScanResult result;
  result.begin_ns = span.begin_ns;
  result.stamp_ns = span.end_ns;

  const FilterState predicted = propagateTo(span.end_ns, imu);  // eq. 4-8
  reduce(scan);
  compensate(scan, span, predicted);                      // eq. 9-10
  const UpdateResult update = updateWithScan(predicted);  // eq. 12-20
  filter_ = update.posterior;
  filter_.x.R =
      normalizeRotation(filter_.x.R);  // products of rotations drift off SO(3) by rounding
  state_ns_ = span.end_ns;
  result.filter = considerMapError(predicted);
  judge(update, result);
  pose_trusted_ = result.status != ScanStatus::Diverged;
  if (mayGrowMap(result))
    growMap(scan.T_imu_lidar.p, result.filter);  // eq. 21
  else
    world_.resize(0);

  describeUpdate(update, result.statistics);
  describeScan(scan, result.statistics);
  timings_.total = total.milliseconds();
  result.milliseconds = timings_;
  return result;
}

void ScanPipeline::describeScan(const LidarScan& scan, ScanStatistics& statistics) const
{
  statistics.points_in = scan.points.size();
  statistics.dropped_invalid = scan.dropped_invalid + selection_.dropped_invalid;
  statistics.dropped_near = selection_.dropped_near;
  statistics.dropped_far = selection_.dropped_far;
  statistics.points_reduced = selection_.indices.size();
  statistics.imu_samples = inputs_.size();
  statistics.map_points = map_->pointCount();
}

void ScanPipeline::reduce(const LidarScan& scan)
{
  const Stopwatch watch;
  reducer_.select(scan.points, reductionLimits(parameters_), selection_);
  timings_.reduce = watch.milliseconds();
}

std::optional<ImuRateState> ScanPipeline::stateAtNewestSample(const ImuBuffer& imu)
{
  const std::int64_t stamp_ns = imu.newestStamp();
  if (!pose_trusted_ || stamp_ns <= state_ns_) return std::nullopt;
  imu.inputsBetween(state_ns_, stamp_ns, parameters_.imu.hold, inputs_);
  const FilterState s = propagateThrough(
      filter_, inputs_, stamp_ns, parameters_.imu.noise, [](std::int64_t, const FilterState&) {});
  if (!isFinite(s.x) || !s.P.allFinite()) return std::nullopt;
  return imuRateState(stamp_ns, s, map_error_.shareAt(s.x.pose()), imu);
}

FilterState ScanPipeline::propagateTo(std::int64_t end_ns, const ImuBuffer& imu)
{
  const Stopwatch watch;
  imu_gap_s_ = static_cast<double>(imu.longestGap(state_ns_, end_ns)) * kNsToS;
  imu.inputsBetween(state_ns_, end_ns, parameters_.imu.hold, inputs_);
  imu_rate_.clear();
  FilterState s = propagateThrough(
      filter_, inputs_, end_ns, parameters_.imu.noise,
      [&](std::int64_t stamp_ns, const FilterState& state)
      {
        if (!parameters_.output.imu_rate || !pose_trusted_) return;
        const Matrix6 map_share = map_error_.shareAt(state.x.pose());
        const auto at_sample = imuRateState(stamp_ns, state, map_share, imu);
        if (at_sample) imu_rate_.push_back(*at_sample);
      });
  // Absurd but finite inertial samples may overflow; such a number never enters the state.
  prediction_finite_ = isFinite(s.x) && s.P.allFinite();
  if (!prediction_finite_)
  {
    s = filter_;
    imu_rate_.clear();
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
    deskewer_.deskew(scan, selection_.indices, knots_, body_);
  }
  else
    deskewer_.transformToBody(scan, selection_.indices, body_);
  timings_.deskew = watch.milliseconds();
}

void ScanPipeline::associate(const Pose& T_world_imu)
{
  const Stopwatch watch;
  workers_->forEachChunk(
      body_.size(),
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        transformToWorld(body_, T_world_imu, first, last, world_);
        map_->match(world_, first, last, matches_);
      });
  timings_.associate += watch.milliseconds();
}

MeasurementEvaluation ScanPipeline::evaluate(
    const NavState& iterate, const ResidualModel& model, int iteration)
{
  if (iteration < parameters_.measurement.association_iterations) associate(iterate.pose());
  workers_->forEachChunk(
      body_.size(), [&](std::size_t chunk, std::size_t first, std::size_t last)
      { chunk_sums_[chunk] = accumulate(iterate.pose(), body_, matches_, model, first, last); });
  MeasurementEvaluation evaluation;
  for (const InformationSums& sums : chunk_sums_)
    addSums(evaluation.sums, sums);
  if (parameters_.gain == GainForm::Standard)
    evaluation.stacked = stack(iterate.pose(), body_, matches_, model);
  return evaluation;
}

UpdateResult ScanPipeline::updateWithScan(const FilterState& predicted)
{
  const Stopwatch watch;
  world_.resize(body_.size());
  matches_.resize(body_.size());
  chunk_sums_.resize(Workers::chunks(body_.size()));
  const ResidualModel residuals = residualModel(parameters_.measurement, predicted);
  const auto minimum = static_cast<std::size_t>(parameters_.measurement.min_effective_points);
  std::size_t effective = 0;
  const auto model = [&](const NavState& iterate, int iteration)
  {
    MeasurementEvaluation e = evaluate(iterate, residuals, iteration);
    effective = e.sums.count;
    // An evaluation without measurements makes the update leave the prediction alone.
    return effective < minimum ? MeasurementEvaluation{} : e;
  };
  UpdateResult update = iteratedUpdate(predicted, model, parameters_.update, parameters_.gain);
  update.last.count = effective;
  timings_.update = watch.milliseconds() - timings_.associate;
  return update;
}

void ScanPipeline::judge(const UpdateResult& update, ScanResult& result)
{
  result.status = ScanStatus::Tracking;
  if (map_->pointCount() == 0)
    result.status = ScanStatus::FirstScan;
  else if (!update.updated)
    result.status = ScanStatus::PredictionOnly;
  if (result.status != ScanStatus::PredictionOnly) last_update_ns_ = state_ns_;

  const double unaided_s = static_cast<double>(state_ns_ - last_update_ns_) * kNsToS;
  const double position_std =
      std::sqrt(filter_.P.block<3, 3>(kPosition, kPosition).diagonal().maxCoeff());
  if (!prediction_finite_ || unaided_s > parameters_.measurement.max_unaided_time)
    result.status = ScanStatus::Diverged;
  if (imu_gap_s_ > parameters_.imu.max_gap)
    result.message = mrpt::format(
        "%.2f s without inertial samples (imu.max_gap is %.2f s): bridged with the last rate and "
        "acceleration",
        imu_gap_s_, parameters_.imu.max_gap);
  if (result.status == ScanStatus::PredictionOnly || result.status == ScanStatus::Diverged)
    result.message = mrpt::format(
        "%zu of %zu points match the map, at least %i are needed "
        "(measurement.min_effective_points); "
        "%.2f s on inertial data alone, position uncertain by %.3f m%s",
        update.last.count, body_.size(), parameters_.measurement.min_effective_points, unaided_s,
        position_std, prediction_finite_ ? "" : "; the inertial data overflowed the prediction");
}

bool ScanPipeline::mayGrowMap(const ScanResult& result) const
{
  if (result.status == ScanStatus::Tracking || result.status == ScanStatus::FirstScan) return true;
  if (result.status == ScanStatus::Diverged) return false;
  // A young map has few planes: it must grow as long as the prediction knows where the scan is.
  const double position_variance =
      filter_.P.block<3, 3>(kPosition, kPosition).diagonal().maxCoeff();
  return position_variance < std::pow(parameters_.map.max_insertion_std, 2);
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
  const Pose T_world_imu = filter_.x.pose();
  workers_->forEachChunk(
      body_.size(), [&](std::size_t, std::size_t first, std::size_t last)
      { transformToWorld(body_, T_world_imu, first, last, world_); });
  map_error_.recordInsertion(++insertions_, total.P.topLeftCorner<6, 6>(), filter_.x.pose());
  map_->insert(world_, filter_.x.pose() * p_imu_lidar);
  map_->removeOutside(filter_.x.p, parameters_.map.radius);
  timings_.insert = watch.milliseconds();
}

}  // namespace fastlio
