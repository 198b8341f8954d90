// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "map_factory.h"
#include <fastlio/localmap/local_map.h>
#include <fastlio/localmap/map_search.h>
#include <fastlio/matching/match_evidence.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
// So many scans of a map do not match much yet.
constexpr std::uint32_t kSparseMapInsertions = 20;
constexpr int kRatiosAveraged = 50;  // scans
// At rest for longer, scans do not join: they repeat what the map knows, and their noise adds up.
constexpr double kMaxRestingTime = 3.0;  // [s]
// A scan without matches joins below this position error: half of the finest voxels.
constexpr double kMaxInsertionStd = 0.2;  // [m]
// A scan that may be distorted by more than 2 cm at 10 m does not join.
constexpr double kMostDistortion = 0.002;  // [rad]

EdgeMapOptions edgeMapOptions(const OdometryOptions& parameters)
{
  EdgeMapOptions options;
  options.point_noise = parameters.measurement.range_noise;
  return options;
}

}  // namespace

LocalMap::LocalMap(const OdometryOptions& options, std::shared_ptr<const Workers> workers)
    : update_given_(options.map.update),
      radius_(options.map.radius),
      surfaces_(makeSurfaceMap(options, workers, false)),
      edges_(edgeMapOptions(options)),
      workers_(std::move(workers))
{
}

LocalMap::LocalMap(
    const OdometryOptions& options, std::shared_ptr<const Workers> workers, const SavedMap& saved)
    : update_given_(options.map.update),
      radius_(options.map.radius),
      surfaces_(makeSurfaceMap(options, workers, saved)),
      edges_(edgeMapOptions(options)),
      workers_(std::move(workers)),
      insertions_(surfaces_->insertionCount()),
      given_(true)
{
  // Its errors are those of the world itself.
  error_.recordInsertion(0, InsertionError{}, Pose{});
}

LocalMap LocalMap::successor(
    const OdometryOptions& options, std::shared_ptr<const Workers> workers) const
{
  LocalMap next(options, std::move(workers));
  next.error_ = error_;
  next.error_.forgetMap();
  next.calibration_ = calibration_;
  next.calibration_.forgetMap();
  next.succeeds_ = true;
  return next;
}

void LocalMap::propagateError(const ErrorTransition& transition)
{
  error_.propagate(transition);
  calibration_.propagate(transition);
}

void LocalMap::correctError(const MotionGain& K)
{
  error_.correct(K);
  calibration_.correct(K);
}

ConsideredUpdate LocalMap::considerUpdate(
    const DeskewedScan& scan, const MatchResult& match, const LinearizedUpdate& update,
    BeamErrors& beams, bool beams_learn)
{
  const MeasuredScan& measured = *match.measured;
  const GroupedMeasurements* grouped = nullptr;
  // A scan that may be distorted shows nothing of its beams, whose errors move it as little as its
  // points do. The sampled scans have the weight 1.
  const double weight = match.model.weight;
  workers_->alongside(
      [&]
      {
        if (beams_learn && weight == 1.0)
          beams.add(update.T_world_scan, scan, measured, *match.matches);
      },
      [&] { grouped = &groups_.group(*workers_, measured, *match.matches); });
  ConsideredUpdate considered;
  workers_->alongside(
      [&] { considered.by_calibration = calibration_.update(update, *grouped); },
      [&]
      {
        const BeamPulls pulls = weight * beams.pulls(update.T_world_scan.R);
        considered.map_mismatch = error_.update(update, *grouped, pulls);
      });
  return considered;
}

void LocalMap::prepareFor(const DeskewedScan& scan, const OdometryOptions& options)
{
  if (insertions_ == 0 && scan.sparse_lines) surfaces_ = makeSurfaceMap(options, workers_, true);
}

bool LocalMap::isConsistent(const ScanStatistics& statistics, std::size_t points) const
{
  if (isSparse()) return true;
  // Where a direction is open, nothing pulls the scan to a wall that shows it again.
  if (statistics.normalized_innovation > kWrongPoseInnovation) return false;
  return matchesAsUsual(statistics, points) || fitsWhatIsMapped(statistics);
}

void LocalMap::learnInlierRatio(const ScanStatistics& statistics, std::size_t points)
{
  ratios_ = std::min(ratios_ + 1, kRatiosAveraged);
  usual_inlier_ratio_ += (inlierRatio(statistics, points) - usual_inlier_ratio_) / ratios_;
  usual_fitting_part_ +=
      (inlierRatio(statistics, statistics.points_mapped) - usual_fitting_part_) / ratios_;
}

bool LocalMap::accepts(const InsertionCandidate& candidate) const
{
  if (candidate.status == ScanStatus::Initializing || (given_ && !update_given_)) return false;
  if (candidate.resting_time > kMaxRestingTime) return false;
  if (empty() && candidate.status != ScanStatus::FirstScan && !succeeds_) return false;
  if (!candidate.consistent) return false;  // a scan that is lost must not spoil the map
  if (candidate.distortion_std > kMostDistortion) return false;
  if (candidate.status == ScanStatus::Tracking || candidate.status == ScanStatus::FirstScan)
    return true;
  if (candidate.status == ScanStatus::Diverged) return false;
  // Where the map has few planes it must grow, as long as the prediction knows where the scan is.
  const Matrix6 covariance = scanPoseCovariance(candidate.filter, candidate.scan.compensation);
  const Vec3 position_variance = covariance.diagonal().tail<3>() - begun_variance_;
  return position_variance.maxCoeff() < std::pow(kMaxInsertionStd, 2);
}

bool LocalMap::isSparse() const
{
  return insertions_ < kSparseMapInsertions;
}

void LocalMap::insert(
    const DeskewedScan& scan, const WorldPoints& surfaces, const InsertionError& error,
    const Pose& T_world_scan, const ScanPoseJacobian& by_state, const Vec3& center)
{
  error_.recordInsertion(++insertions_, error, T_world_scan, by_state);
  calibration_.recordInsertion(insertions_, T_world_scan, by_state);
  surfaces_->insertFrom(surfaces, T_world_scan * scan.T_imu_lidar);
  if (!given_) surfaces_->removeOutside(center, radius_);
  world_edges_.resize(scan.edges.size());
  transformToWorld(scan.edges, T_world_scan, 0, scan.edges.size(), world_edges_);
  edges_.insert(world_edges_);
  edges_.removeOutside(T_world_scan.p, radius_);
}

}  // namespace fastlio
