// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file imu_buffer.h Time-ordered inertial samples and the filter inputs of a time interval. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/imu/noise_inflation.h>

#include <cstddef>
#include <vector>

namespace fastlio
{
/** How a sampled signal becomes the input that is held over one IMU period. */
enum class ImuHold
{
  Midpoint,  //!< linear interpolation between samples, taken in the middle of the period
  Left       //!< zero-order hold of the sample at the period's start (paper)
};

/** Samples between the oldest instant still needed and the newest one. */
class ImuBuffer
{
 public:
  /** Why a sample was not taken. */
  enum class Verdict
  {
    Accepted,
    NotFinite,
    OutOfOrder,
    Duplicate
  };

  Verdict add(const ImuSample& sample);

  [[nodiscard]] bool empty() const { return head_ == samples_.size(); }
  [[nodiscard]] std::int64_t oldestStamp() const { return samples_[head_].stamp_ns; }
  [[nodiscard]] std::int64_t newestStamp() const { return samples_.back().stamp_ns; }

  /** The inputs that hold from begin_ns to end_ns: element i from its stamp to that of element i+1,
   * the first one stamped begin_ns, the last one held until end_ns. Before the first sample and
   * after the last one the nearest sample holds. Reused storage, empty when there is no sample. */
  void inputsBetween(
      std::int64_t begin_ns, std::int64_t end_ns, ImuHold hold,
      std::vector<ImuSample>& inputs) const;

  /** Longest time between consecutive samples that the interval touches [ns]. */
  [[nodiscard]] std::int64_t longestGap(std::int64_t begin_ns, std::int64_t end_ns) const;

  /** Samples of [begin_ns, end_ns], oldest first. */
  [[nodiscard]] std::vector<ImuSample> samplesBetween(
      std::int64_t begin_ns, std::int64_t end_ns) const;

  /** Calls \a use for the samples of [begin_ns, end_ns], oldest first. */
  template <typename Use>
  void forEachSample(std::int64_t begin_ns, std::int64_t end_ns, const Use& use) const
  {
    const std::size_t end = firstAfter(end_ns);
    for (std::size_t i = firstAfter(begin_ns - 1); i < end; ++i)
      use(samples_[i]);
  }

  /** Notes a span of time in which the samples are worse than their noise says. */
  void addInflation(const NoiseInflation& inflation) { inflations_.push_back(inflation); }
  [[nodiscard]] const std::vector<NoiseInflation>& inflations() const { return inflations_; }

  /** Multiplies the angular rates of all samples. */
  void scaleGyro(double factor);

  /** The sample with this very stamp, or null; valid until the next change of the buffer. */
  [[nodiscard]] const ImuSample* sampleAt(std::int64_t stamp_ns) const;

  /** Forgets samples that no interval starting at or after stamp_ns needs. */
  void forgetBefore(std::int64_t stamp_ns);

  /** Forgets all samples before stamp_ns, also the one that held at stamp_ns; the newest stays. */
  void forgetSamplesBefore(std::int64_t stamp_ns);

 private:
  [[nodiscard]] std::size_t firstAfter(std::int64_t stamp_ns) const;
  void moveHead(std::size_t head);
  [[nodiscard]] ImuSample heldInput(
      std::size_t left, std::int64_t begin_ns, std::int64_t end_ns, ImuHold hold) const;

  std::vector<ImuSample> samples_;
  std::size_t head_ = 0;
  std::vector<NoiseInflation> inflations_;
};

}  // namespace fastlio
