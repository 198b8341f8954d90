// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file fresh_queue.h Observations from a driver's thread to the odometry's, with a bounded delay.
 */
#pragma once

#include <mrpt/obs/CObservation.h>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>

namespace fastlio
{
/** Counts of the elements that went through a queue. */
struct FreshQueueCounts
{
  std::size_t scans = 0;            //!< that were put in
  std::size_t dropped_scans = 0;    //!< of these, because newer ones were waiting
  std::size_t samples = 0;          //!< inertial samples that were put in
  std::size_t dropped_samples = 0;  //!< of these, because nobody took them out
};

/** When the odometry falls behind, the oldest scan goes: a pose of now is worth more than all poses
 * late. Inertial samples stay, because the prediction needs each of them; they are small. All
 * functions may be called from any thread. */
class FreshQueue
{
 public:
  /** \param most_scans that wait; a scan that is being processed has left the queue */
  explicit FreshQueue(std::size_t most_scans = 2) : most_scans_(most_scans) {}

  /** Puts an observation in. Everything but inertial samples counts as a scan. */
  void push(mrpt::obs::CObservation::Ptr observation);

  /** The oldest observation; waits for one. Null: the queue is closed and empty. */
  [[nodiscard]] mrpt::obs::CObservation::Ptr pop();

  /** No more observations: pop() gives what is left, and then null. */
  void close();

  [[nodiscard]] FreshQueueCounts counts() const;

 private:
  void dropOldest(bool samples);

  const std::size_t most_scans_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<mrpt::obs::CObservation::Ptr> waiting_;
  std::size_t waiting_scans_ = 0;
  FreshQueueCounts counts_;
  bool closed_ = false;
};

}  // namespace fastlio
