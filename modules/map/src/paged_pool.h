// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file paged_pool.h Numbered objects in pages that never move. */
#pragma once

#include "page_arena.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

namespace fastlio
{
/** A pool of default-constructed objects addressed by number. Growth allocates one page and moves
 * nothing, so that its cost does not depend on what the pool holds; numbers given back are reused.
 * The arena, which has the memory, must live longer. */
template <class T, std::uint32_t kPageBits>
class PagedPool
{
  static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>);

 public:
  explicit PagedPool(PageArena& arena) : arena_(&arena) {}
  /** A copy of \a other in other memory. */
  PagedPool(const PagedPool& other, PageArena& arena)
      : arena_(&arena), free_(other.free_), used_(other.used_)
  {
    for (const T* page : other.pages_)
      std::copy_n(page, kPageSize, addPage());
  }

  [[nodiscard]] T& operator[](std::uint32_t i) { return pages_[i >> kPageBits][i & kMask]; }
  [[nodiscard]] const T& operator[](std::uint32_t i) const
  {
    return pages_[i >> kPageBits][i & kMask];
  }

  /** Number of a free object, reset to T{}. */
  [[nodiscard]] std::uint32_t acquire()
  {
    if (free_.empty()) return append();
    const std::uint32_t i = free_.back();
    free_.pop_back();
    (*this)[i] = T{};
    return i;
  }

  /** Numbers in use are below this. */
  [[nodiscard]] std::uint32_t end() const { return used_; }

  void release(std::uint32_t i) { free_.push_back(i); }

 private:
  static constexpr std::uint32_t kPageSize = 1U << kPageBits;
  static constexpr std::uint32_t kMask = kPageSize - 1U;

  [[nodiscard]] std::uint32_t append()
  {
    if ((used_ & kMask) == 0) addPage();
    return used_++;
  }

  T* addPage()
  {
    T* const page = static_cast<T*>(arena_->allocate(kPageSize * sizeof(T)));
    std::uninitialized_default_construct_n(page, kPageSize);
    return pages_.emplace_back(page);
  }

  PageArena* arena_;  // whose memory the pages are
  std::vector<T*> pages_;
  std::vector<std::uint32_t> free_;
  std::uint32_t used_ = 0;
};

}  // namespace fastlio
