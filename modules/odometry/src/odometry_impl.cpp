// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "odometry_impl.h"

#include <fastlio/interface/odometry_option_table.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/so3.h>
#include <fastlio/math/time.h>
#include <fastlio/parallel/stack_anchor.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace fastlio
{
namespace
{
const OdometryOptions& validated(const OdometryOptions& parameters)
{
  validate(parameters);
  return parameters;
}
}  // namespace

Odometry::Impl::Impl(const OdometryOptions& options)
    : options_(validated(options)),
      estimator_(options),
      diagnostics_(options),
      conditioner_(options.imu, options.initialization.gravity),
      beam_corrections_(options.lidar.beam_offsets),
      intake_(options.imu.max_gap, options.lidar.max_waiting),
      start_finder_(options),
      reinitialization_(options)
{
}

void Odometry::Impl::startIn(const SavedMap& map)
{
  if (map.empty())
    throw std::invalid_argument("Odometry::startIn: the map has no points; was it saved?");
  if (estimator_.started() || reinitialization_.pending())
    throw std::logic_error("Odometry::startIn: call it before the first scan.");
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
    diagnostics_.report(found.stamp_ns, std::move(found.text));
  intake_.reconsider(conditioner_.clockOffset());
}

void Odometry::Impl::take(const ConditionedSample& conditioned)
{
  const ImuSample& sample = conditioned.sample;
  if (conditioned.rescale_gyro != 1.0)
  {
    imu_.scaleGyro(conditioned.rescale_gyro);
    diagnostics_.forgetScatter();
    reinitialization_.addBreak({sample.stamp_ns, sample.stamp_ns, true});
  }
  if (conditioned.after_break && !imu_.empty())
    reinitialization_.addBreak({imu_.newestStamp(), sample.stamp_ns, false});
  if (conditioned.inflation) imu_.addInflation(*conditioned.inflation);
  switch (imu_.add(sample))
  {
    case ImuBuffer::Verdict::Accepted:
      diagnostics_.consider(sample);
      if (sample_callback_) sample_callback_(sample);
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
  if (const auto finding = range_unit_.bringToMetres(scan.points))
    diagnostics_.report(scan.stamp_ns, describe(*finding));
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

bool Odometry::Impl::usable(const ScanSpan& span, bool is_repeated)
{
  const double missing_s = toSeconds(span.end_ns - imu_.newestStamp());
  if (missing_s > options_.imu.max_gap || span.end_ns <= estimator_.stamp() || is_repeated)
  {
    ++(missing_s > 0.0 ? counted_.scans_without_imu : counted_.scans_out_of_order);
    return false;
  }
  return true;
}

std::optional<ScanResult> Odometry::Impl::processOldest()
{
  // By the recorded stamps: with a new estimate of the clocks' offset it would seem to be newer.
  const bool is_repeated = intake_.oldestIsRepeated();
  QueuedScan queued = intake_.takeOldest();
  estimator_.applyCalibration(queued.scan, queued.span);
  if (!usable(queued.span, is_repeated)) return std::nullopt;
  beam_corrections_.apply(queued.scan.points);
  own_body_.look(queued.scan.points);
  const std::size_t masked = own_body_.mask(queued.scan.points);
  ScanResult result = estimator_.process(queued.scan, queued.span, imu_);
  result.statistics.points_in += masked;
  result.statistics.dropped_own_body = masked;
  judgeOwnBody(result, queued.scan.T_imu_lidar);
  imu_.forgetBefore(queued.span.end_ns);
  const bool in_vain = estimator_.needsNewStart();
  const auto loss = reinitialization_.detectTrackingLoss(
      result, estimator_.state(), estimator_.relocalizing(), in_vain);
  if (loss && !in_vain && reinitialization_.goesOn(estimator_.keepsState()))
  {
    estimator_.searchAroundPrediction();
    diagnostics_.report(
        result.stamp_ns, *loss + ": the pose is searched where the inertial data have it");
  }
  else if (loss)
    reinitialise(*loss, result.stamp_ns);
  diagnostics_.consider(result);
  return result;
}

void Odometry::Impl::judgeOwnBody(const ScanResult& result, const Pose& T_imu_lidar)
{
  own_body_.judge(result.filter.x.pose() * T_imu_lidar, result.status == ScanStatus::Tracking);
  const auto place = own_body_.takeReport();
  if (!place) return;
  diagnostics_.report(
      result.stamp_ns,
      mrpt::format(
          "the LiDAR sees what carries it: returns %.2f to %.2f m away move with it, around the "
          "azimuth %.0f deg in its frame; they are left out from here on",
          place->nearest, place->farthest, kDegPerRad * place->azimuth));
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
