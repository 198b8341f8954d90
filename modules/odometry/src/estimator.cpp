// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "estimator.h"

#include "zero_velocity.h"
#include <fastlio/math/stopwatch.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace fastlio
{
namespace
{
// So many of a scan's points match before the time offset is estimated: the map has become dense.
constexpr double kTimeOffsetInlierRatio = 0.3;
// Or so many scans are in the map, which then is as dense as it gets: among leaves, 30 % of the
// points never match.
constexpr std::size_t kTimeOffsetInsertions = 50;

ScanOutcome::Place placeOf(const Mode& mode)
{
  if (std::holds_alternative<EnteringMap>(mode)) return ScanOutcome::Place::OutsideGivenMap;
  if (std::holds_alternative<Relocalizing>(mode)) return ScanOutcome::Place::Reinitialised;
  return ScanOutcome::Place::InMap;
}

/** In a sparse map attitudes are wrong by milliradians, and the filter takes that for the time
 * offset: the platform must turn so fast that this moves it by less than a centimetre.
 * \param rate [rad/s] \param speed [m/s] */
bool turnsFast(double rate, double speed, double time_offset_std)
{
  constexpr double kSparseAttitude = 0.003;  // [rad]
  constexpr double kHarmlessShift = 0.01;    // [m]
  constexpr double kLeastTurn = 0.001;       // by the offset: a smaller one says nothing [rad]
  return time_offset_std * rate > kLeastTurn && kHarmlessShift * rate > kSparseAttitude * speed;
}
}  // namespace

void RegisteredScan::clear()
{
  points.resize(0);
  fields.intensity.clear();
  fields.stamp_ns.clear();
}

Estimator::Estimator(const OdometryOptions& options)
    : options_(options),
      workers_(std::make_shared<const Workers>(options.threads)),
      predictor_(options),
      preparation_(options, workers_),
      matcher_(workers_),
      map_(options, workers_),
      rest_(options.rest),
      calibration_(options.calibration),
      beams_(options.calibration.estimate_beams),
      classifier_(options)
{
}

ScanResult Estimator::process(const LidarScan& scan, const ScanSpan& span, const ImuBuffer& imu)
{
  if (!started()) throw std::logic_error("Estimator::process: the filter has no state yet");
  const Stopwatch total;
  timings_ = {};
  ScanResult result;
  result.begin_ns = span.begin_ns;
  result.stamp_ns = span.end_ns;

  ScanPrediction predicted;
  workers_->alongside(
      [&] { predicted = predict(span, imu); },  // eq. 4-8
      [&] { downsample(scan, span.end_ns); });
  explainSilence(scan, span.end_ns, imu, predicted);
  map_.propagateError(predicted.transition);
  const DeskewedScan& deskewed = deskew(scan, span.end_ns, predicted.state.x);  // eq. 9-10
  Work work{scan, span.end_ns, deskewed, predicted, state_.filter.x};
  const bool enters = std::holds_alternative<EnteringMap>(mode_);
  const MapSearchResult matched = matchWithMap(work);  // eq. 12-20
  const MatchResult& match = matched.match;

  work.outcome.search = matched.poses;
  work.searched = enters || matched.poses;
  notePlace(matched, deskewed);
  work.outcome.after_outage = matched.after_outage;
  state_.stamp_ns = span.end_ns;
  adopt(match, work, result);
  compareMotion(matched, work, imu, result.statistics);
  noteSupport(match, work, result);
  applyZeroVelocityUpdate(statusOf(work.outcome, options_) == ScanStatus::Tracking, result);
  classifier_.classify(work.outcome, imu.inflations(), result);
  correctExtrinsic(result);
  insertIntoMap(work, result);  // eq. 21
  result.statistics.map_points = map_.surfaces().pointCount();
  widenAfterFirstScan(result.status, deskewed);
  releaseTimeOffset(result, deskewed);
  changeMode(result.status);

  timings_.total = total.milliseconds();
  result.milliseconds = timings_;
  return result;
}

FilterRun& Estimator::run()
{
  if (auto* relocalizing = std::get_if<Relocalizing>(&mode_)) return relocalizing->run;
  if (auto* entering = std::get_if<EnteringMap>(&mode_)) return entering->run;
  return std::get<Tracking>(mode_).run;
}

ScanPrediction Estimator::predict(const ScanSpan& span, const ImuBuffer& imu)
{
  const Stopwatch watch;
  ScanPrediction predicted = predictor_.predict(
      state_, span.begin_ns, span.end_ns, imu,
      [this](const Prediction& prediction) { return systematicCovariance(prediction); },
      run().trusted);
  predicted.blind_s = toSeconds(span.end_ns - state_.stamp_ns);
  const std::int64_t seen_ns = run().last_seen_ns;
  predicted.unseen_s = toSeconds(span.end_ns - seen_ns);
  considerUnmodelledAcceleration(
      predicted.state, predicted.unseen_s, toSeconds(state_.stamp_ns - seen_ns));
  timings_.propagate = watch.milliseconds();
  return predicted;
}

void Estimator::downsample(const LidarScan& scan, std::int64_t end_ns)
{
  const Stopwatch watch;
  std::size_t at_least = 0;
  if (run().startingAt(end_ns))
    at_least = static_cast<std::size_t>(run().motion_window->target_points);
  const auto* tracking = std::get_if<Tracking>(&mode_);
  const auto measuresVelocity = [&](const Tracking& mode)
  {
    if (mode.outage != nullptr) return !mode.outage->knowsVelocity();
    return isOutage(toSeconds(end_ns - mode.run.last_seen_ns));
  };
  if (tracking != nullptr && options_.recovery.enabled && measuresVelocity(*tracking))
    at_least = std::max(at_least, OutageSearch::kPoints);
  // The cost of eq. 18 grows with the cube of the points: ten thousand would take minutes.
  preparation_.downsample(scan, options_.gain == GainForm::Information ? at_least : 0);
  timings_.downsample = watch.milliseconds();
}

/** \param motion the state at the scan's end */
const DeskewedScan& Estimator::deskew(
    const LidarScan& scan, std::int64_t end_ns, const NavState& motion)
{
  const Stopwatch watch;
  const DeskewedScan& deskewed =
      preparation_.deskew(scan, end_ns, motion, predictor_.inputs(), beams_.corrections());
  timings_.deskew += watch.milliseconds();
  return deskewed;
}

/** Learns how well the scan supports the state, and what its status depends on. */
void Estimator::noteSupport(const MatchResult& match, Work& work, ScanResult& result)
{
  FilterRun& run = this->run();
  ScanStatistics& statistics = result.statistics;
  ScanOutcome& outcome = work.outcome;
  outcome.place = placeOf(mode_);
  outcome.map_was_empty = map_.empty();
  outcome.begins_map = map_.empty() && hasEnoughPoints(work.deskewed);
  outcome.updated = match.update.updated;
  // What the errors of map and calibration add is no number any more when a pose was lost for long.
  outcome.prediction_finite = work.predicted.finite && result.filter.P.allFinite();
  outcome.points = work.deskewed.surfaces.size();
  outcome.imu_gap_s = work.predicted.imu_gap_s;
  if (work.predicted.clock_stepped) statistics.clock_step = toSeconds(work.predicted.silent_ns);
  statistics.usual_inlier_ratio = map_.usualInlierRatio();
  // Without matches there is no evidence: what the scans before have shown goes on.
  if (outcome.begins_map || outcome.updated)
  {
    run.consistent = run.isTrial() || map_.isConsistent(statistics, outcome.points);
    if (run.consistent) run.last_update_ns = state_.stamp_ns;
    if (run.consistent && !outcome.map_was_empty) map_.learnInlierRatio(statistics, outcome.points);
  }
  outcome.unaided_s = toSeconds(state_.stamp_ns - run.last_update_ns);
  if (hasEnoughPoints(work.deskewed)) run.last_seen_ns = state_.stamp_ns;
  if (outcome.search && outcome.updated) statistics.searched_std = outcome.search->searched_std;
  outcome.position_std =
      std::sqrt(state_.filter.P.block<3, 3>(kPosition, kPosition).diagonal().maxCoeff());
}

/** At rest, v = 0 and w_m = b_w come on top of what the scan measured. */
void Estimator::applyZeroVelocityUpdate(bool matched, ScanResult& result)
{
  if (!options_.rest.enabled && !rest_.assumed()) return;
  FilterState& filter = state_.filter;
  RestEvidence evidence;
  evidence.stamp_ns = state_.stamp_ns;
  evidence.inertial = inertialMean(predictor_.inputs(), state_.stamp_ns);
  evidence.T_world_imu = filter.x.pose();
  evidence.velocity = filter.x.v;
  evidence.matched = matched;
  if (!rest_.update(evidence) || !(evidence.inertial.duration > 0.0)) return;

  const double gyro_noise =
      options_.imu.noise.gyro_noise_density / std::sqrt(evidence.inertial.duration);
  const auto update = zeroVelocityUpdate(
      filter, evidence.inertial.gyro, kZeroVelocityStd, std::hypot(gyro_noise, kZeroRateStd));
  if (!update)
  {
    rest_.reset();
    return;
  }
  filter = update->posterior;
  map_.correctError(update->gain);  // the map's error goes through the same correction
  report(result);
  result.statistics.at_rest = true;
}

void Estimator::changeMode(ScanStatus status)
{
  FilterRun& run = this->run();
  run.trusted = status != ScanStatus::Diverged;
  // Time without a map does not count.
  if (status == ScanStatus::Initializing) run.last_update_ns = state_.stamp_ns;
  const bool found = status == ScanStatus::Tracking || status == ScanStatus::FirstScan;
  if (found && relocalizing()) mode_ = Tracking{FilterRun(run), false, nullptr};
}

void Estimator::insertIntoMap(const Work& work, const ScanResult& result)
{
  const FilterState& filter = state_.filter;
  const CompensatedWith& compensation = work.deskewed.compensation;
  const FilterRun& run = this->run();
  const InsertionCandidate candidate{work.deskewed,       filter,
                                     result.status,       run.consistent,
                                     rest_.restingTime(), work.predicted.gap_rotation_std};
  if (!map_.accepts(candidate))
  {
    registered_.clear();
    return;
  }
  const Stopwatch watch;
  const BodyPoints& points = work.deskewed.surfaces;
  const Pose T_world_scan = scanPose(filter.x, compensation);
  registered_.points.resize(points.size());
  const auto transform = [&](std::size_t, std::size_t first, std::size_t last)
  { transformToWorld(points, T_world_scan, first, last, registered_.points); };
  workers_->forEachChunk(points.size(), transform);
  InsertionError error{filter.P, Matrix6::Zero()};
  if (run.startingAt(state_.stamp_ns)) error.distortion = run.motion_window->insertion_covariance;
  map_.prepareFor(work.deskewed, options_);
  map_.insert(
      work.deskewed, registered_.points, error, T_world_scan,
      scanPoseJacobian(filter.x, compensation), filter.x.p);
  beams_.recordInsertion(map_.insertions(), T_world_scan * work.scan.T_imu_lidar);
  preparation_.fieldsOf(work.scan, registered_.fields);
  timings_.insert = watch.milliseconds();
}

/** All scans of a start in motion share the errors of the map that the first one has created. */
void Estimator::widenAfterFirstScan(ScanStatus status, const DeskewedScan& scan)
{
  const std::optional<MotionWindow>& window = run().motion_window;
  if (status != ScanStatus::FirstScan || !window) return;
  state_.filter.P += window->covariance_after_first_scan;
  ambiguity_.beginInMotion(state_.filter.x, scan.compensation.angular_rate);
}

// From then on the offset is uncertain. The map becomes dense first: one that is still sparse could
// be made to fit a wrong offset. A start in motion cannot wait where rotation is fast: scans that
// are matched with a wrong offset leave errors in velocity, biases and map that no later scan takes
// for those of the offset. Maps that do not know the errors that neighbouring matches share are too
// sure of it.
void Estimator::releaseTimeOffset(const ScanResult& result, const DeskewedScan& scan)
{
  const CalibrationOptions& p = options_.calibration;
  FilterState& filter = state_.filter;
  const FilterRun& run = this->run();
  const bool released = filter.P(kTimeOffset, kTimeOffset) != 0.0;
  if (!p.estimate_time_offset || released || !map_.surfaces().knowsSharedErrors()) return;
  const bool tracks = result.status == ScanStatus::Tracking && run.consistent;
  const auto matched = static_cast<double>(result.statistics.points_effective);
  const bool dense =
      matched >= kTimeOffsetInlierRatio * static_cast<double>(scan.surfaces.size()) ||
      map_.insertions() >= kTimeOffsetInsertions;
  const bool settled = tracks && dense && !run.settlingAt(state_.stamp_ns);
  const bool cannot_wait =
      run.motion_window && (tracks || result.status == ScanStatus::FirstScan) &&
      turnsFast(scan.compensation.angular_rate.norm(), filter.x.v.norm(), p.time_offset_std);
  if (!settled && !cannot_wait) return;
  // A map that was begun at rest has no offset in it.
  StateVector hidden = StateVector::Unit(kTimeOffset);
  if (run.motion_window) hidden = hiddenByTimeOffset(filter.x, scan.compensation);
  hidden *= p.time_offset_std;
  filter.P += hidden * hidden.transpose();
}

}  // namespace fastlio
