// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scan_pipeline.h"

#include "calibration_prior.h"
#include "health_monitor.h"
#include "map_factory.h"
#include "prediction.h"
#include "start_in_map.h"
#include <fastlio/math/stopwatch.h>
#include <fastlio/math/time.h>

#include <Eigen/Eigenvalues>
#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr int kSharesAveraged = 50;  // scans

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
    : parameters_(parameters),
      workers_(std::make_shared<const Workers>(parameters.threads)),
      map_(makeSurfaceMap(parameters, workers_)),
      edges_(parameters),
      update_(parameters_, workers_),
      rest_(parameters.rest),
      planes_(workers_),
      selector_(parameters.lidar, parameters.downsampling, parameters.features, workers_),
      deskewer_(workers_)
{
}

void ScanPipeline::start(const FilterState& state, std::int64_t stamp_ns, const YoungMap& young_map)
{
  young_map_ = young_map;
  time_offset_released_ = false;
  if (parameters_.rest.at_start && !young_map.in_motion) rest_.assumeRest();
  filter_ = state;
  if (start_in_map_) filter_ = placedInMap(state, *start_in_map_);
  filter_ = withCalibrationPrior(filter_, parameters_.calibration);
  constrainGravity();
  state_ns_ = stamp_ns;
  last_update_ns_ = stamp_ns;
}

void ScanPipeline::constrainGravity()
{
  const InitializationOptions& p = parameters_.initialization;
  if (p.gravity_model == GravityModel::Sphere) filter_ = withGravityOnSphere(filter_, p.gravity);
}

ScanResult ScanPipeline::process(const LidarScan& scan, const ScanSpan& span, const ImuBuffer& imu)
{
  const Stopwatch total;
  timings_ = {};
  ScanResult result;
  result.begin_ns = span.begin_ns;
  result.stamp_ns = span.end_ns;
  FilterState predicted;
  const double blind_s = toSeconds(span.end_ns - state_ns_);
  workers_->alongside(
      [&] { predicted = propagateTo(span.end_ns, imu); },  // eq. 4-8
      [&] { downsample(scan, span.end_ns); });
  considerUnmodelledAcceleration(predicted, blind_s);
  compensate(scan, span, predicted);  // eq. 9-10
  if (recovering_ && span.end_ns > recovery_end_ns_) beginNewMap();
  const UpdateResult update = start_in_map_ ? findInMap(predicted)
                              : recovering_ ? findMap(predicted)
                                            : matchOrSearch(predicted);  // eq. 12-20
  describeUpdate(update, result.statistics);
  filter_ = update.posterior;
  filter_.x.R = normalizeRotation(filter_.x.R);  // products of rotations drift off SO(3)
  constrainGravity();
  state_ns_ = span.end_ns;
  result.filter = considerMapError(update.gain);
  result.map_share = (result.filter.P - filter_.P).topLeftCorner<6, 6>();
  judge(update, result);
  if (start_in_map_)
    tellNotFound(result);
  else if (recovering_)
    judgeRecovery(result);
  else
    reportSearch(result);
  if (parameters_.rest.enabled || rest_.assumed()) considerRest(result);
  pose_trusted_ = result.status != ScanStatus::Diverged;
  if (mayGrowMap(result))
    growMap(scan, result.filter);  // eq. 21
  else
    forgetPoints();
  if (result.status == ScanStatus::FirstScan) filter_.P += young_map_.open_after_first_scan;
  releaseTimeOffset(result);
  describeScan(scan, result.statistics);
  timings_.total = total.milliseconds();
  result.milliseconds = timings_;
  return result;
}

void ScanPipeline::skipScan()
{
  imu_rate_.clear();
  forgetPoints();
}

void ScanPipeline::describeScan(const LidarScan& scan, ScanStatistics& statistics) const
{
  statistics.points_in = scan.points.size();
  statistics.dropped_invalid = scan.dropped_invalid + selection_.dropped_invalid;
  statistics.dropped_near = selection_.dropped_near;
  statistics.dropped_far = selection_.dropped_far;
  statistics.points_downsampled = selection_.indices.size() + edge_indices_.size();
  statistics.imu_samples = inputs_.size();
  statistics.map_points = map_->pointCount();
  statistics.constraints = update_.constraints();
}

void ScanPipeline::downsample(const LidarScan& scan, std::int64_t end_ns)
{
  const Stopwatch watch;
  // The cost of eq. 18 grows with the cube of the points: ten thousand would take minutes.
  const bool young = end_ns <= young_map_.until_ns && parameters_.gain == GainForm::Information;
  const std::size_t at_least = young ? static_cast<std::size_t>(young_map_.target_points) : 0;
  selector_.select(scan.points, at_least, selection_, edge_indices_);
  timings_.downsample = watch.milliseconds();
}

std::optional<ImuRateState> ScanPipeline::stateAtNewestSample(const ImuBuffer& imu)
{
  const std::int64_t stamp_ns = imu.newestStamp();
  if (!pose_trusted_ || stamp_ns <= state_ns_) return std::nullopt;
  imu.inputsBetween(state_ns_, stamp_ns, parameters_.imu.hold, inputs_);
  const auto [s, transition] = propagateThrough(
      filter_, inputs_, stamp_ns, parameters_.imu.noise, imu.inflations(),
      [](std::int64_t, const Prediction&) {});
  if (!isFinite(s.x) || !s.P.allFinite()) return std::nullopt;
  return imuRateState(stamp_ns, s, map_error_.additionAfter(transition), imu);
}

