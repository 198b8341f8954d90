// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/run/run_health.h>

#include <algorithm>

namespace fastlio
{
namespace
{
// Trouble that comes again within this time, or with the next scan, belongs to the same stretch.
constexpr double kStretchGap = 1.0;  // [s]
constexpr std::size_t kLeastScans = 3;
// A scan that was found from farther off may be at another place that looks the same [m].
constexpr double kUnambiguous = 0.3;
}  // namespace

void RunHealth::add(const ScanResult& result)
{
  if (seen_ == 0) begin_ns_ = result.begin_ns;
  end_ns_ = result.stamp_ns;
  const std::size_t index = seen_++;
  if (scans_ == 0 && result.status == ScanStatus::Initializing) return;
  ++scans_;
  tracked_ += result.status == ScanStatus::Tracking ? 1 : 0;
  first_scans_ += result.status == ScanStatus::FirstScan ? 1 : 0;
  sum_ += result.health.value;
  worst_ = std::min(worst_, result.health.value);
  if (result.health.value >= kTroubledHealth) return;
  ++troubled_;
  ++causes_[result.health.cause];
  extendStretch(result);
  if (first_) return;
  first_ = Trouble{index, result.stamp_ns, toSeconds(result.stamp_ns - begin_ns_), result.health};
}

void RunHealth::addLostEnd(std::int64_t until_ns, std::size_t scans, const std::string& reason)
{
  Growing& growing = stretchAt(end_ns_);
  UntrustedStretch& stretch = growing.stretch;
  stretch.end_ns = until_ns;
  stretch.end_s = toSeconds(until_ns - begin_ns_);
  stretch.scans += scans;
  stretch.cause = HealthCause::ScanTiming;
  stretch.reason = reason;
}

/** The stretch that goes on, or a new one. */
RunHealth::Growing& RunHealth::stretchAt(std::int64_t stamp_ns)
{
  const bool goes_on = !stretches_.empty() &&
                       (stretches_.back().last_scan + 1 >= seen_ ||
                        toSeconds(stamp_ns - stretches_.back().stretch.end_ns) <= kStretchGap);
  if (!goes_on)
  {
    stretches_.emplace_back();
    stretches_.back().stretch.begin_ns = stamp_ns;
    stretches_.back().stretch.begin_s = toSeconds(stamp_ns - begin_ns_);
  }
  stretches_.back().last_scan = seen_;
  return stretches_.back();
}

void RunHealth::extendStretch(const ScanResult& result)
{
  Growing& growing = stretchAt(result.stamp_ns);
  UntrustedStretch& stretch = growing.stretch;
  growing.grave = growing.grave || result.statistics.inertial_step ||
                  result.statistics.searched_std > kUnambiguous;
  stretch.end_ns = result.stamp_ns;
  stretch.end_s = toSeconds(result.stamp_ns - begin_ns_);
  ++stretch.scans;
  const ScanHealth& health = result.health;
  OfCause& of_cause = growing.causes[health.cause];
  ++of_cause.scans;
  if (health.value < of_cause.worst)
  {
    of_cause.worst = health.value;
    of_cause.reason = health.reason;
  }
  if (of_cause.scans > growing.causes[stretch.cause].scans) stretch.cause = health.cause;
  stretch.reason = growing.causes[stretch.cause].reason;
}

std::vector<UntrustedStretch> RunHealth::untrusted() const
{
  const bool has_no_pose = scans_ == 0 && seen_ > 0;
  if (has_no_pose || hasNoMap())
    return {
        {begin_ns_, end_ns_, 0.0, toSeconds(end_ns_ - begin_ns_), seen_, HealthCause::Starting,
         has_no_pose ? "no scan has a pose" : "no point of any scan joined the map"}};
  std::vector<UntrustedStretch> stretches;
  for (const Growing& growing : stretches_)
    if (growing.stretch.scans >= kLeastScans || growing.grave) stretches.push_back(growing.stretch);
  return stretches;
}

double RunHealth::mean() const
{
  return scans_ > 0 ? sum_ / static_cast<double>(scans_) : 0.0;
}

}  // namespace fastlio
