// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "odometry_impl.h"

#include <fastlio/math/angles.h>
#include <fastlio/math/so3.h>
#include <fastlio/math/time.h>
#include <fastlio/odometry/odometry_option_table.h>
#include <fastlio/parallel/stack_anchor.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
// Beyond so many standard deviations, of the estimate and of what was given, an error is odd.
constexpr double kOddDeviations = 5.0;

bool isOdd(const Vec3& error, const Vec3& std, double given_std)
{
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(error[axis]) > kOddDeviations * std::max(std[axis], given_std)) return true;
  return false;
}

const OdometryOptions& validated(const OdometryOptions& parameters)
{
  validate(parameters);
  return parameters;
}
}  // namespace

Odometry::Impl::Impl(const OdometryOptions& options)
    : options_(validated(options)),
      estimator_(options),
      conditioner_(options.imu, options.initialization.gravity),
      beam_corrections_(options.lidar.beam_offsets),
      intake_(options.imu.max_gap, options.lidar.max_waiting),
      start_finder_(options),
      reinitialization_(options)
{
}

void Odometry::Impl::startIn(const SavedMap& map)
{
  estimator_.useSavedMap(map);
  map_origin_ = map.origin;
}

std::optional<ScanResult> Odometry::Impl::handedOver(std::optional<ScanResult> result)
{
  if (result) counted_.scans_after_result = intake_.queue().size();
  if (map_origin_.isZero()) return result;
  if (result) result->filter.x.p += map_origin_;
  imu_rate_in_world_ = estimator_.imuRateStates();
  for (ImuRateState& state : imu_rate_in_world_)
    state.x.p += map_origin_;
  return result;
}

const std::vector<ImuRateState>& Odometry::Impl::imuRateStates() const
{
  return map_origin_.isZero() ? estimator_.imuRateStates() : imu_rate_in_world_;
}

void Odometry::Impl::addImu(const ImuSample& sample)
{
  ++counted_.imu_in;
  if (!sample.gyro.allFinite() || !sample.accel.allFinite())
  {
    ++counted_.imu_not_finite;
    return;
  }
  take(conditioner_.add(sample));
}

void Odometry::Impl::take(const std::vector<ConditionedSample>& samples)
{
  for (const ConditionedSample& sample : samples)
    take(sample);
  for (Diagnostic& found : conditioner_.takeDiagnostics())
    diagnostics_.push_back(std::move(found));
  intake_.reconsider(conditioner_.clockOffset());
}

void Odometry::Impl::take(const ConditionedSample& conditioned)
{
  const ImuSample& sample = conditioned.sample;
  if (conditioned.rescale_gyro != 1.0)
  {
    imu_.scaleGyro(conditioned.rescale_gyro);
    reinitialization_.addBreak({sample.stamp_ns, sample.stamp_ns, true});
  }
  if (conditioned.after_break && !imu_.empty())
    reinitialization_.addBreak({imu_.newestStamp(), sample.stamp_ns, false});
  if (conditioned.inflation) imu_.addInflation(*conditioned.inflation);
  switch (imu_.add(sample))
  {
    case ImuBuffer::Verdict::Accepted:
      break;
    case ImuBuffer::Verdict::NotFinite:
      ++counted_.imu_not_finite;
      break;
    case ImuBuffer::Verdict::OutOfOrder:
      ++counted_.imu_out_of_order;
      break;
    case ImuBuffer::Verdict::Duplicate:
      ++counted_.imu_duplicate;
      break;
  }
}

void Odometry::Impl::addScan(LidarScan scan)
{
  ++counted_.scans_in;
  ++counted_.scans_after_result;
  if (scan.points.size() == 0)
  {
    ++counted_.scans_empty;
    return;
  }
  if (!isTime(scan.stamp_ns))
  {
    ++counted_.scans_bad_stamp;
    return;
  }
  if (const auto median = range_unit_.bringToMetres(scan.points))
    report(
        scan.stamp_ns, mrpt::format(
                           "the points of the LiDAR are %.0f away in the median: they are taken as "
                           "millimetres, not metres",
                           *median));
  scan.stamp_ns += toNanoseconds(options_.lidar.time_offset);
  const auto inertial_ns =
      imu_.empty() ? std::nullopt : std::optional<std::int64_t>(imu_.newestStamp());
  intake_.add(std::move(scan), conditioner_.clockOffset(), inertial_ns);
}

void Odometry::Impl::finishInputs()
{
  take(conditioner_.finish());
  intake_.finish();
}

const InputStatistics& Odometry::Impl::inputStatistics()
{
  const ImuReport imu = conditioner_.report();
  statistics_ = counted_;
  statistics_.imu_spikes = imu.spikes;
  statistics_.imu_bad_stamps = imu.bad_stamps;
  statistics_.imu_out_of_order += imu.late;
  statistics_.scans_out_of_order += intake_.late();
  statistics_.scans_bad_stamp += intake_.badStamps();
  if (!imu_.empty()) statistics_.newest_imu_ns = imu_.newestStamp();
  return statistics_;
}

QueuedScan Odometry::Impl::popScan()
{
  QueuedScan scan = std::move(intake_.queue().front());
  intake_.queue().pop_front();
  return scan;
}

