// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/live/arrival_clock.h>

#include <cstdlib>

namespace fastlio
{
namespace
{
constexpr std::int64_t kHour = 3'600'000'000'000;  // [ns]
constexpr std::int64_t kJump = 1'000'000'000;      // more than any delay: the clock was set [ns]
constexpr std::int64_t kDrift = 10'000;            // of this many nanoseconds the clocks lose one
}  // namespace

std::int64_t ArrivalClock::stampOf(std::int64_t sensor_ns, std::int64_t arrival_ns)
{
  if (last_ns_ && sensor_ns < *last_ns_ - kHour / 2) wrapped_ns_ += kHour;
  const std::int64_t continuous_ns = sensor_ns + wrapped_ns_;
  const std::int64_t offset_ns = arrival_ns - continuous_ns;
  const std::int64_t allowed_ns = offset_ns_ + (arrival_ns - offset_since_ns_) / kDrift;
  if (!last_ns_ || std::abs(offset_ns - offset_ns_) > kJump || offset_ns < allowed_ns)
  {
    offset_ns_ = offset_ns;
    offset_since_ns_ = arrival_ns;
  }
  last_ns_ = sensor_ns;
  return continuous_ns + offset_ns_ + (arrival_ns - offset_since_ns_) / kDrift;
}

}  // namespace fastlio
