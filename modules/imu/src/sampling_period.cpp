// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/sampling_period.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr std::size_t kEnough = 16;
}  // namespace

void SamplingPeriod::add(double interval, double gap_periods)
{
  latest_[count_ % kLatest] = interval;
  ++count_;
  if (count_ % kEnough == 0)
  {
    std::array<double, kLatest> sorted = latest_;
    auto* const end = sorted.begin() + static_cast<std::ptrdiff_t>(std::min(count_, kLatest));
    auto* const middle = sorted.begin() + (end - sorted.begin()) / 2;
    std::nth_element(sorted.begin(), middle, end);
    median_ = *middle;
  }
  if (median_ > 0.0 && interval > gap_periods * median_) return;
  n_ += 1.0;
  const double off = interval - mean_;
  mean_ += off / n_;
  squares_ += off * (interval - mean_);
}

double SamplingPeriod::jitter() const
{
  return n_ > 1.0 && median_ > 0.0 ? std::sqrt(squares_ / (n_ - 1.0)) / median_ : 0.0;
}

}  // namespace fastlio
