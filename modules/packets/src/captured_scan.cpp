// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "packet_numbers.h"
#include <fastlio/packets/captured_scan.h>
#include <fastlio/recordings/cloud_builder.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
constexpr std::int64_t kLatenessNs = 1'000'000;  // packets of a scan may overtake each other
constexpr int kHalfTurn = 18'000, kBack = -100;  // [0.01 deg]: the azimuth has come round
constexpr std::int64_t kMrptTickNs = 100;        // the resolution of MRPT's stamps
}  // namespace

bool CapturedScan::comesRound(int azimuth)
{
  const int turned = azimuth - std::exchange(azimuth_, azimuth);
  return turned < kBack || turned > kHalfTurn;
}

void CapturedScan::beginBlock(std::int64_t stamp_ns, bool anew, ObservationQueue& out)
{
  const std::int64_t age_ns = stamp_ns - origin_ns_;
  const bool jump = age_ns < -kLatenessNs || age_ns >= longest_ns_;
  if (begun_ && (anew || jump || columns_.size() > kMostPointsPerScan)) flush(out);
  if (!begun_) origin_ns_ = stamp_ns;
  begun_ = true;
  block_after_ns_ = static_cast<double>(stamp_ns - origin_ns_);
}

void CapturedScan::add(const CapturedPoint& point, double after_ns)
{
  columns_.x.push_back(static_cast<float>(point.x));
  columns_.y.push_back(static_cast<float>(point.y));
  columns_.z.push_back(static_cast<float>(point.z));
  columns_.intensity.push_back(point.intensity);
  columns_.ring.push_back(point.ring);
  columns_.time.push_back(block_after_ns_ + after_ns);
}

void CapturedScan::flush(ObservationQueue& out)
{
  if (!begun_) return;
  begun_ = false;
  const auto first = std::min_element(columns_.time.begin(), columns_.time.end());
  const double first_ns = first == columns_.time.end() ? 0.0 : *first;
  auto stamp_ns = origin_ns_ + static_cast<std::int64_t>(std::floor(first_ns));
  stamp_ns -= stamp_ns % kMrptTickNs;
  const auto stamp_after_ns = static_cast<double>(stamp_ns - origin_ns_);
  for (double& time : columns_.time)
    time = 1e-9 * std::round(time - stamp_after_ns);
  auto cloud = makeCloud(columns_, label_, stamp_ns);
  cloud->setSensorPose(T_sensor_lidar_);
  out.push_back(std::move(cloud));
  columns_ = {};
}

}  // namespace fastlio
