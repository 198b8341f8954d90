// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file workers.h Loops over chunks of points on several cores, with the same result on any
 * number. */
#pragma once

#include <cstddef>
#include <memory>

namespace fastlio
{
class Team;

/** Runs the chunks of a loop on several threads of its own. They stay awake between loops that
 * follow each other within 0.2 ms, and sleep otherwise.
 *
 * Chunks have a fixed size: what is computed per chunk and then joined in the order of the chunks
 * does not depend on the number of threads. A loop allocates nothing. Loops of one object may not
 * run at the same time. */
class Workers
{
 public:
  /** Points per chunk where the caller does not choose: some 10 us of work. */
  static constexpr std::size_t kChunk = 256;

  /** \param threads at most so many, the calling one included; 0 or less: all cores */
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /** Number of chunks of a loop over n items. */
  [[nodiscard]] static std::size_t chunks(std::size_t n, std::size_t chunk_size = kChunk)
  {
    return (n + chunk_size - 1) / chunk_size;
  }

  /** Calls body(chunk, first, last) once for each chunk [first, last) of [0, n), in any order and
   * on any thread.
   * \exception whatever the body threw, once the running chunks have ended */
  template <typename Body>
  void forEachChunk(std::size_t n, std::size_t chunk_size, const Body& body) const
  {
    const auto call = [](const void* b, std::size_t chunk, std::size_t first, std::size_t last)
    { (*static_cast<const Body*>(b))(chunk, first, last); };
    loop(n, chunk_size, call, &body);
  }

  template <typename Body>
  void forEachChunk(std::size_t n, const Body& body) const
  {
    forEachChunk(n, kChunk, body);
  }

  /** Calls body(i) once for each i of [0, n), each a task of its own. */
  template <typename Body>
  void forEach(std::size_t n, const Body& body) const
  {
    forEachChunk(n, 1, [&](std::size_t i, std::size_t, std::size_t) { body(i); });
  }

  /** Does \a task, which is not divided and has no loops, on another thread if one is free, while
   * the calling one does \a main, loops included. Neither may touch what the other writes.
   * \exception whatever \a main threw, or else the task, once both have ended */
  template <typename Task, typename Main>
  void alongside(const Task& task, const Main& main) const
  {
    together({callOf<Task>, &task}, {callOf<Main>, &main});
  }

 private:
  /** Something to call that is kept by the caller. */
  struct Call
  {
    void (*function)(const void* callable);
    const void* callable;
  };
  template <typename Callable>
  static void callOf(const void* callable)
  {
    (*static_cast<const Callable*>(callable))();
  }
  void together(const Call& task, const Call& main) const;

  using ChunkCall =
      void (*)(const void* body, std::size_t chunk, std::size_t first, std::size_t last);
  void loop(std::size_t n, std::size_t chunk_size, ChunkCall call, const void* body) const;

  std::unique_ptr<Team> team_;  // none: the calling thread does it all
};

}  // namespace fastlio
