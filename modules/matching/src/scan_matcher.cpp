// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "residual_model.h"
#include <fastlio/matching/point_to_line.h>
#include <fastlio/matching/scan_matcher.h>
#include <fastlio/math/stopwatch.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <functional>
#include <utility>

namespace fastlio
{
namespace
{
constexpr int kPullInIterations = 15;
// Gate, in standard deviations of residual and prior: 99.7 % of what noise explains passes.
constexpr double kResidualGate = 3.0;
// Encoders of spinning LiDARs tell the direction of a beam to 0.01 deg (data sheet of the OS1), and
// a beam is ten times as wide. With twice as much, points far away, which show the attitude and the
// first signs of a wrong prediction, count too little.
constexpr double kDirectionStd = 1e-4;  // [rad]

// Where a step has moved points less, the planes' variances at them are as before.
constexpr double kSmallStep = 0.02;  // [m]
constexpr double kLeverArm = 10.0;   // of the points [m]

bool isSmallStep(const Pose& from, const Pose& to)
{
  const Vec3 turn = logSO3(from.R.transpose() * to.R);
  return (to.p - from.p).norm() + kLeverArm * turn.norm() < kSmallStep;
}

template <class Match>
std::size_t countValid(const std::vector<Match>& matches)
{
  return static_cast<std::size_t>(std::count_if(
      matches.begin(), matches.end(), [](const Match& match) { return match.valid(); }));
}

/** The prediction's uncertainty of position, as the gate takes it. One direction may be far more
 * uncertain than the others (along a tunnel), which says nothing about planes across. The two
 * others count whatever the plane: a prediction that is a little too sure of itself may not lose
 * the planes that would correct it. */
Mat3 priorOfGate(const Mat3& P)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(P, Eigen::EigenvaluesOnly);
  return P + solver.eigenvalues().head<2>().sum() * Mat3::Identity();
}
}  // namespace

ResidualModel residualModelOf(const MeasurementOptions& options, const Matrix6& predicted)
{
  ResidualModel model;
  model.range_variance = options.range_noise * options.range_noise;
  model.gate = kResidualGate;
  model.prior_position_covariance = priorOfGate(predicted.bottomRightCorner<3, 3>());
  model.prior_attitude_variance = predicted.topLeftCorner<3, 3>().trace();
  model.direction_variance = kDirectionStd * kDirectionStd;
  return model;
}

MatchOptions ordinaryMatching(const OdometryOptions& options)
{
  MatchOptions ordinary;
  ordinary.measurement = options.measurement;
  ordinary.limits = options.update;
  ordinary.gain = options.gain;
  return ordinary;
}

MatchOptions pullInMatching(const OdometryOptions& options)
{
  MatchOptions more = ordinaryMatching(options);
  more.association_iterations = kPullInIterations;
  more.limits.max_iterations = kPullInIterations;
  return more;
}

ScanMatcher::ScanMatcher(std::shared_ptr<const Workers> workers) : workers_(std::move(workers)) {}

void ScanMatcher::associate(const Pose& T_world_scan, int iteration, const Call& call)
{
  const Stopwatch watch;
  // Where little of a scan matches, each plane counts.
  const bool stays_near = iteration > 0 && isSmallStep(associated_at_, T_world_scan) &&
                          2 * measured_.sums().count >= call.scan.surfaces.size();
  associated_at_ = T_world_scan;
  std::swap(world_, world_before_);
  const BodyPoints& points = call.scan.surfaces;
  const Vec3 origin = T_world_scan * call.scan.T_imu_lidar.p;
  workers_->forEachChunk(
      points.size(),
      [&](std::size_t, std::size_t first, std::size_t last)
      {
        transformToWorld(points, T_world_scan, first, last, world_);
        if (stays_near)
          call.maps.surfaces.rematch(world_before_, world_, origin, first, last, matches_);
        else
          call.maps.surfaces.match(world_, origin, first, last, matches_);
      });
  const BodyPoints& edges = call.scan.edges;
  transformToWorld(edges, T_world_scan, 0, edges.size(), world_edges_);
  call.maps.edges.match(world_edges_, 0, edges.size(), edge_matches_);
  call.result.association_ms += watch.milliseconds();
}

