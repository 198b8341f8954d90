// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file time_sorter.h Puts observations that come late in order of their stamps. */
#pragma once

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <cstdint>
#include <queue>
#include <vector>

namespace fastlio
{
/** Holds observations back until those that may still come cannot precede them. Equal stamps keep
 * their order. An observation with an absurd stamp does not hold up the others, and one without a
 * time does not wait; when time steps back, what is held from before goes first. */
class TimeSorter
{
 public:
  explicit TimeSorter(std::int64_t window_ns) : window_ns_(window_ns) {}

  void push(mrpt::obs::CObservation::Ptr observation);

  /** An observation is due: the one pushed last is later by the window, or too many are held, or
   * too many points. */
  [[nodiscard]] bool ready() const;

  [[nodiscard]] bool empty() const { return held_.empty(); }

  /** The earliest one held. */
  [[nodiscard]] mrpt::obs::CObservation::Ptr pop();

 private:
  struct Held
  {
    std::uint64_t epoch;
    std::int64_t stamp_ns;
    std::uint64_t sequence;
    std::size_t points;
    mrpt::obs::CObservation::Ptr observation;
  };
  struct Later
  {
    bool operator()(const Held& a, const Held& b) const
    {
      if (a.epoch != b.epoch) return a.epoch > b.epoch;
      return a.stamp_ns != b.stamp_ns ? a.stamp_ns > b.stamp_ns : a.sequence > b.sequence;
    }
  };

  std::int64_t window_ns_;
  std::int64_t newest_ns_ = 0;  // of the observation pushed last
  std::uint64_t sequence_ = 0;
  std::uint64_t epoch_ = 0;  // times that time stepped back
  std::size_t points_ = 0;   // of all that are held
  std::priority_queue<Held, std::vector<Held>, Later> held_;
};

}  // namespace fastlio
