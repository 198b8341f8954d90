// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file paged_pool.h Numbered objects in pages that never move. */
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace fastlio
{
/** A pool of default-constructed objects addressed by number. Growth allocates one page and moves
 * nothing, so that its cost does not depend on what the pool holds; numbers given back are reused.
 */
template <class T, std::uint32_t kPageBits>
class PagedPool
{
 public:
  PagedPool() = default;
  ~PagedPool() = default;
  PagedPool(PagedPool&&) noexcept = default;
  PagedPool& operator=(PagedPool&&) noexcept = default;
  PagedPool(const PagedPool& other) : free_(other.free_), used_(other.used_)
  {
    for (const auto& page : other.pages_)
    {
      pages_.push_back(std::make_unique<T[]>(kPageSize));
      std::copy_n(page.get(), kPageSize, pages_.back().get());
    }
  }
  PagedPool& operator=(const PagedPool& other)
  {
    if (this != &other) *this = PagedPool(other);
    return *this;
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

  [[nodiscard]] std::size_t memoryBytes() const
  {
    return pages_.size() * kPageSize * sizeof(T) + free_.capacity() * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::uint32_t kPageSize = 1U << kPageBits;
  static constexpr std::uint32_t kMask = kPageSize - 1U;

  [[nodiscard]] std::uint32_t append()
  {
    if ((used_ & kMask) == 0) pages_.push_back(std::make_unique<T[]>(kPageSize));
    return used_++;
  }

  std::vector<std::unique_ptr<T[]>> pages_;
  std::vector<std::uint32_t> free_;
  std::uint32_t used_ = 0;
};

}  // namespace fastlio
