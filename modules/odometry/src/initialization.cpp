// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "initialization.h"

#include <mrpt/core/format.h>

#include <algorithm>

namespace fastlio
{
namespace
{
// A window that does not rest moves on by this share of its length.
constexpr double kWindowStep = 0.1;
}  // namespace

InitializationOutcome tryStaticStart(
    ImuBuffer& imu, const InitializationParameters& parameters, std::int64_t first_scan_begin_ns)
{
  InitializationOutcome outcome;
  const auto duration_ns = static_cast<std::int64_t>(parameters.duration * 1e9);
  const auto step_ns =
      std::max<std::int64_t>(static_cast<std::int64_t>(kWindowStep * parameters.duration * 1e9), 1);
  const std::int64_t latest_ns = std::max(imu.oldestStamp(), first_scan_begin_ns - duration_ns);
  if (imu.newestStamp() < latest_ns + duration_ns)
  {
    outcome.message = mrpt::format(
        "collecting the resting start: %.2f of %.2f s (initialization.duration)",
        static_cast<double>(imu.newestStamp() - latest_ns) * 1e-9, parameters.duration);
    return outcome;
  }
  // The later the window, the less is left to inertial data alone until the first scan.
  for (std::int64_t begin_ns = latest_ns; begin_ns >= imu.oldestStamp(); begin_ns -= step_ns)
  {
    const std::int64_t end_ns = begin_ns + duration_ns;
    const RestStatistics rest = restStatistics(imu.samplesBetween(begin_ns, end_ns));
    const auto reason = whyNotAtRest(rest, parameters);
    if (!reason)
    {
      outcome.state = initialState(rest, parameters);
      outcome.stamp_ns = std::clamp(first_scan_begin_ns, begin_ns, end_ns);
      return outcome;
    }
    if (begin_ns == latest_ns) outcome.message = *reason;
  }
  // All of them, so that the search goes on behind a gap longer than its step.
  imu.forgetSamplesBefore(latest_ns + step_ns);
  outcome.rejected = true;
  return outcome;
}

}  // namespace fastlio
