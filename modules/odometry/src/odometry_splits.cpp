// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Starts of the odometry: the first one, and those after the run was split.

#include "odometry_impl.h"
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
// A scan may begin a little before the inertial data do: a sample holds before its stamp, too.
constexpr std::int64_t kHoldBeforeNs = 20'000'000;
constexpr double kUpsideDown = -0.5;  // z of the upward direction in the IMU frame
constexpr std::size_t kMostRemarks = 1000;

ScanResult waitingResult(const QueuedScan& queued, const std::string& why)
{
  ScanResult waiting;
  waiting.begin_ns = queued.span.begin_ns;
  waiting.stamp_ns = queued.span.end_ns;
  waiting.statistics.points_in = queued.scan.points.size();
  waiting.message = why;
  waiting.health = {0.0, HealthCause::Starting, why};
  return waiting;
}

void markLost(ScanResult& result)
{
  result.status = ScanStatus::Diverged;
  result.health.cause = HealthCause::Lost;
}

/** A run that is split starts anew in whatever way is possible. */
Parameters startingAnyHow(Parameters parameters)
{
  parameters.initialization.mode = InitializationMode::Auto;
  return parameters;
}

bool isFinite(const FilterState& state)
{
  return fastlio::isFinite(state.x) && state.P.allFinite();
}
}  // namespace

void Odometry::Impl::diagnostic(std::int64_t stamp_ns, std::string text)
{
  if (diagnostics_.size() < kMostRemarks) diagnostics_.push_back({stamp_ns, std::move(text)});
}

void Odometry::Impl::start(const StartDecision& decision)
{
  const NavState& x = decision.state->x;
  if (carried_)
  {
    pipeline_.restart(*decision.state, decision.stamp_ns, decision.young_map, *carried_);
    carried_.reset();
    diagnostic(decision.stamp_ns, "started anew, with the pose carried over");
    return;
  }
  pipeline_.start(*decision.state, decision.stamp_ns, decision.young_map);
  const Vec3 up = -(x.R.transpose() * x.g).normalized();
  if (up.z() < kUpsideDown)
    diagnostic(
        decision.stamp_ns,
        mrpt::format(
            "the IMU is mounted upside down (up is [%.2f %.2f %.2f] in its frame), which is fine; "
            "if it is not, the accelerometer's sign is inverted (imu.invert_acceleration)",
            up.x(), up.y(), up.z()));
}

std::optional<ScanResult> Odometry::Impl::waitForStart(bool at_end)
{
  while (!intake_.queue().empty() && !pipeline_.started())
  {
    const StartDecision decision = start_finder_.decide(intake_.queue(), imu_, at_end);
    if (decision.drop_oldest)
      return waitingResult(popScan(), (carried_ ? "starting anew: " : "") + decision.message);
    if (!decision.state) break;
    start(decision);
  }
  return std::nullopt;
}

bool Odometry::Impl::waitsTooLong(std::int64_t end_ns) const
{
  const auto limit_ns = toNanoseconds(parameters_.lidar.max_waiting);
  const ScanQueue& scans = intake_.queue();
  // Scans still farther ahead have wrong stamps, as likely as not.
  return std::any_of(
      scans.begin(), scans.end(),
      [&](const QueuedScan& s)
      {
        const std::int64_t later_ns = s.span.end_ns - end_ns;
        return later_ns > limit_ns && later_ns <= 2 * limit_ns;
      });
}

/** Scans that no inertial sample reaches must not pile up. */
std::optional<ScanResult> Odometry::Impl::giveUpOldest(bool at_end)
{
  const ScanQueue& scans = intake_.queue();
  if (scans.empty()) return std::nullopt;
  const std::int64_t end_ns = scans.front().span.end_ns;
  if (!imu_.empty() && end_ns <= imu_.newestStamp()) return std::nullopt;
  const bool never = at_end && imu_.empty();
  if (!never && !waitsTooLong(end_ns)) return std::nullopt;
  const double waits_s = toSeconds(scans.back().span.end_ns - end_ns);
  pipeline_.skipScan();
  const bool after_start = pipeline_.started() || carried_;
  ScanResult result = waitingResult(
      popScan(),
      (imu_.empty() ? "no inertial sample has arrived" : "the inertial data have ended") +
          std::string(", but scans of ") + std::to_string(waits_s) +
          " s have after this one (lidar.max_waiting); is the IMU running, does it share "
          "the LiDAR's clock (lidar.time_offset)?");
  if (after_start) markLost(result);
  return result;
}

