// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_time_gate.h>

#include <algorithm>

namespace fastlio
{
namespace
{
constexpr std::size_t kFewestBehind = 20;  // samples that make a clock step
}  // namespace

void ImuTimeGate::pass(const ImuSample& sample, bool after_break, std::vector<TimedSample>& out)
{
  if (last_ns_ && sample.stamp_ns > *last_ns_) period_ns_ = sample.stamp_ns - *last_ns_;
  if (after_break) period_ns_ = 0;
  last_ns_ = std::max(sample.stamp_ns, last_ns_.value_or(sample.stamp_ns));
  late_ += behind_.size();
  behind_.clear();
  out.push_back({sample, after_break});
}

bool ImuTimeGate::resolveHeld(const ImuSample& sample, std::vector<TimedSample>& out)
{
  const std::int64_t after_held_ns = sample.stamp_ns - held_->stamp_ns;
  const std::int64_t at_least_ns = last_ns_ ? 1 : -max_gap_ns_;
  if (after_held_ns >= at_least_ns && after_held_ns <= max_gap_ns_)
  {
    pass(*held_, last_ns_.has_value(), out);
    held_.reset();
    pass(sample, false, out);
    return true;
  }
  const bool goes_on = last_ns_ && sample.stamp_ns <= *last_ns_ + max_gap_ns_;
  if (goes_on && sample.stamp_ns <= *last_ns_) return false;  // says nothing
  ++bad_stamps_;
  held_.reset();
  return false;
}

void ImuTimeGate::push(ImuSample sample, std::vector<TimedSample>& out)
{
  sample.stamp_ns += offset_ns_;
  if (held_ && resolveHeld(sample, out)) return;
  if (!last_ns_ || sample.stamp_ns - *last_ns_ > max_gap_ns_)
    held_ = sample;
  else if (sample.stamp_ns - *last_ns_ < -max_gap_ns_)
    pushBehind(sample, out);
  else
    pass(sample, false, out);
}

void ImuTimeGate::pushBehind(const ImuSample& sample, std::vector<TimedSample>& out)
{
  if (!behind_.empty())
  {
    const std::int64_t step_ns = sample.stamp_ns - behind_.back().stamp_ns;
    if (step_ns <= 0 || step_ns > max_gap_ns_)
    {
      late_ += behind_.size();
      behind_.clear();
    }
  }
  behind_.push_back(sample);
  const std::int64_t span_ns = sample.stamp_ns - behind_.front().stamp_ns;
  if (behind_.size() < kFewestBehind || span_ns < max_gap_ns_) return;
  const std::int64_t shift_ns =
      *last_ns_ + std::max<std::int64_t>(period_ns_, 1) - behind_.front().stamp_ns;
  offset_ns_ += shift_ns;
  ++clock_steps_;
  held_.reset();
  std::vector<ImuSample> stretch;
  stretch.swap(behind_);
  for (ImuSample& s : stretch)
  {
    s.stamp_ns += shift_ns;
    pass(s, false, out);
  }
}

void ImuTimeGate::finish(std::vector<TimedSample>& out)
{
  // A lone first sample is believed, a lone jump is not.
  if (held_ && !last_ns_)
    pass(*held_, false, out);
  else if (held_)
    ++bad_stamps_;
  held_.reset();
}

}  // namespace fastlio
