// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file page_arena.h Memory for all pages of a map. */
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <vector>

namespace fastlio
{
/** Hands out memory from slabs and takes none back: it lives as long as the arena. A map that has
 * grown beyond a few megabytes gets slabs that the system backs with large pages where it can. A
 * scan's points lie anywhere in a map, and with pages of 4 kB nearly each of them would need a
 * translation of its address that the processor does not have at hand. */
class PageArena
{
 public:
  PageArena() = default;

  /** \return memory for so many bytes, aligned to a cache line. Several threads may call it.
   * \exception std::bad_alloc there is none */
  [[nodiscard]] void* allocate(std::size_t bytes);

 private:
  struct Free
  {
    void operator()(void* memory) const { std::free(memory); }
  };

  void addSlab(std::size_t at_least);

  std::mutex mutex_;
  std::vector<std::unique_ptr<std::byte, Free>> slabs_;
  std::size_t size_ = 0;  // of the last slab
  std::size_t used_ = 0;  // of it
};

}  // namespace fastlio
