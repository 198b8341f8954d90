// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "reinitialization.h"

#include <fastlio/matching/match_evidence.h>
#include <fastlio/matching/match_result.h>
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

namespace fastlio
{
namespace
{
// Scans match nothing for so long after measurement.max_unaided_time: no passing obstruction [s].
constexpr double kPatience = 1.0;

bool isFiniteState(const FilterState& state)
{
  return isFinite(state.x) && state.P.allFinite();
}
}  // namespace

double InertialBreak::seconds() const
{
  return toSeconds(end_ns - begin_ns);
}

Reinitialization::Reinitialization(const OdometryOptions& options) : options_(options) {}

OdometryOptions Reinitialization::startingAnyHow(OdometryOptions options)
{
  options.initialization.mode = InitializationMode::Auto;
  return options;
}

std::optional<InertialBreak> Reinitialization::breakBefore(std::int64_t end_ns)
{
  while (!breaks_.empty())
  {
    const InertialBreak& gap = breaks_.front();
    const std::int64_t bridged_ns = gap.new_map ? 0 : toNanoseconds(options_.imu.max_gap);
    const std::int64_t known_ns = knownUntil(gap);
    if (gap.new_map || gap.end_ns - known_ns > bridged_ns)
    {
      if (end_ns <= known_ns + bridged_ns) return std::nullopt;
      return gap;
    }
    if (end_ns <= gap.end_ns) return std::nullopt;
    breaks_.pop_front();
  }
  return std::nullopt;
}

std::int64_t Reinitialization::knownUntil(const InertialBreak& gap) const
{
  return gap.new_map ? gap.begin_ns : std::max(gap.begin_ns, last_good_ns_);
}

bool Reinitialization::isNeededAt(const InertialBreak& gap) const
{
  return options_.recovery.enabled || gap.new_map;
}

std::string Reinitialization::decideAt(const InertialBreak& gap, const FilterState& state)
{
  if (last_good_ && (gap.new_map || last_good_ns_ > gap.begin_ns))
    decide({*last_good_, last_good_ns_, gap.new_map});
  else
    decide({state, gap.begin_ns, gap.new_map});
  if (gap.new_map) return "the unit of the gyro was wrong";
  return mrpt::format(
      "%.2f s without inertial samples (imu.max_gap is %.2f s)", gap.seconds(),
      options_.imu.max_gap);
}

std::optional<std::string> Reinitialization::detectTrackingLoss(
    const ScanResult& result, const FilterState& state, bool relocalizing, bool in_vain)
{
  const ScanStatistics& s = result.statistics;
  if (result.status == ScanStatus::FirstScan ||
      (result.status == ScanStatus::Tracking && matchesAsUsual(s, s.points_downsampled)))
  {
    last_good_ = state;
    last_good_ns_ = result.stamp_ns;
    went_on_ = false;
  }
  if (in_vain && options_.recovery.enabled && isFiniteState(state))
  {
    decide({state, result.stamp_ns, false});
    return "the map was searched in vain";
  }
  if (result.status != ScanStatus::Diverged || relocalizing ||
      s.points_downsampled < kMinEffectivePoints)
  {
    lost_since_ns_ = 0;
    return std::nullopt;
  }
  if (lost_since_ns_ == 0) lost_since_ns_ = result.stamp_ns;
  const double lost_s = toSeconds(result.stamp_ns - lost_since_ns_);
  if (!options_.recovery.enabled || lost_s < kPatience) return std::nullopt;
  const double unaided_s = toSeconds(result.stamp_ns - last_good_ns_);
  if (isFiniteState(state) || !last_good_)
    decide({state, result.stamp_ns, false});
  else
    decide({*last_good_, last_good_ns_, false});
  return mrpt::format("no scan has matched the map for %.1f s", unaided_s);
}

bool Reinitialization::goesOn(bool state_is_known)
{
  if (!state_is_known || went_on_) return false;
  went_on_ = true;
  last_believed_.reset();
  return true;
}

void Reinitialization::decide(const BelievedState& last)
{
  last_believed_ = last;
  lost_since_ns_ = 0;
}

CarriedPose Reinitialization::takeCarried(std::int64_t start_ns)
{
  const BelievedState& last = *last_believed_;
  CarriedPose carried = carriedOver(last.state, toSeconds(start_ns - last.stamp_ns));
  carried.new_map = last.new_map;
  last_believed_.reset();
  return carried;
}

}  // namespace fastlio
