// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "odometry_impl.h"

#include <fastlio/math/time.h>
#include <fastlio/odometry/parameter_yaml.h>
#include <fastlio/parallel/stack_anchor.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{

const Parameters& validated(const Parameters& parameters)
{
  validate(parameters);
  return parameters;
}
}  // namespace

Odometry::Impl::Impl(const Parameters& parameters)
    : parameters_(validated(parameters)),
      pipeline_(parameters),
      conditioner_(parameters.imu, parameters.initialization.gravity),
      intake_(parameters.imu.max_gap, parameters.lidar.max_waiting),
      start_finder_(parameters),
      health_(parameters.health)
{
}

void Odometry::Impl::addImu(const ImuSample& sample)
{
  ++statistics_.imu_in;
  if (!sample.gyro.allFinite() || !sample.accel.allFinite())
  {
    ++statistics_.imu_not_finite;
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
    breaks_.push_back({sample.stamp_ns, sample.stamp_ns, true});
  }
  if (conditioned.after_break && !imu_.empty())
    breaks_.push_back({imu_.newestStamp(), sample.stamp_ns, false});
  if (conditioned.inflation) imu_.addInflation(*conditioned.inflation);
  switch (imu_.add(sample))
  {
    case ImuBuffer::Verdict::Accepted:
      break;
    case ImuBuffer::Verdict::NotFinite:
      ++statistics_.imu_not_finite;
      break;
    case ImuBuffer::Verdict::OutOfOrder:
      ++imu_out_of_order_;
      break;
    case ImuBuffer::Verdict::Duplicate:
      ++statistics_.imu_duplicate;
      break;
  }
}

void Odometry::Impl::addScan(LidarScan scan)
{
  ++statistics_.scans_in;
  if (scan.points.size() == 0)
  {
    ++statistics_.scans_empty;
    return;
  }
  if (!isTime(scan.stamp_ns))
  {
    ++scans_without_time_;
    return;
  }
  scan.stamp_ns += toNanoseconds(parameters_.lidar.time_offset);
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
  statistics_.imu_spikes = imu.spikes;
  statistics_.imu_bad_stamps = imu.bad_stamps;
  statistics_.imu_out_of_order = imu_out_of_order_ + imu.late;
  statistics_.scans_out_of_order = scans_out_of_order_ + intake_.late();
  statistics_.scans_bad_stamp = scans_without_time_ + intake_.badStamps();
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
  if (missing_s > parameters_.imu.max_gap || span.end_ns <= pipeline_.stamp())
  {
    ++(missing_s > 0.0 ? statistics_.scans_without_imu : scans_out_of_order_);
    return false;
  }
  return true;
}

std::optional<ScanResult> Odometry::Impl::processOldest()
{
  QueuedScan queued = popScan();
  pipeline_.applyCalibration(queued.scan, queued.span);
  if (!usable(queued.span)) return std::nullopt;
  ScanResult result = pipeline_.process(queued.scan, queued.span, imu_);
  health_.judge(imu_.inflations(), result);
  imu_.forgetBefore(queued.span.end_ns);
  noticeLoss(result);
  return result;
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
    if (!pipeline_.started())
    {
      if (auto waiting = waitForStart(at_end)) return waiting;
      if (!pipeline_.started()) break;
      continue;
    }
    if (scans.front().span.end_ns + pipeline_.timeShift() > imu_.newestStamp() && !at_end) break;
    if (auto result = processOldest()) return result;
  }
  return std::nullopt;
}

std::optional<ImuRateState> Odometry::Impl::stateAtNewestSample()
{
  const StackAnchor anchor;
  if (imu_.empty() || !pipeline_.started()) return std::nullopt;
  return pipeline_.stateAtNewestSample(imu_);
}

}  // namespace fastlio
