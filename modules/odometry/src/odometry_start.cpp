// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Starts of the odometry: the first one, and those after a re-initialisation.

#include "odometry_impl.h"
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{
// A scan may begin a little before the inertial data do: a sample holds before its stamp, too.
constexpr std::int64_t kStartHoldBeforeNs = 20'000'000;
constexpr double kUpsideDown = -0.5;  // z of the upward direction in the IMU frame
}  // namespace

bool Odometry::Impl::relocalize(const PoseGuess& guess, const SavedMap* other)
{
  if (other != nullptr && other->empty()) return false;
  if (!estimator_.canGoOn() || (other == nullptr && estimator_.map().pointCount() == 0))
    return false;
  const std::int64_t stamp_ns = estimator_.stamp();
  if (other != nullptr)
  {
    estimator_.goOnIn(*other);
    map_origin_ = other->origin;
  }
  const Pose T_map_imu{guess.T_world_imu.R, guess.T_world_imu.p - map_origin_};
  estimator_.relocalize(T_map_imu, guess.position_std, guess.yaw_std);
  reinitialization_.forgetPoses();
  diagnostics_.report(
      stamp_ns, other == nullptr ? "the pose is searched around one that was given"
                                 : "the run goes on in a map that was given");
  return true;
}

void Odometry::Impl::start(const StartDecision& decision)
{
  if (reinitialization_.pending())
  {
    estimator_.reinitialise(
        *decision.state, decision.stamp_ns, decision.motion_window,
        reinitialization_.takeCarried(decision.stamp_ns));
    diagnostics_.report(decision.stamp_ns, "re-initialised with the pose carried over");
    return;
  }
  estimator_.start(*decision.state, decision.stamp_ns, decision.motion_window);
  const NavState& x = decision.state->x;
  const Vec3 up = -(x.R.transpose() * x.g).normalized();
  if (up.z() < kUpsideDown)
    diagnostics_.report(
        decision.stamp_ns,
        mrpt::format(
            "the IMU is mounted upside down (up is [%.2f %.2f %.2f] in its frame), which is fine; "
            "if it is not, the accelerometer's sign is inverted (imu.invert_acceleration)",
            up.x(), up.y(), up.z()));
}

StartDecision Odometry::Impl::decideStart(bool at_end)
{
  if (!reinitialization_.pending()) return start_finder_.decide(intake_.queue(), imu_, at_end);
  // The search for a start knows no calibration but that of its scans.
  ScanQueue calibrated = intake_.queue();
  for (QueuedScan& queued : calibrated)
    estimator_.applyCalibration(queued.scan, queued.span);
  return start_finder_.decide(calibrated, imu_, at_end);
}

std::optional<ScanResult> Odometry::Impl::waitForStart(bool at_end)
{
  while (!intake_.queue().empty() && !estimator_.started())
  {
    const StartDecision decision = decideStart(at_end);
    if (decision.drop_oldest)
      return classifyUnprocessed(
          intake_.takeOldest(),
          (reinitialization_.pending() ? "starting anew: " : "") + decision.message, false);
    if (!decision.state) break;
    start(decision);
  }
  return std::nullopt;
}

bool Odometry::Impl::waitsTooLong(std::int64_t end_ns) const
{
  const auto limit_ns = toNanoseconds(options_.lidar.max_waiting);
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
  estimator_.skipScan();
  return classifyUnprocessed(
      intake_.takeOldest(),
      (imu_.empty() ? "no usable inertial sample has arrived" : "the inertial data have ended") +
          (waits_s > 0.0 ? mrpt::format(", but scans of %.1f s have after this one", waits_s)
                         : "") +
          "; is the IMU running, does it share the LiDAR's clock (lidar.time_offset)?",
      estimator_.started() || reinitialization_.pending());
}

/** Re-initialises the run where the oldest scan has reached a break. \return a scan that nothing is
 * known about */
std::optional<ScanResult> Odometry::Impl::passBreaks()
{
  const std::int64_t time_shift_ns = estimator_.timeShift();
  const ScanSpan span = intake_.queue().front().span;
  while (const auto gap = reinitialization_.breakBefore(span.end_ns + time_shift_ns))
  {
    if (estimator_.started() && reinitialization_.isNeededAt(*gap))
      reinitialise(reinitialization_.decideAt(*gap, estimator_.state()), gap->begin_ns);
    else if (!estimator_.started() && !reinitialization_.pending() && options_.recovery.enabled)
      // Rest may not come again.
      start_finder_ = StartFinder(Reinitialization::startingAnyHow(options_));
    if (!estimator_.started())
    {
      imu_.forgetSamplesBefore(gap->end_ns);
      if (span.begin_ns + time_shift_ns < gap->end_ns - kStartHoldBeforeNs)
        return gap->new_map
                   ? classifyUnprocessed(
                         intake_.takeOldest(), "the inertial data before were wrong", false)
                   : classifyUnprocessed(
                         intake_.takeOldest(),
                         mrpt::format(
                             "within %.2f s without inertial samples (imu.max_gap is %.2f s)",
                             gap->seconds(), options_.imu.max_gap),
                         reinitialization_.pending());
    }
    reinitialization_.dropBreak();
  }
  return std::nullopt;
}

void Odometry::Impl::reinitialise(const std::string& why, std::int64_t stamp_ns)
{
  estimator_.suspend(reinitialization_.believed());
  start_finder_ = StartFinder(Reinitialization::startingAnyHow(options_));
  diagnostics_.report(stamp_ns, "the run is re-initialised: " + why);
}

}  // namespace fastlio
