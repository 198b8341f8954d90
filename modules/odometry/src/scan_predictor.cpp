// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "scan_predictor.h"

#include <fastlio/filter/state.h>
#include <fastlio/math/time.h>

#include <algorithm>

namespace fastlio
{
namespace
{
/** How long both sensors were silent between a state and a scan; 0: they were not. A clock that is
 * set takes the same time from both, while a LiDAR may rest between two scans. */
std::int64_t silenceBefore(std::int64_t begin_ns, std::int64_t from_ns, const ImuBuffer& imu)
{
  if (rotationStdInGaps(imu.inflations(), from_ns, begin_ns) == 0.0) return 0;
  const std::int64_t lidar_ns = begin_ns - from_ns, imu_ns = imu.longestGap(from_ns, begin_ns);
  return 2 * lidar_ns > imu_ns ? std::min(lidar_ns, imu_ns) : 0;
}

/** \param walk CalibrationOptions::time_offset_walk */
void letClocksWander(FilterState& state, double walk, double seconds)
{
  double& variance = state.P(kTimeOffset, kTimeOffset);
  if (variance > 0.0) variance += walk * walk * seconds;  // 0: the offset is not estimated
}
}  // namespace

Prediction ScanPredictor::fromTo(
    const FilterState& from, std::int64_t begin_ns, std::int64_t end_ns, const ImuBuffer& imu)
{
  imu.inputsBetween(begin_ns, end_ns, imu_.hold, aside_);
  return propagateThrough(
      from, aside_, end_ns, noise_.atLeast(imu_.noise), imu.inflations(),
      [](std::int64_t, const Prediction&) {});
}

/** All the motion that bridges a silence has not been if the clock was set: that is one more error
 * of unknown size. */
FilterState ScanPredictor::admitClockStep(
    const StampedState& from, std::int64_t silent_ns, const ImuBuffer& imu)
{
  FilterState admitted = from.filter;
  if (silent_ns == 0) return admitted;
  const NavState bridged =
      fromTo(from.filter, from.stamp_ns, from.stamp_ns + silent_ns, imu).state.x;
  if (!isFinite(bridged)) return admitted;
  const StateVector motion = boxminus(bridged, from.filter.x);
  admitted.P += motion * motion.transpose();
  return admitted;
}

ScanPrediction ScanPredictor::afterClockStep(
    const StampedState& from, std::int64_t end_ns, const ImuBuffer& imu,
    const ScanPrediction& with_silence)
{
  ScanPrediction stepped = with_silence;
  const Prediction p = fromTo(from.filter, from.stamp_ns + with_silence.silent_ns, end_ns, imu);
  stepped.clock_stepped = true;
  stepped.state = p.state;
  stepped.transition = p.transition;
  stepped.finite = isFinite(p.state.x) && p.state.P.allFinite();
  return stepped;
}

void ScanPredictor::addToRatesInGap(std::int64_t end_ns, const ImuBuffer& imu, const Vec3& rate)
{
  for (std::size_t i = 0; i < inputs_.size(); ++i)
  {
    const std::int64_t stop_ns = i + 1 < inputs_.size() ? inputs_[i + 1].stamp_ns : end_ns;
    if (rotationStdInGaps(imu.inflations(), inputs_[i].stamp_ns, stop_ns) > 0.0)
      inputs_[i].gyro += rate;
  }
}

ScanPrediction ScanPredictor::withRateInGap(
    const StampedState& from, std::int64_t end_ns, const ImuBuffer& imu, const Vec3& rate_error,
    const ScanPrediction& with_gap)
{
  ScanPrediction corrected = with_gap;
  addToRatesInGap(end_ns, imu, rate_error);
  rate_in_gap_.correct(rate_error);
  const Prediction p = propagateThrough(
      from.filter, inputs_, end_ns, noise_.atLeast(imu_.noise), imu.inflations(),
      [](std::int64_t, const Prediction&) {});
  corrected.state.x = p.state.x;
  corrected.finite = with_gap.finite && isFinite(p.state.x);
  return corrected;
}

ScanPrediction ScanPredictor::predict(
    const StampedState& from, std::int64_t begin_ns, std::int64_t end_ns, const ImuBuffer& imu,
    const SystematicCovariance& systematic, bool trusted)
{
  const std::int64_t silent_ns = silenceBefore(begin_ns, from.stamp_ns, imu);
  FilterState start = admitClockStep(from, silent_ns, imu);
  letClocksWander(start, clock_walk_, toSeconds(end_ns - from.stamp_ns));
  imu.inputsBetween(from.stamp_ns, end_ns, imu_.hold, inputs_);
  if (rotationStdInGaps(imu.inflations(), from.stamp_ns, end_ns) == 0.0) rate_in_gap_ = {};
  addToRatesInGap(end_ns, imu, rate_in_gap_.correction());
  imu.forEachSample(
      from.stamp_ns + 1, end_ns, [this](const ImuSample& sample) { noise_.add(sample); });
  imu_rate_.clear();
  const Prediction propagated = propagateThrough(
      start, inputs_, end_ns, noise_.atLeast(imu_.noise), imu.inflations(),
      [&](std::int64_t stamp_ns, const Prediction& prediction)
      {
        if (!imu_rate_wanted_ || !trusted) return;
        const auto at_sample =
            imuRateState(stamp_ns, prediction.state, systematic(prediction), imu);
        if (at_sample) imu_rate_.push_back(*at_sample);
      });
  ScanPrediction result;
  result.silent_ns = silent_ns;
  result.imu_gap_s = toSeconds(imu.longestGap(from.stamp_ns, end_ns));
  result.gap_rotation_std = rotationStdInGaps(imu.inflations(), begin_ns, end_ns);
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
  const Prediction p = fromTo(from.filter, from.stamp_ns, stamp_ns, imu);
  if (!isFinite(p.state.x) || !p.state.P.allFinite()) return std::nullopt;
  return imuRateState(stamp_ns, p.state, systematic(p), imu);
}

}  // namespace fastlio
