// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "time_sorter.h"

#include <fastlio/math/time.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

namespace
{
// Bound memory where stamps stand still: 0.2 s of a 1 kHz IMU and of several LiDARs stay far below.
constexpr std::size_t kMostHeld = 2000, kMostPointsHeld = 10'000'000;
// No observation is so late by being slow.
constexpr std::int64_t kStepBackNs = 5'000'000'000;

std::size_t pointsIn(const mrpt::obs::CObservation& observation)
{
  constexpr std::size_t kPerPacket = std::size_t{12} * 32;
  if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation))
    return cloud->pointcloud ? cloud->pointcloud->size() : 0;
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservationVelodyneScan*>(&observation))
    return kPerPacket * scan->scan_packets.size() + scan->point_cloud.size();
  if (const auto* scan = dynamic_cast<const mrpt::obs::CObservationRotatingScan*>(&observation))
    return std::size_t{scan->rowCount} * scan->columnCount;
  return 0;
}
}  // namespace

namespace fastlio
{
void TimeSorter::push(mrpt::obs::CObservation::Ptr observation)
{
  const std::int64_t stamp_ns = toNanoseconds(observation->timestamp);
  if (sequence_ > 0 && stamp_ns < newest_ns_ - kStepBackNs) ++epoch_;
  newest_ns_ = stamp_ns;
  const std::size_t points = pointsIn(*observation);
  points_ += points;
  held_.push({epoch_, newest_ns_, sequence_++, points, std::move(observation)});
}

bool TimeSorter::ready() const
{
  if (held_.empty()) return false;
  if (held_.top().epoch != epoch_ || !isTime(held_.top().stamp_ns)) return true;
  return newest_ns_ - held_.top().stamp_ns >= window_ns_ || held_.size() > kMostHeld ||
         points_ > kMostPointsHeld;
}

mrpt::obs::CObservation::Ptr TimeSorter::pop()
{
  auto observation = held_.top().observation;
  points_ -= held_.top().points;
  held_.pop();
  return observation;
}

}  // namespace fastlio
