// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "page_arena.h"

#include <algorithm>
#include <new>
#include <sys/mman.h>

namespace fastlio
{
namespace
{
constexpr std::size_t kCacheLine = 64;
constexpr std::size_t kLargePage = std::size_t{2} << 20U;  // of x86-64 and of AArch64
// Slabs double up to a large page: a small map, of which there may be hundreds, wastes little.
constexpr std::size_t kFirstSlab = kLargePage / 16;

std::size_t roundedUp(std::size_t bytes, std::size_t multiple)
{
  return (bytes + multiple - 1) / multiple * multiple;
}
}  // namespace

void* PageArena::allocate(std::size_t bytes)
{
  const std::size_t needed = roundedUp(bytes, kCacheLine);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (size_ - used_ < needed) addSlab(needed);
  void* const memory = slabs_.back().get() + used_;
  used_ += needed;
  return memory;
}

void PageArena::addSlab(std::size_t at_least)
{
  const std::size_t doubled = std::clamp(2 * size_, kFirstSlab, kLargePage);
  const std::size_t size = roundedUp(std::max(doubled, at_least), kFirstSlab);
  const std::size_t alignment = size >= kLargePage ? kLargePage : kCacheLine;
  std::unique_ptr<std::byte, Free> slab(
      static_cast<std::byte*>(std::aligned_alloc(alignment, roundedUp(size, alignment))));
  if (slab == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // A wish only: without large pages everything works as well.
  if (size >= kLargePage) (void)madvise(slab.get(), size, MADV_HUGEPAGE);
#endif
  slabs_.push_back(std::move(slab));
  size_ = size;
  used_ = 0;
}

}  // namespace fastlio
