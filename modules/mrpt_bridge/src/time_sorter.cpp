// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "time_sorter.h"

#include <fastlio/mrpt_bridge/conversions.h>

namespace
{
// Bounds memory where stamps stand still: 0.2 s of a 1 kHz IMU and a LiDAR stay far below.
constexpr std::size_t kMostHeld = 2000;
}  // namespace

namespace fastlio
{
void TimeSorter::push(mrpt::obs::CObservation::Ptr observation)
{
  newest_ns_ = toNanoseconds(observation->timestamp);
  held_.push({newest_ns_, sequence_++, std::move(observation)});
}

bool TimeSorter::ready() const
{
  if (held_.empty()) return false;
  return newest_ns_ - held_.top().stamp_ns >= window_ns_ || held_.size() > kMostHeld;
}

mrpt::obs::CObservation::Ptr TimeSorter::pop()
{
  auto observation = held_.top().observation;
  held_.pop();
  return observation;
}

}  // namespace fastlio
