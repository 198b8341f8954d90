// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file team.h Threads that stay awake between the short loops of a scan. */
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace fastlio
{
/** Helpers of one thread at its loops.
 *
 * A loop of some 50 us is over before a sleeping thread has woken up (10 to 50 us), and a scan has
 * a dozen of them. So a helper looks for the next loop for a while, giving way to other threads,
 * and sleeps only when none comes: between scans. A loop waits for the helpers that have joined it,
 * not for those that were too late: on a busy machine the calling thread does most of the work. */
class Team
{
 public:
  /** Does one chunk of a loop. */
  using ChunkCall = void (*)(const void* context, std::size_t chunk);

  /** Fewer helpers when the system gives no more threads. */
  explicit Team(std::size_t helpers);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /** Calls call(context, chunk) for each chunk below \a count on this thread and the helpers;
   * returns when all have ended.
   * \exception whatever was thrown first; chunks that had not begun
   * are left out then */
  void loop(std::size_t count, ChunkCall call, const void* context);

  /** Does something else. */
  using TaskCall = void (*)(const void* context);

  /** Lets a helper that is free call call(context) while this thread does other things. */
  void offer(TaskCall call, const void* context);

  /** Waits until the task that was offered has ended; does it if no helper has begun.
   * \exception whatever it threw */
  void settle();

  /** Settles where nobody cares any more: what no helper has begun is left out, what it throws is
   * dropped. */
  void withdraw() noexcept;

 private:
  /** Chunks that a member of the team takes first: always the same part of a loop, so that what it
   * wrote in one loop is still in its cache in the next. On a cache line of its own. */
  struct alignas(64) Share
  {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };

  void help(std::size_t member);
  [[nodiscard]] bool awaitNews(std::size_t seen);
  [[nodiscard]] bool join();
  void share(std::size_t count);
  void takeChunks(std::size_t member);
  void keepFailure();
  void announce();
  [[nodiscard]] bool takeTask();
  void doTask();
  void awaitTask();

  // The loop at hand: written while the gate is closed and nobody is inside, read inside.
  ChunkCall call_ = nullptr;
  const void* context_ = nullptr;
  std::vector<Share> shares_;  // the calling thread's, then the helpers'
  std::exception_ptr failure_;
  std::mutex failure_mutex_;

  // The task at hand: written while there is none, read by the one who has taken it.
  enum class TaskState
  {
    None,
    Offered,
    Taken,
    Done
  };
  TaskCall task_ = nullptr;
  const void* task_context_ = nullptr;
  std::exception_ptr task_failure_;
  std::atomic<TaskState> task_state_{TaskState::None};

  static constexpr std::uint32_t kOpen = 1U << 31U;
  std::atomic<std::uint32_t> gate_{0};  // kOpen while helpers may join, plus how many are inside
  std::atomic<std::size_t> news_{0};    // loops and tasks so far
  std::atomic<std::size_t> sleeping_{0};
  std::atomic<bool> stop_{false};
  std::mutex sleep_mutex_;
  std::condition_variable wake_up_;
  std::vector<std::thread> helpers_;
};

}  // namespace fastlio
