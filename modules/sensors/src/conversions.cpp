// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/sensors/conversions.h>

#include <Eigen/Core>
#include <mrpt/math/CMatrixFixed.h>

#include <algorithm>
#include <chrono>

namespace
{
using Ticks = mrpt::Clock::duration;
constexpr std::int64_t kNanosecondsPerTick = 100;
// 146 years on either side of 1970. Stamps beyond, as INVALID_TIMESTAMP or corrupt ones are, become
// the nearest of these: any two stamps can then be subtracted without overflow.
constexpr std::int64_t kMaxTicks = 46'000'000'000'000'000;
static_assert(std::chrono::nanoseconds(Ticks(1)).count() == kNanosecondsPerTick);

// MRPT counts from the year 1601.
std::int64_t unixEpochTicks()
{
  static const std::int64_t ticks = mrpt::Clock::fromDouble(0.0).time_since_epoch().count();
  return ticks;
}
}  // namespace

namespace fastlio
{
std::int64_t toNanoseconds(const mrpt::Clock::time_point& stamp)
{
  const std::int64_t epoch = unixEpochTicks();
  const std::int64_t ticks =
      std::clamp(stamp.time_since_epoch().count(), epoch - kMaxTicks, epoch + kMaxTicks);
  return (ticks - epoch) * kNanosecondsPerTick;
}

mrpt::Clock::time_point toMrptTime(std::int64_t stamp_ns)
{
  const std::int64_t half = stamp_ns < 0 ? -kNanosecondsPerTick / 2 : kNanosecondsPerTick / 2;
  return mrpt::Clock::time_point(Ticks((stamp_ns + half) / kNanosecondsPerTick + unixEpochTicks()));
}

Pose toPose(const mrpt::poses::CPose3D& T_a_b)
{
  return {T_a_b.getRotationMatrix().asEigen(), {T_a_b.x(), T_a_b.y(), T_a_b.z()}};
}

mrpt::poses::CPose3D toMrptPose(const Pose& T_a_b)
{
  return {T_a_b.R, T_a_b.p};
}

}  // namespace fastlio
