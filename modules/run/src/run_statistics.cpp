// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/matching/degeneracy.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/linear_algebra.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/run/pose_output.h>
#include <fastlio/run/run_statistics.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fastlio
{
namespace
{
/** Nearest-rank quantile; reorders the values. */
double quantile(std::vector<float>& values, double fraction)
{
  const auto last = static_cast<double>(values.size() - 1);
  const auto rank = static_cast<std::ptrdiff_t>(std::lround(fraction * last));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return static_cast<double>(values[static_cast<std::size_t>(rank)]);
}

/** Along the most uncertain axis. */
double largestStd(const FilterState& state, StateBlock block)
{
  const Mat3 P = state.P.block<3, 3>(block, block);
  return std::sqrt(std::max(0.0, symmetricEigensystem(P).values[2]));
}

PointTotals plus(PointTotals sum, const ScanStatistics& scan)
{
  sum.in += scan.points_in;
  sum.invalid += scan.dropped_invalid;
  sum.near += scan.dropped_near;
  sum.far += scan.dropped_far;
  sum.own_body += scan.dropped_own_body;
  sum.downsampled += scan.points_downsampled;
  sum.effective += scan.points_effective;
  return sum;
}
}  // namespace

std::string machineName(ScanStatus status)
{
  std::string name = toString(status);
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

void ScanTimes::add(double ms, bool started)
{
  total_ += ms;
  longest_ = std::max(longest_, ms);
  if (started) started_.push_back(static_cast<float>(ms));
}

ScanTimeSummary ScanTimes::summary() const
{
  ScanTimeSummary times;
  times.max = longest_;
  if (started_.empty()) return times;
  std::vector<float> ms = started_;
  times.mean = std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(ms.size());
  times.median = quantile(ms, 0.5);
  times.p99 = quantile(ms, 0.99);
  return times;
}

void RunStatistics::add(const ScanResult& result)
{
  const Trouble trouble{scans_, result.stamp_ns, result.status, result.message};
  if (scans_ == 0)
    begin_ns_ = result.begin_ns;
  else
    intervals_s_.push_back(static_cast<float>(toSeconds(result.stamp_ns - end_ns_)));
  end_ns_ = result.stamp_ns;
  ++scans_;
  ++counts_.at(static_cast<std::size_t>(result.status));
  points_ = plus(points_, result.statistics);
  health_.add(result);
  times_.add(result.milliseconds.total, result.status != ScanStatus::Initializing);
  if (hasPose(result.status)) addPose(result);
  // Matches of a search for the start say nothing about the run.
  if (result.status != ScanStatus::Initializing && result.statistics.constraints.unconstrained > 0)
    addDegenerateDirections(result);
  if (result.status == ScanStatus::Initializing)
    not_initialized_ = trouble;
  else if (
      (result.status == ScanStatus::PredictionOnly || result.status == ScanStatus::Diverged) &&
      troubles_.size() < kMaxTroubles)
    troubles_.push_back(trouble);
}

void RunStatistics::addDegenerateDirections(const ScanResult& result)
{
  const ScanConstraints& constraints = result.statistics.constraints;
  const double noise = constraints.noise_information[0];
  const double signal_to_noise = noise > 0.0 ? constraints.information[0] / noise : 0.0;
  if (open_.scans++ == 0)
  {
    open_.first_ns = result.stamp_ns;
    open_.signal_to_noise = signal_to_noise;
  }
  open_.last_ns = result.stamp_ns;
  if (signal_to_noise > open_.signal_to_noise) return;
  open_.signal_to_noise = signal_to_noise;
  open_.weakest = unconstrainedMotions(constraints).front();
}

void RunStatistics::addPose(const ScanResult& result)
{
  last_state_ = result.filter;
  calibration_ = result.statistics.calibration;
  const Vec3& position = result.filter.x.p;
  if (last_position_) path_length_ += (position - *last_position_).norm();
  last_position_ = position;
}

std::size_t RunStatistics::count(ScanStatus status) const
{
  return counts_.at(static_cast<std::size_t>(status));
}

std::size_t RunStatistics::missingScans() const
{
  if (intervals_s_.empty()) return 0;
  constexpr float kMissingPeriods = 1.8F;  // jitter does not double an interval
  std::vector<float> intervals = intervals_s_;
  // Of the intervals, the lower quartile: half of the scans may be missing.
  const auto period = static_cast<float>(quantile(intervals, 0.25));
  std::size_t missing = 0;
  for (const float interval : intervals_s_)
    if (period > 0.0F && interval > kMissingPeriods * period)
      missing += static_cast<std::size_t>(std::lround(interval / period)) - 1;
  return missing;
}

std::size_t RunStatistics::poses() const
{
  std::size_t poses = 0;
  for (std::size_t i = 0; i < kScanStatusCount; ++i)
    if (hasPose(static_cast<ScanStatus>(i))) poses += counts_.at(i);
  return poses;
}

double RunStatistics::duration() const
{
  return toSeconds(end_ns_ - begin_ns_);
}

std::optional<Trouble> RunStatistics::firstTrouble() const
{
  if (!troubles_.empty()) return troubles_.front();
  if (poses() == 0) return not_initialized_;
  return std::nullopt;
}

std::string scanCountsText(const RunStatistics& statistics)
{
  std::string text = std::to_string(statistics.scans());
  const char* separator = ": ";
  for (std::size_t i = 0; i < kScanStatusCount; ++i)
  {
    const auto status = static_cast<ScanStatus>(i);
    if (statistics.count(status) == 0) continue;
    text += separator + std::to_string(statistics.count(status)) + " " + toString(status);
    separator = ", ";
  }
  if (const std::size_t missing = statistics.missingScans(); missing > 0)
    text += "; " + std::to_string(missing) + " missing in between";
  return text;
}

double RunStatistics::endPositionStd() const
{
  return last_state_ ? largestStd(*last_state_, kPosition) : 0.0;
}

std::string endUncertaintyText(const RunStatistics& statistics)
{
  const auto& end = statistics.lastState();
  if (!end) return {};
  return fixedText(largestStd(*end, kPosition), 3) + " m, " +
         fixedText(kDegPerRad * largestStd(*end, kAttitude), 2) + " deg (1 sigma)";
}

std::string scanTimesText(const ScanTimeSummary& times)
{
  return fixedText(times.median, 2) + " ms median, " + fixedText(times.p99, 2) + " ms p99, " +
         fixedText(times.max, 2) + " ms max";
}

std::string directionText(const MotionDirection& direction)
{
  const Vec3& axis = direction.axis;
  return (direction.is_rotation ? "rotation about [" : "translation along [") +
         fixedText(axis.x(), 2) + " " + fixedText(axis.y(), 2) + " " + fixedText(axis.z(), 2) + "]";
}

}  // namespace fastlio
