// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_spike_gate.h>

#include <utility>

namespace fastlio
{
namespace
{
// No sensor gives more; not even in deg/s and milli-g.
constexpr double kImpossibleGyro = 1e5;
constexpr double kImpossibleAccel = 1e6;
}  // namespace

bool ImuSpikeGate::jumps(const ImuSample& from, const ImuSample& to) const
{
  return (to.gyro - from.gyro).norm() > max_gyro_ || (to.accel - from.accel).norm() > max_accel_;
}

void ImuSpikeGate::pass(const TimedSample& timed, std::vector<TimedSample>& out)
{
  previous_ = timed.sample;
  out.push_back(timed);
}

void ImuSpikeGate::drop(const ImuSample& sample)
{
  ++spikes_;
  latest_spike_ns_ = sample.stamp_ns;
}

void ImuSpikeGate::push(TimedSample timed, std::vector<TimedSample>& out)
{
  const ImuSample& sample = timed.sample;
  if (!(sample.gyro.norm() < kImpossibleGyro) || !(sample.accel.norm() < kImpossibleAccel))
  {
    broken_ = broken_ || timed.after_break;
    return drop(sample);
  }
  timed.after_break = std::exchange(broken_, false) || timed.after_break;
  const std::int64_t newest_ns = held_       ? held_->sample.stamp_ns
                                 : previous_ ? previous_->stamp_ns
                                             : sample.stamp_ns - 1;
  if (sample.stamp_ns <= newest_ns)
  {
    out.push_back(timed);  // out of order: no neighbour of anything
    return;
  }
  if (held_)
  {
    const TimedSample held = *held_;
    held_.reset();
    if (!timed.after_break && previous_ && jumps(held.sample, sample) && !jumps(*previous_, sample))
      drop(held.sample);
    else
      pass(held, out);
  }
  if (!timed.after_break && previous_ && jumps(*previous_, sample))
    held_ = timed;
  else
    pass(timed, out);
}

void ImuSpikeGate::finish(std::vector<TimedSample>& out)
{
  if (held_) pass(*held_, out);
  held_.reset();
}

}  // namespace fastlio
