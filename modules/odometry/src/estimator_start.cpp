// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Starts of the estimator, and its state between scans.

#include "estimator.h"
#include "zero_velocity.h"
#include <fastlio/initialization/start_in_map.h>
#include <fastlio/math/time.h>

#include <limits>
#include <utility>

namespace fastlio
{
namespace
{
// After a re-initialisation the old map is searched for so long: fifteen scans at 10 Hz [s].
constexpr double kMapSearchTime = 1.5;
// What a scan that is matched can correct until the next one comes [m/s].
constexpr double kKnownVelocityStd = 1.0;

/** Who sways while standing turns faster than a zero-velocity update admits. */
bool standsStill(const FilterState& at_rest)
{
  return at_rest.P.diagonal().segment<3>(kGyroBias).maxCoeff() < kZeroRateStd * kZeroRateStd;
}

FilterRun startedRun(
    std::int64_t stamp_ns, bool trusted, const std::optional<MotionWindow>& motion_window)
{
  FilterRun run;
  run.last_update_ns = run.last_seen_ns = stamp_ns;
  run.trusted = trusted;
  run.motion_window = motion_window;
  return run;
}
}  // namespace

void Estimator::useMap(LocalMap map)
{
  map_ = std::move(map);
  beams_.forgetMap();
}

void Estimator::useSavedMap(const SavedMap& saved)
{
  useMap(LocalMap(options_, workers_, saved));
  mode_ = Initializing{Pose{saved.T_map_imu.R, saved.T_map_imu.p - saved.origin}};
}

void Estimator::start(
    const FilterState& state, std::int64_t stamp_ns,
    const std::optional<MotionWindow>& motion_window)
{
  if (options_.rest.at_start && !motion_window && standsStill(state)) rest_.assumeRest();
  FilterRun run = startedRun(stamp_ns, true, motion_window);
  const auto* initializing = std::get_if<Initializing>(&mode_);
  const std::optional<Pose> T_map_imu =
      initializing != nullptr ? initializing->T_map_imu : std::nullopt;
  const FilterState placed = T_map_imu ? placedInMap(state, *T_map_imu) : state;
  state_ = {placed, stamp_ns};
  map_.startCalibrationError(placed.x, options_.initialization.align_with_gravity);
  if (T_map_imu)
    mode_ = EnteringMap{std::move(run), *T_map_imu};
  else
    mode_ = Tracking{std::move(run), false, nullptr};
}

bool Estimator::canGoOn() const
{
  return started() && isFinite(state_.filter.x) && state_.filter.P.allFinite() &&
         state_.filter.P.block<3, 3>(kVelocity, kVelocity).diagonal().maxCoeff() <
             kKnownVelocityStd * kKnownVelocityStd;
}

void Estimator::goOnIn(const SavedMap& saved)
{
  useMap(LocalMap(options_, workers_, saved));
}

void Estimator::relocalize(const Pose& T_map_imu, double position_std, double yaw_std)
{
  skipScan();
  rest_.reset();
  agreement_.restart();
  ambiguity_ = {};  // the given pose says which of the places it is
  FilterState& filter = state_.filter;
  filter.x.p.setZero();
  filter = placedInMap(filter, T_map_imu);
  // Nothing that the run knew of its place counts.
  filter.P.middleRows<3>(kPosition).setZero();
  filter.P.middleCols<3>(kPosition).setZero();
  InitializationOptions guess = options_.initialization;
  guess.pose_position_std = position_std;
  guess.pose_yaw_std = yaw_std;
  filter = withUncertainPlace(filter, guess, 1.0);
  if (map_.isGiven())
    map_.startCalibrationError(filter.x, options_.initialization.align_with_gravity);
  mode_ = Relocalizing{
      startedRun(state_.stamp_ns, false, std::nullopt), std::numeric_limits<std::int64_t>::max()};
}

bool Estimator::keepsState() const
{
  return std::holds_alternative<Tracking>(mode_) && !map_.isGiven() && canGoOn();
}

bool Estimator::needsNewStart() const
{
  const auto* tracking = std::get_if<Tracking>(&mode_);
  return tracking != nullptr && tracking->lost && !map_.isGiven();
}

void Estimator::searchAroundPrediction()
{
  skipScan();
  mode_ = Relocalizing{
      startedRun(state_.stamp_ns, false, std::nullopt),
      state_.stamp_ns + toNanoseconds(kMapSearchTime)};
}

void Estimator::suspend(const NavState& believed)
{
  skipScan();
  rest_.reset();
  state_.filter.x.extrinsic_correction = believed.extrinsic_correction;
  state_.filter.x.time_offset = believed.time_offset;
  state_.stamp_ns = 0;
  const auto* entering = std::get_if<EnteringMap>(&mode_);
  mode_ =
      Initializing{entering != nullptr ? std::optional<Pose>(entering->T_map_imu) : std::nullopt};
}

void Estimator::reinitialise(
    const FilterState& start, std::int64_t stamp_ns,
    const std::optional<MotionWindow>& motion_window, const CarriedPose& carried)
{
  const auto* initializing = std::get_if<Initializing>(&mode_);
  const std::optional<Pose> T_map_imu =
      initializing != nullptr ? initializing->T_map_imu : std::nullopt;
  FilterRun run = startedRun(stamp_ns, false, motion_window);
  state_ = {startInCarriedWorld(start, carried), stamp_ns};
  const double search_time = carried.new_map ? 0.0 : kMapSearchTime;
  if (T_map_imu)
    mode_ = EnteringMap{std::move(run), *T_map_imu};
  else
    mode_ = Relocalizing{std::move(run), stamp_ns + toNanoseconds(search_time)};
}

void Estimator::skipScan()
{
  predictor_.clearImuRateStates();
  registered_.clear();
}

std::optional<ImuRateState> Estimator::stateAtNewestSample(const ImuBuffer& imu)
{
  if (!started() || !run().trusted) return std::nullopt;
  return predictor_.predictNewest(
      state_, imu,
      [this](const Prediction& prediction) { return systematicCovariance(prediction); });
}

std::int64_t Estimator::timeShift() const
{
  return toNanoseconds(state_.filter.x.time_offset);
}

void Estimator::applyCalibration(LidarScan& scan, ScanSpan& span) const
{
  const std::int64_t shift_ns = timeShift();
  scan.stamp_ns += shift_ns;
  span.begin_ns += shift_ns;
  span.end_ns += shift_ns;
  scan.T_imu_lidar = state_.filter.x.extrinsic_correction * scan.T_imu_lidar;
}

}  // namespace fastlio
