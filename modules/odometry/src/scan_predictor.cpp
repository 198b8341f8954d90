// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scan_predictor.h"

#include <fastlio/math/time.h>

namespace fastlio
{
ScanPrediction ScanPredictor::predict(
    const StampedState& from, std::int64_t end_ns, const ImuBuffer& imu,
    const SystematicCovariance& systematic, bool trusted)
{
  imu.inputsBetween(from.stamp_ns, end_ns, imu_.hold, inputs_);
  imu.forEachSample(
      from.stamp_ns + 1, end_ns, [this](const ImuSample& sample) { noise_.add(sample); });
  imu_rate_.clear();
  const Prediction propagated = propagateThrough(
      from.filter, inputs_, end_ns, noise_.atLeast(imu_.noise), imu.inflations(),
      [&](std::int64_t stamp_ns, const Prediction& prediction)
      {
        if (!imu_rate_wanted_ || !trusted) return;
        const auto at_sample =
            imuRateState(stamp_ns, prediction.state, systematic(prediction), imu);
        if (at_sample) imu_rate_.push_back(*at_sample);
      });
  ScanPrediction result;
  result.imu_gap_s = toSeconds(imu.longestGap(from.stamp_ns, end_ns));
  result.gap_rotation_std = rotationStdInGaps(imu.inflations(), from.stamp_ns, end_ns);
  // Absurd but finite inertial samples may overflow; such a number never enters the state.
  result.finite = isFinite(propagated.state.x) && propagated.state.P.allFinite();
  result.state = result.finite ? propagated.state : from.filter;
  if (result.finite)
    result.transition = propagated.transition;
  else
    imu_rate_.clear();
  return result;
}

std::optional<ImuRateState> ScanPredictor::predictNewest(
    const StampedState& from, const ImuBuffer& imu, const SystematicCovariance& systematic)
{
  const std::int64_t stamp_ns = imu.newestStamp();
  if (stamp_ns <= from.stamp_ns) return std::nullopt;
  imu.inputsBetween(from.stamp_ns, stamp_ns, imu_.hold, inputs_);
  const Prediction p = propagateThrough(
      from.filter, inputs_, stamp_ns, noise_.atLeast(imu_.noise), imu.inflations(),
      [](std::int64_t, const Prediction&) {});
  if (!isFinite(p.state.x) || !p.state.P.allFinite()) return std::nullopt;
  return imuRateState(stamp_ns, p.state, systematic(p), imu);
}

}  // namespace fastlio
