// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_buffer.h>

#include <algorithm>

namespace fastlio
{
namespace
{
// Moving the tail to the front every so many forgotten samples keeps the storage bounded.
constexpr std::size_t kCompactAfter = 1024;

ImuSample interpolate(const ImuSample& a, const ImuSample& b, std::int64_t stamp_ns)
{
  const double s =
      static_cast<double>(stamp_ns - a.stamp_ns) / static_cast<double>(b.stamp_ns - a.stamp_ns);
  return {stamp_ns, a.gyro + s * (b.gyro - a.gyro), a.accel + s * (b.accel - a.accel)};
}
}  // namespace

ImuBuffer::Verdict ImuBuffer::add(const ImuSample& sample)
{
  if (!sample.gyro.allFinite() || !sample.accel.allFinite()) return Verdict::NotFinite;
  if (!empty() && sample.stamp_ns == newestStamp()) return Verdict::Duplicate;
  if (!empty() && sample.stamp_ns < newestStamp()) return Verdict::OutOfOrder;
  samples_.push_back(sample);
  return Verdict::Accepted;
}

std::size_t ImuBuffer::firstAfter(std::int64_t stamp_ns) const
{
  const auto begin = samples_.begin() + static_cast<std::ptrdiff_t>(head_);
  const auto it = std::upper_bound(
      begin, samples_.end(), stamp_ns,
      [](std::int64_t t, const ImuSample& s) { return t < s.stamp_ns; });
  return static_cast<std::size_t>(it - samples_.begin());
}

ImuSample ImuBuffer::heldInput(
    std::size_t left, std::int64_t begin_ns, std::int64_t end_ns, ImuHold hold) const
{
  ImuSample input = samples_[left];
  const std::int64_t middle_ns = begin_ns + (end_ns - begin_ns) / 2;
  const bool between = left + 1 < samples_.size() && middle_ns >= input.stamp_ns;
  if (hold == ImuHold::Midpoint && between)
    input = interpolate(samples_[left], samples_[left + 1], middle_ns);
  input.stamp_ns = begin_ns;
  return input;
}

void ImuBuffer::inputsBetween(
    std::int64_t begin_ns, std::int64_t end_ns, ImuHold hold, std::vector<ImuSample>& inputs) const
{
  inputs.clear();
  if (empty() || end_ns <= begin_ns) return;
  std::size_t next = firstAfter(begin_ns);
  std::int64_t start_ns = begin_ns;
  while (start_ns < end_ns)
  {
    const std::int64_t stop_ns =
        next < samples_.size() ? std::min(samples_[next].stamp_ns, end_ns) : end_ns;
    const std::size_t left = next > head_ ? next - 1 : head_;
    inputs.push_back(heldInput(left, start_ns, stop_ns, hold));
    start_ns = stop_ns;
    ++next;
  }
}

std::int64_t ImuBuffer::longestGap(std::int64_t begin_ns, std::int64_t end_ns) const
{
  std::int64_t longest = 0;
  std::int64_t previous_ns = begin_ns;
  std::size_t i = firstAfter(begin_ns);
  if (i > head_) previous_ns = samples_[i - 1].stamp_ns;
  for (; i < samples_.size() && previous_ns < end_ns; ++i)
  {
    longest = std::max(longest, samples_[i].stamp_ns - previous_ns);
    previous_ns = samples_[i].stamp_ns;
  }
  return std::max(longest, end_ns - previous_ns);
}

std::vector<ImuSample> ImuBuffer::samplesBetween(std::int64_t begin_ns, std::int64_t end_ns) const
{
  const auto at = [&](std::size_t i) { return samples_.begin() + static_cast<std::ptrdiff_t>(i); };
  return {at(firstAfter(begin_ns - 1)), at(firstAfter(end_ns))};
}

const ImuSample* ImuBuffer::sampleAt(std::int64_t stamp_ns) const
{
  const std::size_t next = firstAfter(stamp_ns);
  const bool found = next > head_ && samples_[next - 1].stamp_ns == stamp_ns;
  return found ? &samples_[next - 1] : nullptr;
}

void ImuBuffer::forgetBefore(std::int64_t stamp_ns)
{
  const std::size_t next = firstAfter(stamp_ns);
  moveHead(next > head_ ? next - 1 : head_);
}

void ImuBuffer::forgetSamplesBefore(std::int64_t stamp_ns)
{
  if (!empty()) moveHead(std::min(firstAfter(stamp_ns - 1), samples_.size() - 1));
}

void ImuBuffer::scaleGyro(double factor)
{
  for (ImuSample& sample : samples_)
    sample.gyro *= factor;
}

void ImuBuffer::moveHead(std::size_t head)
{
  head_ = head;
  if (!inflations_.empty() && !empty())
    inflations_.erase(
        std::remove_if(
            inflations_.begin(), inflations_.end(),
            [oldest_ns = oldestStamp()](const NoiseInflation& d) { return d.end_ns < oldest_ns; }),
        inflations_.end());
  if (head_ < kCompactAfter) return;
  samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(head_));
  head_ = 0;
}

}  // namespace fastlio