bool Odometry::Impl::usable(const ScanSpan& span)
{
  const double missing_s = toSeconds(span.end_ns - imu_.newestStamp());
  if (missing_s > options_.imu.max_gap || span.end_ns <= estimator_.stamp())
  {
    ++(missing_s > 0.0 ? counted_.scans_without_imu : counted_.scans_out_of_order);
    return false;
  }
  return true;
}

std::optional<ScanResult> Odometry::Impl::processOldest()
{
  QueuedScan queued = popScan();
  estimator_.applyCalibration(queued.scan, queued.span);
  if (!usable(queued.span)) return std::nullopt;
  beam_corrections_.apply(queued.scan.points);
  ScanResult result = estimator_.process(queued.scan, queued.span, imu_);
  imu_.forgetBefore(queued.span.end_ns);
  const auto loss =
      reinitialization_.detectTrackingLoss(result, estimator_.state(), estimator_.relocalizing());
  if (loss) reinitialise(*loss, result.stamp_ns);
  reportMounting(result);
  reportExtrinsic(result);
  reportMotion(result);
  return result;
}

void Odometry::Impl::reportMounting(const ScanResult& result)
{
  const std::optional<MountingError>& error = result.statistics.mounting_error;
  if (mounting_reported_ || !error || error->leastAngle() < kMaxMountingError) return;
  mounting_reported_ = true;
  const Vec3 turn = kDegPerRad * logSO3(error->R_true_given);
  report(
      result.stamp_ns,
      mrpt::format(
          "the mounting of the LiDAR seems to be wrong by %.1f deg or more: turned by (%.1f, %.1f, "
          "%.1f) deg about the axes of the IMU it would explain what both sensors see; "
          "check the sensor poses of the recording, input.T_vehicle_lidar and input.T_vehicle_imu",
          kDegPerRad * error->angle, turn.x(), turn.y(), turn.z()));
}

/** Below what makes a scan one in trouble: real sensors may be as imperfect. */
void Odometry::Impl::reportMotion(const ScanResult& result)
{
  const double innovation = result.statistics.unexplained_motion_innovation;
  if (motion_reported_ || mounting_reported_ || innovation < kMaxMotionInnovation) return;
  motion_reported_ = true;
  report(
      result.stamp_ns,
      mrpt::format(
          "scans and inertial data see different motions, %.0f times as far apart as their noise "
          "explains; a mounting (T_imu_lidar) or inertial sensor that is slightly off explains a "
          "part of it, and the covariance counts that. Otherwise: check units, point times, clocks "
          "and clipped or missing inertial readings",
          innovation));
}

/** Smaller than what reportMounting() sees, and after a longer time. */
void Odometry::Impl::reportExtrinsic(const ScanResult& result)
{
  const CalibrationCheck& check = result.statistics.calibration;
  const CalibrationOptions& given = options_.calibration;
  const bool turned = isOdd(check.rotation, check.rotation_std, given.extrinsic_rotation_std);
  const bool moved =
      isOdd(check.translation, check.translation_std, given.extrinsic_translation_std);
  if (extrinsic_reported_ || mounting_reported_ || (!turned && !moved)) return;
  extrinsic_reported_ = true;
  const Vec3 rotation = kDegPerRad * check.rotation, rotation_std = kDegPerRad * check.rotation_std;
  const Vec3 translation = 1e3 * check.translation, translation_std = 1e3 * check.translation_std;
  report(
      result.stamp_ns,
      mrpt::format(
          "the pose of the LiDAR in the IMU frame seems to be wrong: turned by (%.2f +- %.2f, %.2f "
          "+- %.2f, %.2f +- %.2f) deg, moved by (%.0f +- %.0f, %.0f +- %.0f, %.0f +- %.0f) mm; the "
          "covariance counts this, the trajectory does not. Check input.T_vehicle_lidar and "
          "input.T_vehicle_imu, or set calibration.extrinsic_rotation_std and "
          "extrinsic_translation_std to what is known of them",
          rotation.x(), rotation_std.x(), rotation.y(), rotation_std.y(), rotation.z(),
          rotation_std.z(), translation.x(), translation_std.x(), translation.y(),
          translation_std.y(), translation.z(), translation_std.z()));
}

std::optional<ScanResult> Odometry::Impl::next(bool at_end)
{
  const StackAnchor anchor;
  if (at_end) finishInputs();
  if (auto given_up = giveUpOldest(at_end)) return given_up;
  if (imu_.empty()) return std::nullopt;
  const ScanQueue& scans = intake_.queue();
  while (!scans.empty())
  {
    if (auto in_gap = passBreaks()) return in_gap;
    if (scans.empty()) break;
    if (!estimator_.started())
    {
      if (auto waiting = waitForStart(at_end)) return waiting;
      if (!estimator_.started()) break;
      continue;
    }
    if (scans.front().span.end_ns + estimator_.timeShift() > imu_.newestStamp() && !at_end) break;
    if (auto result = processOldest()) return result;
  }
  return std::nullopt;
}

std::optional<ImuRateState> Odometry::Impl::stateAtNewestSample()
{
  const StackAnchor anchor;
  if (imu_.empty() || !estimator_.started()) return std::nullopt;
  auto state = estimator_.stateAtNewestSample(imu_);
  if (state && !map_origin_.isZero()) state->x.p += map_origin_;
  return state;
}

}  // namespace fastlio
