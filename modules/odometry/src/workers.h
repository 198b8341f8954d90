// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file workers.h Loops over chunks of points on several cores, with the same result on any
 * number.
 */
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace fastlio
{
/** Runs chunks in an arena of its own, so that other users of the thread pool are not disturbed.
 * Chunks have a fixed size: what is summed per chunk and then over the chunks in order does not
 * depend on the number of threads. */
class Workers
{
 public:
  static constexpr std::size_t kChunk = 256;

  /** \param threads 0: all cores */
  explicit Workers(int threads)
  {
    if (threads != 1)
      arena_ = std::make_unique<tbb::task_arena>(
          threads > 0 ? threads : static_cast<int>(tbb::task_arena::automatic));
  }

  [[nodiscard]] static std::size_t chunks(std::size_t n) { return (n + kChunk - 1) / kChunk; }

  /** Calls body(chunk, first, last) for each chunk of [0, n). */
  template <typename Body>
  void forEachChunk(std::size_t n, const Body& body)
  {
    const auto run = [&](std::size_t chunk)
    { body(chunk, chunk * kChunk, std::min(n, (chunk + 1) * kChunk)); };
    if (!arena_ || chunks(n) < 2)
    {
      for (std::size_t chunk = 0; chunk < chunks(n); ++chunk)
        run(chunk);
      return;
    }
    arena_->execute([&] { tbb::parallel_for(std::size_t{0}, chunks(n), run); });
  }

 private:
  std::unique_ptr<tbb::task_arena> arena_;
};

}  // namespace fastlio
