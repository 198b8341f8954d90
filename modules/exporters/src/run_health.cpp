// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/run_health.h>
#include <fastlio/math/time.h>

#include <algorithm>

namespace fastlio
{
void RunHealth::add(const ScanResult& result)
{
  if (seen_ == 0) begin_ns_ = result.begin_ns;
  const std::size_t index = seen_++;
  if (scans_ == 0 && result.status == ScanStatus::Initializing) return;
  ++scans_;
  sum_ += result.health.value;
  worst_ = std::min(worst_, result.health.value);
  if (result.health.value >= kTroubledHealth) return;
  ++troubled_;
  ++causes_[result.health.cause];
  if (first_) return;
  first_ = Trouble{index, result.stamp_ns, toSeconds(result.stamp_ns - begin_ns_), result.health};
}

double RunHealth::mean() const
{
  return scans_ > 0 ? sum_ / static_cast<double>(scans_) : 0.0;
}

}  // namespace fastlio
