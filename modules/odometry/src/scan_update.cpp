// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scan_update.h"

#include <fastlio/math/stopwatch.h>

#include <functional>
#include <utility>

namespace fastlio
{
namespace
{
ResidualModel residualModelOf(const MeasurementOptions& p, const Matrix6& predicted)
{
  ResidualModel model;
  model.range_variance = p.range_noise * p.range_noise;
  model.gate = p.max_normalized_residual;
  model.kernel = p.robust_kernel;
  model.kernel_scale = p.robust_scale;
  model.prior_position_variance = predicted.bottomRightCorner<3, 3>().trace();
  model.prior_attitude_variance = predicted.topLeftCorner<3, 3>().trace();
  return model;
}
}  // namespace

ScanUpdate::ScanUpdate(const Parameters& parameters, std::shared_ptr<const Workers> workers)
    : parameters_(parameters), workers_(std::move(workers))
{
}

void ScanUpdate::associate(
    const Pose& T_world_scan, const BodyPoints& points, const SurfaceMap& map, EdgeStage& edges)
{
  const Stopwatch watch;
  workers_->forEachChunk(
      points.size(),
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        transformToWorld(points, T_world_scan, first, last, world_);
        map.match(world_, first, last, matches_);
      });
  edges.associate(T_world_scan);
  association_ms_ += watch.milliseconds();
}

void ScanUpdate::findConstraints(
    const Pose& T_world_scan, const BodyPoints& points, const InformationSums& sums)
{
  constraints_ = {};
  const double min_signal_to_noise = parameters_.measurement.min_signal_to_noise;
  if (min_signal_to_noise <= 0.0 || !mayBeDegenerate(sums.HtRinvH)) return;
  chunk_noise_.resize(chunk_sums_.size());
  workers_->forEachChunk(
      points.size(),
      [&](std::size_t chunk, std::size_t first, std::size_t last)
      {
        chunk_noise_[chunk] =
            normalNoiseInformation(T_world_scan, points, matches_, model_, first, last);
      });
  Matrix6 noise = Matrix6::Zero();
  for (const Matrix6& part : chunk_noise_)
    noise += part;
  constraints_ = scanConstraints(sums.HtRinvH, noise, min_signal_to_noise);
}

MeasurementEvaluation ScanUpdate::evaluate(
    const NavState& iterate, int iteration, const CompensatedScan& scan, const SurfaceMap& map,
    EdgeStage& edges)
{
  const Pose T_world_scan = scanPose(iterate, scan.compensation);
  const BodyPoints& points = scan.points;
  if (iteration < parameters_.measurement.association_iterations)
    associate(T_world_scan, points, map, edges);
  workers_->forEachChunk(
      points.size(), [&](std::size_t chunk, std::size_t first, std::size_t last)
      { chunk_sums_[chunk] = accumulate(T_world_scan, points, matches_, model_, first, last); });
  MeasurementEvaluation evaluation;
  for (const InformationSums& sums : chunk_sums_)
    addSums(evaluation.sums, sums);
  addSums(evaluation.sums, edges.sums(T_world_scan, model_));
  if (iteration == 0) findConstraints(T_world_scan, points, evaluation.sums);
  evaluation.sums = constrainedSums(evaluation.sums, constraints_);
  if (parameters_.gain == GainForm::Standard)
  {
    evaluation.stacked = stack(T_world_scan, points, matches_, model_);
    edges.stack(T_world_scan, model_, evaluation.stacked);
    for (Vector6& h : evaluation.stacked.h)
      h = constraints_.projection.transpose() * h;
  }
  evaluation.unconstrained = unconstrainedMotions(constraints_);
  evaluation.by_state = scanPoseJacobian(iterate, scan.compensation);
  return evaluation;
}

UpdateResult ScanUpdate::run(
    const FilterState& predicted, const CompensatedScan& scan, const SurfaceMap& map,
    EdgeStage& edges)
{
  association_ms_ = 0.0;
  world_.resize(scan.points.size());
  matches_.resize(scan.points.size());
  chunk_sums_.resize(Workers::chunks(scan.points.size()));
  model_ =
      residualModelOf(parameters_.measurement, scanPoseCovariance(predicted, scan.compensation));
  const auto minimum = static_cast<std::size_t>(parameters_.measurement.min_effective_points);
  std::size_t effective = 0;
  const auto measurements = [&](const NavState& iterate, int iteration)
  {
    MeasurementEvaluation e = evaluate(iterate, iteration, scan, map, edges);
    effective = e.sums.count;
    // An evaluation without measurements makes the update leave the prediction alone.
    return effective < minimum ? MeasurementEvaluation{} : e;
  };
  UpdateResult update =
      // By reference: a copy of the captures would go to the heap.
      iteratedUpdate(predicted, std::cref(measurements), parameters_.update, parameters_.gain);
  update.last.count = effective;
  return update;
}

}  // namespace fastlio