void ScanMatcher::findConstraints(
    const Mat3& R_world_scan, const InformationSums& sums, const Call& call)
{
  const double min_signal_to_noise = call.options.measurement.min_signal_to_noise;
  if (min_signal_to_noise <= 0.0 || !mayBeDegenerate(sums.HtRinvH)) return;
  const BodyPoints& points = call.scan.surfaces;
  chunk_noise_.resize(measured_.chunks());
  workers_->forEach(
      measured_.chunks(),
      [&](std::size_t chunk)
      {
        chunk_noise_[chunk] =
            normalNoiseInformation(R_world_scan, points, matches_, measured_, chunk);
      });
  Matrix6 noise = Matrix6::Zero();
  for (const Matrix6& part : chunk_noise_)
    noise += part;
  ScanConstraints& constraints = call.result.constraints;
  strongest_planes_.look(measured_, matches_);
  TranslationAxes translations(3, 0);
  if (!call.options.at_start)
    translations = strongest_planes_.unsupportedTranslations(
        measured_, sums.HtRinvH, noise, min_signal_to_noise);
  constraints = informationByDirection(sums.HtRinvH, noise, translations);
  strongest_planes_.takeFromSupport(measured_, constraints);
  leaveOutUnconstrained(
      min_signal_to_noise, constraints,
      call.options.at_start ? kSupportedPartAtStart : kSupportedPart);
}

// Eq. 12-14 at an iterate, without the directions that the scan does not constrain.
InformationSums ScanMatcher::measure(const Pose& T_world_scan, int iteration, const Call& call)
{
  const BodyPoints &points = call.scan.surfaces, &edges = call.scan.edges;
  const ResidualModel& model = call.result.model;
  if (iteration < call.options.association_iterations) associate(T_world_scan, iteration, call);
  measured_.measure(*workers_, T_world_scan, points, matches_, model);
  InformationSums sums = measured_.sums();
  addSums(sums, accumulateLines(T_world_scan, edges, edge_matches_, model, 0, edges.size()));
  if (iteration == 0) findConstraints(T_world_scan.R, sums, call);
  return constrainedSums(sums, call.result.constraints);
}

MeasurementEvaluation ScanMatcher::evaluate(
    const NavState& iterate, int iteration, const Call& call)
{
  const CompensatedWith& compensation = call.scan.compensation;
  const Pose T_world_scan = scanPose(iterate, compensation);
  MeasurementEvaluation evaluation;
  evaluation.sums = measure(T_world_scan, iteration, call);
  const ScanConstraints& constraints = call.result.constraints;
  if (call.options.gain == GainForm::Standard)
  {
    const BodyPoints &points = call.scan.surfaces, &edges = call.scan.edges;
    const ResidualModel& model = call.result.model;
    evaluation.stacked = stack(T_world_scan, points, matches_, model);
    stackLines(T_world_scan, edges, edge_matches_, model, evaluation.stacked);
    for (Vector6& h : evaluation.stacked.h)
      h = constraints.projection.transpose() * h;
  }
  evaluation.unconstrained = unconstrainedMotions(constraints);
  evaluation.by_state = scanPoseJacobian(iterate, compensation);
  return evaluation;
}

void ScanMatcher::makeRoomFor(const DeskewedScan& scan)
{
  const std::size_t points = scan.surfaces.size();
  world_.resize(points);
  world_before_.resize(points);
  matches_.resize(points);
  world_edges_.resize(scan.edges.size());
  edge_matches_.resize(scan.edges.size());
  // Which scans need these depends on what they see.
  makeRoom(chunk_noise_, Workers::chunks(points));
  strongest_planes_.reserve(points);
}

MatchResult ScanMatcher::match(
    const DeskewedScan& scan, const FilterState& predicted, const MatchedMaps& maps,
    const MatchOptions& options)
{
  makeRoomFor(scan);
  MatchResult result;
  const FilterState& start = options.start ? *options.start : predicted;
  result.model = residualModelOf(
      options.measurement, options.gate_factor * scanPoseCovariance(start, scan.compensation));
  result.model.direction_variance += options.map_attitude_variance;
  const double shared =
      static_cast<double>(scan.surfaces.size()) * options.deskew_std * options.deskew_std;
  result.model.weight = result.model.range_variance / (result.model.range_variance + shared);
  result.matches = &matches_;
  result.measured = &measured_;
  const Call call{scan, maps, options, result};
  std::size_t effective = 0;
  const auto measurements = [&](const NavState& iterate, int iteration)
  {
    MeasurementEvaluation e = evaluate(iterate, iteration, call);
    effective = e.sums.count;
    // An evaluation without measurements makes the update leave the prediction alone.
    return effective < kMinEffectivePoints ? MeasurementEvaluation{} : e;
  };
  result.update =
      // By reference: a copy of the captures would go to the heap.
      iteratedUpdate(predicted, start.x, std::cref(measurements), options.limits, options.gain);
  result.update.last.count = effective;
  result.mapped = countValid(matches_) + countValid(edge_matches_);
  return result;
}

}  // namespace fastlio
