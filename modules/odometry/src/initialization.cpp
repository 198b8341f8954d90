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
  const std::int64_t begin_ns = imu.oldestStamp();
  const std::int64_t end_ns = begin_ns + static_cast<std::int64_t>(parameters.duration * 1e9);
  if (imu.newestStamp() < end_ns)
  {
    outcome.message = mrpt::format(
        "collecting the resting start: %.2f of %.2f s (initialization.duration)",
        static_cast<double>(imu.newestStamp() - begin_ns) * 1e-9, parameters.duration);
    return outcome;
  }
  const RestStatistics rest = restStatistics(imu.samplesUntil(end_ns));
  if (const auto reason = whyNotAtRest(rest, parameters))
  {
    const auto step_ns = static_cast<std::int64_t>(kWindowStep * parameters.duration * 1e9);
    imu.forgetBefore(begin_ns + std::max<std::int64_t>(step_ns, 1));
    outcome.rejected = true;
    outcome.message = *reason;
    return outcome;
  }
  outcome.state = initialState(rest, parameters);
  outcome.stamp_ns = std::clamp(first_scan_begin_ns, begin_ns, end_ns);
  return outcome;
}

}  // namespace fastlio