FilterState ScanPipeline::propagateTo(std::int64_t end_ns, const ImuBuffer& imu)
{
  const Stopwatch watch;
  imu_gap_s_ = toSeconds(imu.longestGap(state_ns_, end_ns));
  imu.inputsBetween(state_ns_, end_ns, parameters_.imu.hold, inputs_);
  imu_rate_.clear();
  auto [s, transition] = propagateThrough(
      filter_, inputs_, end_ns, parameters_.imu.noise, imu.inflations(),
      [&](std::int64_t stamp_ns, const Prediction& prediction)
      {
        if (!parameters_.output.imu_rate || !pose_trusted_) return;
        const StateMatrix map_share = map_error_.additionAfter(prediction.transition);
        const auto at_sample = imuRateState(stamp_ns, prediction.state, map_share, imu);
        if (at_sample) imu_rate_.push_back(*at_sample);
      });
  // Absurd but finite inertial samples may overflow; such a number never enters the state.
  prediction_finite_ = isFinite(s.x) && s.P.allFinite();
  if (!prediction_finite_)
  {
    s = filter_;
    transition.setIdentity();
    imu_rate_.clear();
  }
  map_error_.propagate(transition);
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
    deskewer_.deskew(scan, selection_.indices, knots_, compensated_.points);
    deskewer_.deskew(scan, edge_indices_, knots_, edges_.points());
  }
  else
  {
    deskewer_.transformToBody(scan, selection_.indices, compensated_.points);
    deskewer_.transformToBody(scan, edge_indices_, edges_.points());
  }
  compensated_.compensation = compensationWith(predicted.x, span.end_ns);
  timings_.deskew = watch.milliseconds();
}

UpdateResult ScanPipeline::updateWithScan(const FilterState& predicted)
{
  const Stopwatch watch;
  UpdateResult update = update_.run(predicted, compensated_, *map_, edges_);
  timings_.associate = update_.associationMilliseconds();
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
  ScanStatistics& s = result.statistics;
  s.usual_share = usual_share_;
  // Without matches there is no evidence: what the scans before have shown goes on.
  if (result.status != ScanStatus::PredictionOnly)
    evidence_good_ = !parameters_.health.freeze_map || insertions_ < kYoungMapInsertions ||
                     evidenceIsGood(s, compensated_.points.size(), parameters_.health);
  if (result.status != ScanStatus::PredictionOnly && evidence_good_) last_update_ns_ = state_ns_;
  if (result.status == ScanStatus::Tracking && evidence_good_) learnUsualShare(s);

  const double unaided_s = toSeconds(state_ns_ - last_update_ns_);
  const double position_std =
      std::sqrt(filter_.P.block<3, 3>(kPosition, kPosition).diagonal().maxCoeff());
  if (!prediction_finite_ || unaided_s > parameters_.measurement.max_unaided_time)
    result.status = ScanStatus::Diverged;
  if (imu_gap_s_ > parameters_.imu.max_gap)
    result.message = mrpt::format(
        "%.2f s without inertial samples (imu.max_gap is %.2f s): bridged with the last rate and "
        "acceleration",
        imu_gap_s_, parameters_.imu.max_gap);
  if (result.status == ScanStatus::Diverged && update.updated)
    result.message = mrpt::format(
        "%zu of %zu points match the map with a mean z^2/r of %.2f, which is no convincing match "
        "(health.min_share); the last one was %.2f s ago",
        update.last.count, compensated_.points.size(), s.normalized_innovation, unaided_s);
  else if (result.status == ScanStatus::PredictionOnly || result.status == ScanStatus::Diverged)
    result.message = mrpt::format(
        "%zu of %zu points match the map, at least %i are needed "
        "(measurement.min_effective_points); "
        "%.2f s on inertial data alone, position uncertain by %.3f m%s",
        update.last.count, compensated_.points.size(), parameters_.measurement.min_effective_points,
        unaided_s, position_std,
        prediction_finite_ ? "" : "; the inertial data overflowed the prediction");
}

/** What share of the points matches depends on the place: nearly all in a room, few on a meadow. */
void ScanPipeline::learnUsualShare(const ScanStatistics& statistics)
{
  shares_ = std::min(shares_ + 1, kSharesAveraged);
  const double share = static_cast<double>(statistics.points_effective) /
                       static_cast<double>(std::max<std::size_t>(compensated_.points.size(), 1));
  usual_share_ += (share - usual_share_) / shares_;
}

FilterState ScanPipeline::considerMapError(const ScanGain& gain)
{
  LinearizedUpdate update;
  update.T_world_scan = scanPose(filter_.x, compensated_.compensation);
  update.by_state = scanPoseJacobian(filter_.x, compensated_.compensation);
  update.constrained = update_.constraints().projection;
  update.gain = gain;
  map_error_.update(
      update,
      planes_.group(
          update.T_world_scan, compensated_.points, update_.matches(), update_.residualModel()));
  FilterState total = filter_;
  total.P += map_error_.addition();
  return total;
}

}  // namespace fastlio
