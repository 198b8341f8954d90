// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "initialization.h"

#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>

#include <mrpt/core/format.h>

#include <algorithm>

namespace fastlio
{
namespace
{
// A window that does not rest moves on by this fraction of its length.
constexpr double kWindowStep = 0.1;
// After a refused start in motion the first of so many parts of its window is given up.
constexpr std::size_t kRefusedParts = 2;
// After so many in a row it is given up as a whole: each attempt takes the time of a hundred scans.
constexpr std::size_t kHastyRefusals = 8;
// Slower motion, which a pass at rest does not see, may be none.
constexpr double kMotionForSure = 0.5;  // [m/s]
// Somebody who stands turns by 0.3 to 0.7 deg/s, to and fro, and moves by millimetres: a start at
// rest takes that for biases, and for errors of a map that is still sparse.
constexpr double kSwayingRate = 0.1 / kDegPerRad;  // [rad/s]
constexpr const char* kStartInMotionHint = "; initialization.mode: auto starts in motion, too";
// A sample holds a little before its stamp, too.
constexpr std::int64_t kSampleHoldBeforeNs = 20'000'000;

double secondsBetween(std::int64_t from_ns, std::int64_t to_ns)
{
  return toSeconds(to_ns - from_ns);
}

/** What the inertial samples before the first scan say about rest. */
struct RestSearch
{
  StartDecision decision;
  bool sways = false;               // it does not rest as a vehicle does
  bool rejected = false;            // the latest window does not rest, nor does one before it
  std::int64_t next_window_ns = 0;  // then the search goes on from here
};

/** \param collected [s] from the window's begin to the newest sample */
std::string collectingText(double collected, double duration)
{
  if (collected >= 0.0)
    return mrpt::format(
        "collecting the resting start: %.2f of %.2f s (initialization.duration)", collected,
        duration);
  return mrpt::format(
      "no inertial data for the resting start: they end %.2f s before the %.2f s that precede the "
      "scan (initialization.duration); are the clocks of LiDAR and IMU the same "
      "(lidar.time_offset)?",
      -collected, duration);
}

RestSearch searchRest(
    const ImuBuffer& imu, const InitializationOptions& parameters, std::int64_t first_scan_begin_ns)
{
  RestSearch search;
  const std::int64_t duration_ns = toNanoseconds(parameters.duration);
  const std::int64_t step_ns =
      std::max<std::int64_t>(toNanoseconds(kWindowStep * parameters.duration), 1);
  const std::int64_t latest_ns = std::max(imu.oldestStamp(), first_scan_begin_ns - duration_ns);
  if (imu.newestStamp() < latest_ns + duration_ns)
  {
    search.decision.message =
        collectingText(secondsBetween(latest_ns, imu.newestStamp()), parameters.duration);
    return search;
  }
  // The later the window, the less is left to inertial data alone until the first scan.
  for (std::int64_t begin_ns = latest_ns; begin_ns >= imu.oldestStamp(); begin_ns -= step_ns)
  {
    const std::int64_t end_ns = begin_ns + duration_ns;
    std::vector<ImuSample> samples = imu.samplesBetween(begin_ns, end_ns);
    const auto reason = whyNotAtRest(restStatistics(samples), parameters);
    if (!reason)
    {
      const std::size_t resting = restingSamples(samples);
      const std::int64_t rest_end_ns =
          resting < samples.size() ? samples[resting - 1].stamp_ns : end_ns;
      samples.resize(resting);
      const RestStatistics rest = restStatistics(samples);
      search.sways = rest.sway.rate > kSwayingRate;
      search.decision.state = initialState(rest, parameters);
      search.decision.stamp_ns = std::clamp(first_scan_begin_ns, begin_ns, rest_end_ns);
      return search;
    }
    if (begin_ns == latest_ns) search.decision.message = *reason;
  }
  search.rejected = true;
  search.next_window_ns = latest_ns + step_ns;
  return search;
}

StartDecision waitOrDrop(bool drop, std::string why)
{
  StartDecision decision;
  decision.drop_oldest = drop;
  decision.message = std::move(why);
  return decision;
}

StartDecision startedInMotion(const MotionStart& start, std::int64_t stamp_ns)
{
  StartDecision decision;
  decision.state = start.state;
  decision.stamp_ns = stamp_ns;
  decision.motion_window = start.motion_window;
  return decision;
}

/** Why the front of the queue cannot be a start in motion whatever comes; empty when it can. */
std::string inertialGap(const ScanQueue& scans, const ImuBuffer& imu)
{
  const double missing_s = secondsBetween(scans.front().span.begin_ns, imu.oldestStamp());
  if (missing_s <= toSeconds(kSampleHoldBeforeNs)) return {};
  return mrpt::format(
      "no start in motion: the inertial data begin %.3f s after the scan", missing_s);
}
}  // namespace

StartDecision StartFinder::decide(const ScanQueue& scans, ImuBuffer& imu, bool at_end)
{
  switch (parameters_.initialization.mode)
  {
    case InitializationMode::Rest:
      return decideAtRest(scans, imu, at_end);
    case InitializationMode::Motion:
      return decideInMotion(scans, imu, at_end);
    case InitializationMode::Auto:
      return decideAutomatically(scans, imu, at_end);
  }
  return {};
}

StartDecision StartFinder::decideAtRest(const ScanQueue& scans, ImuBuffer& imu, bool at_end)
{
  const ScanSpan span = scans.front().span;
  while (true)
  {
    RestSearch search = searchRest(imu, parameters_.initialization, span.latestStart());
    StartDecision& decision = search.decision;
    if (decision.state)
    {
      not_at_rest_.clear();
      return decision;
    }
    if (!search.rejected)
    {
      // What is still collected matters less than why the start has not been found so far.
      if (!not_at_rest_.empty()) decision.message = not_at_rest_;
      decision.drop_oldest = at_end;
      return decision;
    }
    decision.message += kStartInMotionHint;
    not_at_rest_ = decision.message;
    // All of them, so that the search goes on behind a gap longer than its step.
    imu.forgetSamplesBefore(search.next_window_ns);
    decision.drop_oldest = span.end_ns < imu.oldestStamp();
    if (decision.drop_oldest) return decision;
  }
}

StartDecision StartFinder::decideInMotion(const ScanQueue& scans, ImuBuffer& imu, bool at_end)
{
  const QueuedScan& oldest = scans.front();
  if (oldest.span.end_ns <= refused_until_ns_) return waitOrDrop(true, refusal_);
  const std::string gap = inertialGap(scans, imu);
  if (!gap.empty()) return waitOrDrop(true, gap);

  const double duration = parameters_.initialization.motion_duration;
  const std::size_t count = motionWindow(scans, imu, duration);
  // What remains at the end is too short. Why all before was refused says more.
  if (count == 0 && at_end && !refusal_.empty()) return waitOrDrop(true, refusal_);
  if (count == 0)
    return waitOrDrop(
        at_end,
        mrpt::format(
            "collecting the start in motion: %.2f of %.2f s of scans with inertial data "
            "(initialization.motion_duration)",
            secondsBetween(
                oldest.span.begin_ns, std::min(scans.back().span.end_ns, imu.newestStamp())),
            duration));
  MotionStart start = startInMotion(scans, count, imu, parameters_);
  if (start.state) return startedInMotion(start, oldest.span.latestStart());
  return refuse(start, scans, count, imu);
}

/** The next scans would be refused for the same reason. */
StartDecision StartFinder::refuse(
    const MotionStart& start, const ScanQueue& scans, std::size_t count, ImuBuffer& imu)
{
  // The search for rest looks back by its duration.
  imu.forgetBefore(
      scans.front().span.begin_ns - toNanoseconds(parameters_.initialization.duration));
  const std::size_t last = refusals_++ < kHastyRefusals ? count / kRefusedParts : count - 1;
  refused_until_ns_ = scans[last].span.end_ns;
  refusal_ = start.message;
  return waitOrDrop(true, refusal_);
}

StartDecision StartFinder::decideAutomatically(const ScanQueue& scans, ImuBuffer& imu, bool at_end)
{
  const std::int64_t begin_ns = scans.front().span.latestStart();
  RestSearch search = searchRest(imu, parameters_.initialization, begin_ns);
  if (search.decision.state) return confirmRest(search.decision, search.sways, scans, imu, at_end);
  if (!search.rejected && !at_end) return search.decision;
  StartDecision moving = decideInMotion(scans, imu, at_end);
  if (moving.state) return moving;
  // Inertial data that have not come, as with clocks that are apart, are no rest and no motion.
  if (search.rejected)
    moving.message += "; " + search.decision.message;
  else
    moving.message = search.decision.message;
  return moving;
}

/** To the inertial sensor, motion that is steady, or speeds up evenly, looks like rest: the scans
 * distinguish them. A rest that they do not confirm is none, unless they show no motion either, as
 * in a tunnel. Who sways moves a little: the scans say how. */
StartDecision StartFinder::confirmRest(
    StartDecision at_rest, bool sways, const ScanQueue& scans, ImuBuffer& imu, bool at_end)
{
  const ScanSpan span = scans.front().span;
  if (!inertialGap(scans, imu).empty()) return at_rest;
  if (span.end_ns <= refused_until_ns_) return waitOrDrop(true, refusal_);
  const std::size_t count = motionWindow(scans, imu, parameters_.initialization.motion_duration);
  if (count == 0 && !at_end) return waitOrDrop(false, "comparing the first scans: rest or motion");
  if (count == 0) return at_rest;
  const RestVerdict verdict =
      verdictOnRest(scans, count, imu, parameters_, *at_rest.state, at_rest.stamp_ns);
  const bool rests = verdict == RestVerdict::Confirmed;
  if (rests && !sways) return at_rest;
  const MotionStart start = startInMotion(scans, count, imu, parameters_);
  if (rests && !start.state) return at_rest;
  const bool moves = start.state && start.state->x.v.norm() > kMotionForSure;
  if (verdict == RestVerdict::Open && !moves) return at_rest;
  if (start.state) return startedInMotion(start, span.latestStart());
  return refuse(start, scans, count, imu);
}

}  // namespace fastlio
