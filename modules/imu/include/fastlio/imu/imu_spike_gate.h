// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_spike_gate.h Lone absurd samples. */
#pragma once

#include <fastlio/imu/imu_time_gate.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace fastlio
{
/** Leaves out samples that differ absurdly from both neighbours, and impossible ones. A sample that
 * differs from the one before waits for the next one: when that goes back, it was a spike. */
class ImuSpikeGate
{
 public:
  /** \param max_gyro in the unit of the samples' rates
   * \param max_accel [m/s^2] a larger difference is absurd */
  ImuSpikeGate(double max_gyro, double max_accel) : max_gyro_(max_gyro), max_accel_(max_accel) {}

  /** When the unit of the rates is found. */
  void setMaxGyro(double max_gyro) { max_gyro_ = max_gyro; }

  /** Appends the samples that are believed now to \a out. */
  void push(TimedSample timed, std::vector<TimedSample>& out);
  void finish(std::vector<TimedSample>& out);

  [[nodiscard]] std::size_t spikes() const { return spikes_; }
  /** Stamp of the latest sample that was left out; 0: none [ns]. */
  [[nodiscard]] std::int64_t latestSpike() const { return latest_spike_ns_; }

 private:
  void pass(const TimedSample& timed, std::vector<TimedSample>& out);
  void drop(const ImuSample& sample);
  [[nodiscard]] bool jumps(const ImuSample& from, const ImuSample& to) const;

  double max_gyro_, max_accel_;
  std::optional<ImuSample> previous_;
  std::optional<TimedSample> held_;
  bool broken_ = false;  // a sample that was dropped came after a break
  std::size_t spikes_ = 0;
  std::int64_t latest_spike_ns_ = 0;
};

}  // namespace fastlio