/** Splits the run where the oldest scan has reached a break. \return a scan that nothing is known
 * about */
std::optional<ScanResult> Odometry::Impl::passBreaks()
{
  const auto bridged_ns = toNanoseconds(parameters_.imu.max_gap);
  const std::int64_t time_shift_ns = pipeline_.timeShift();
  while (!breaks_.empty())
  {
    const Break gap = breaks_.front();
    const ScanSpan span = intake_.queue().front().span;
    const std::int64_t reach_ns = gap.new_map ? 0 : bridged_ns;
    if (span.end_ns + time_shift_ns <= gap.begin_ns + reach_ns) break;
    const double gap_s = toSeconds(gap.end_ns - gap.begin_ns);
    if (pipeline_.started() && (parameters_.recovery.enabled || gap.new_map))
    {
      const FilterState& last = gap.new_map && last_good_ ? *last_good_ : pipeline_.state();
      CarriedPose carried = carriedOver(last, gap_s, parameters_.recovery);
      carried.new_map = gap.new_map;
      split(
          carried,
          gap.new_map ? "the unit of the gyro was wrong"
                      : mrpt::format(
                            "%.2f s without inertial samples (imu.max_gap is %.2f s)", gap_s,
                            parameters_.imu.max_gap),
          gap.begin_ns);
    }
    else if (!pipeline_.started() && !carried_ && parameters_.recovery.enabled)
      start_finder_ = StartFinder(startingAnyHow(parameters_));  // rest may not come again
    if (!pipeline_.started())
    {
      imu_.forgetSamplesBefore(gap.end_ns);
      if (span.begin_ns + time_shift_ns < gap.end_ns - kHoldBeforeNs)
      {
        ScanResult result = waitingResult(
            popScan(), mrpt::format(
                           "within %.2f s without inertial samples (imu.max_gap is %.2f s)", gap_s,
                           parameters_.imu.max_gap));
        if (carried_) markLost(result);
        return result;
      }
    }
    breaks_.pop_front();
  }
  return std::nullopt;
}

void Odometry::Impl::split(
    const CarriedPose& carried, const std::string& why, std::int64_t stamp_ns)
{
  carried_ = carried;
  pipeline_.suspend();
  start_finder_ = StartFinder(startingAnyHow(parameters_));
  lost_since_ns_ = 0;
  diagnostic(stamp_ns, "the run is split: " + why);
}

/** A pose that is lost although the scans see enough is given up. */
void Odometry::Impl::noticeLoss(const ScanResult& result)
{
  const ScanStatistics& s = result.statistics;
  const auto needed = static_cast<std::size_t>(parameters_.measurement.min_effective_points);
  if (result.status == ScanStatus::FirstScan ||
      (result.status == ScanStatus::Tracking &&
       evidenceIsGood(s, s.points_downsampled, parameters_.health)))
  {
    last_good_ = pipeline_.state();
    last_good_ns_ = result.stamp_ns;
  }
  if (result.status != ScanStatus::Diverged || pipeline_.recovering() ||
      s.points_downsampled < needed)
  {
    lost_since_ns_ = 0;
    return;
  }
  if (lost_since_ns_ == 0) lost_since_ns_ = result.stamp_ns;
  const double lost_s = toSeconds(result.stamp_ns - lost_since_ns_);
  if (!parameters_.recovery.enabled || lost_s < parameters_.recovery.patience) return;
  const FilterState& now = pipeline_.state();
  const double unaided_s = toSeconds(result.stamp_ns - last_good_ns_);
  const CarriedPose carried = isFinite(now) || !last_good_
                                  ? carriedOver(now, 0.0, parameters_.recovery)
                                  : carriedOver(*last_good_, unaided_s, parameters_.recovery);
  split(
      carried, mrpt::format("no scan has matched the map for %.1f s", unaided_s), result.stamp_ns);
}

}  // namespace fastlio
