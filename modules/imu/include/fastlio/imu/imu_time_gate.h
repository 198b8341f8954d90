// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_time_gate.h Stamps that jump: a wrong one, a gap, or a clock that was set? */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/math/time.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace fastlio
{
/** A sample whose stamp is believed. */
struct TimedSample
{
  ImuSample sample;
  bool after_break = false;  //!< more than imu.max_gap after the one before
};

/** Believes a jump of the stamps when the next sample confirms it.
 *
 * Forward by more than max_gap: the sample is held; when the next one follows it, there was a gap,
 * when it does not, the stamp was wrong. Backward by more than max_gap: when the samples go on from
 * there for max_gap, the clock was set back, and their stamps are moved so that time goes on;
 * otherwise they came too late. The first sample waits for the second one. */
class ImuTimeGate
{
 public:
  explicit ImuTimeGate(double max_gap) : max_gap_ns_(toNanoseconds(max_gap)) {}

  /** Appends the samples that are believed now to \a out.
   * \param sample its stamp is a time */
  void push(ImuSample sample, std::vector<TimedSample>& out);
  /** Nothing more will come. */
  void finish(std::vector<TimedSample>& out);

  [[nodiscard]] std::size_t badStamps() const { return bad_stamps_; }
  [[nodiscard]] std::size_t late() const { return late_ + behind_.size(); }
  [[nodiscard]] std::size_t clockSteps() const { return clock_steps_; }
  /** Added to the stamps, since the clock was set back [ns]. */
  [[nodiscard]] std::int64_t clockOffset() const { return offset_ns_; }

 private:
  void pass(const ImuSample& sample, bool after_break, std::vector<TimedSample>& out);
  void pushBehind(const ImuSample& sample, std::vector<TimedSample>& out);
  [[nodiscard]] bool resolveHeld(const ImuSample& sample, std::vector<TimedSample>& out);

  std::int64_t max_gap_ns_;
  std::int64_t offset_ns_ = 0;
  std::optional<std::int64_t> last_ns_;
  std::int64_t period_ns_ = 0;  // latest
  std::optional<ImuSample> held_;
  std::vector<ImuSample> behind_;
  std::size_t bad_stamps_ = 0, late_ = 0, clock_steps_ = 0;
};

}  // namespace fastlio
