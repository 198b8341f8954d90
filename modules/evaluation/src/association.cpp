// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/association.h>
#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace fastlio
{
namespace
{
enum class Match
{
  Used,
  Before,
  After,
  InGap
};

struct Sample
{
  Match match = Match::Used;
  Pose pose;
};

/** The reference at a stamp. */
Sample sampleAt(
    const std::vector<StampedPose>& reference, std::int64_t stamp_ns, std::int64_t max_gap_ns)
{
  if (stamp_ns < reference.front().stamp_ns) return {Match::Before, {}};
  if (stamp_ns > reference.back().stamp_ns) return {Match::After, {}};
  const auto right = std::lower_bound(
      reference.begin(), reference.end(), stamp_ns,
      [](const StampedPose& pose, std::int64_t t) { return pose.stamp_ns < t; });
  if (right->stamp_ns == stamp_ns) return {Match::Used, right->T_world_body};
  const auto left = right - 1;
  if (right->stamp_ns - left->stamp_ns > max_gap_ns) return {Match::InGap, {}};
  return {Match::Used, interpolate(*left, *right, stamp_ns)};
}

void count(AssociationCounts& counts, Match match)
{
  ++counts.estimated;
  switch (match)
  {
    case Match::Used:
      ++counts.used;
      break;
    case Match::Before:
      ++counts.before;
      break;
    case Match::After:
      ++counts.after;
      break;
    case Match::InGap:
      ++counts.in_gap;
      break;
  }
}

/** From each pose to the next one. */
std::vector<std::int64_t> stepsOf(const std::vector<StampedPose>& poses)
{
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < poses.size(); ++i)
    steps.push_back(poses[i].stamp_ns - poses[i - 1].stamp_ns);
  return steps;
}

/** A hole stands out from the other steps, which may be those of scans or of keyframes. */
bool isHole(std::int64_t step_ns, std::int64_t median_ns)
{
  constexpr std::int64_t kShortestHoleNs = kSecondNs;
  constexpr std::int64_t kStepsOfAHole = 10;
  return step_ns > kShortestHoleNs && step_ns / kStepsOfAHole > median_ns;
}

/** Time in holes of the estimate between its used poses. Where the estimate has poses that the
 * reference lacks, the hole is the reference's. */
struct Holes
{
  std::int64_t sum_ns = 0;
  std::int64_t longest_ns = 0;
};

Holes holesOf(const std::vector<StampedPose>& estimate, const std::vector<bool>& is_used)
{
  Holes holes;
  const std::vector<std::int64_t> steps = stepsOf(estimate);
  const std::int64_t median_ns = median(steps);
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    if (!is_used[i] || !is_used[i + 1] || !isHole(steps[i], median_ns)) continue;
    holes.sum_ns += steps[i];
    holes.longest_ns = std::max(holes.longest_ns, steps[i]);
  }
  return holes;
}

void measureCoverage(
    AssociationCounts& counts, const std::vector<StampedPose>& used,
    const std::vector<StampedPose>& reference, const Holes& holes)
{
  const auto span = [](const std::vector<StampedPose>& poses)
  { return poses.back().stamp_ns - poses.front().stamp_ns; };
  counts.longest_hole = toSeconds(holes.longest_ns);
  counts.coverage =
      static_cast<double>(span(used) - holes.sum_ns) / static_cast<double>(span(reference));
}

std::string rangeOf(const Trajectory& t, std::int64_t offset_ns)
{
  return "'" + t.source + "' covers " + secondsText(t.poses.front().stamp_ns + offset_ns) + " to " +
         secondsText(t.poses.back().stamp_ns + offset_ns) + " s";
}

void requireOverlap(
    const AssociationCounts& counts, const Trajectory& estimate, const Trajectory& reference,
    const AssociationOptions& options)
{
  if (counts.used >= 2) return;
  throw std::invalid_argument(
      "fewer than two poses have a common time: of " + std::to_string(counts.estimated) +
      " estimated poses " + std::to_string(counts.before) + " are before, " +
      std::to_string(counts.after) + " after and " + std::to_string(counts.in_gap) +
      " in gaps (above " + std::to_string(options.max_gap) + " s) of the reference. The estimate " +
      rangeOf(estimate, toNanoseconds(options.time_offset)) + ", the reference " +
      rangeOf(reference, 0) +
      ". Check that both use one clock, the time offset and the largest gap allowed");
}

void requireValid(const AssociationOptions& options)
{
  if (!(options.max_gap > 0.0) || !std::isfinite(options.max_gap))
    throw std::invalid_argument("the largest gap must be a number above 0 s");
  if (!std::isfinite(options.time_offset))
    throw std::invalid_argument("the time offset must be a finite number of seconds");
}

}  // namespace

Pose interpolate(const StampedPose& a, const StampedPose& b, std::int64_t stamp_ns)
{
  const double s =
      static_cast<double>(stamp_ns - a.stamp_ns) / static_cast<double>(b.stamp_ns - a.stamp_ns);
  return interpolated(a.T_world_body, b.T_world_body, s);
}

AssociatedTrajectories associate(
    const Trajectory& estimate, const Trajectory& reference, const AssociationOptions& options)
{
  requireValid(options);
  requireValid(estimate);
  requireValid(reference);
  AssociatedTrajectories result;
  std::vector<bool> is_used(estimate.poses.size(), false);
  for (std::size_t i = 0; i < estimate.poses.size(); ++i)
  {
    const std::int64_t stamp_ns = estimate.poses[i].stamp_ns + toNanoseconds(options.time_offset);
    const Sample sample = sampleAt(reference.poses, stamp_ns, toNanoseconds(options.max_gap));
    count(result.counts, sample.match);
    is_used[i] = sample.match == Match::Used;
    if (!is_used[i]) continue;
    result.estimate.push_back({stamp_ns, estimate.poses[i].T_world_body});
    result.reference.push_back({stamp_ns, sample.pose});
    if (estimate.hasCovariances()) result.covariances.push_back(estimate.covariances[i]);
  }
  requireOverlap(result.counts, estimate, reference, options);
  measureCoverage(
      result.counts, result.reference, reference.poses, holesOf(estimate.poses, is_used));
  return result;
}

}  // namespace fastlio
