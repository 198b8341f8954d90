// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "time_sorter.h"

#include <fastlio/sensors/conversions.h>

namespace
{
// Bounds memory where stamps stand still: 0.2 s of a 1 kHz IMU and a LiDAR stay far below.
constexpr std::size_t kMostHeld = 2000;
// No observation is so late by being slow.
constexpr std::int64_t kStepBackNs = 5'000'000'000;
}  // namespace

namespace fastlio
{
void TimeSorter::push(mrpt::obs::CObservation::Ptr observation)
{
  const std::int64_t stamp_ns = toNanoseconds(observation->timestamp);
  if (sequence_ > 0 && stamp_ns < newest_ns_ - kStepBackNs) ++epoch_;
  newest_ns_ = stamp_ns;
  held_.push({epoch_, newest_ns_, sequence_++, std::move(observation)});
}

bool TimeSorter::ready() const
{
  if (held_.empty()) return false;
  if (held_.top().epoch != epoch_) return true;
  return newest_ns_ - held_.top().stamp_ns >= window_ns_ || held_.size() > kMostHeld;
}

mrpt::obs::CObservation::Ptr TimeSorter::pop()
{
  auto observation = held_.top().observation;
  held_.pop();
  return observation;
}

}  // namespace fastlio
