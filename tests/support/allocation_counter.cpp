// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "allocation_counter.h"

#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace
{
std::atomic<std::size_t> calls{0};
std::atomic<std::size_t> live_bytes{0};
std::atomic<std::size_t> failing_call{0};  // 0: none

void count()
{
  if (++calls == failing_call) throw std::bad_alloc();
}

void* countedAllocation(std::size_t size)
{
  count();
  void* p = std::malloc(size == 0 ? 1 : size);  // NOLINT(cppcoreguidelines-no-malloc): below new
  if (p == nullptr) throw std::bad_alloc();
  live_bytes += malloc_usable_size(p);
  return p;
}

void* countedAllocation(std::size_t size, std::align_val_t alignment)
{
  count();
  const auto multiple = static_cast<std::size_t>(alignment);
  void* p = std::aligned_alloc(multiple, (size + multiple - 1) / multiple * multiple);
  if (p == nullptr) throw std::bad_alloc();
  live_bytes += malloc_usable_size(p);
  return p;
}

void countedFree(void* p)
{
  if (p != nullptr) live_bytes -= malloc_usable_size(p);
  std::free(p);  // NOLINT(cppcoreguidelines-no-malloc): below delete
}
}  // namespace

std::size_t fastlio::testing::allocationCount()
{
  return calls;
}

std::size_t fastlio::testing::allocatedBytes()
{
  return live_bytes;
}

void fastlio::testing::failAllocation(std::size_t n)
{
  failing_call = n == 0 ? 0 : calls + n;
}

void* operator new(std::size_t size)
{
  return countedAllocation(size);
}
void* operator new[](std::size_t size)
{
  return countedAllocation(size);
}
void operator delete(void* p) noexcept
{
  countedFree(p);
}
void operator delete[](void* p) noexcept
{
  countedFree(p);
}
void operator delete(void* p, std::size_t) noexcept
{
  countedFree(p);
}
void operator delete[](void* p, std::size_t) noexcept
{
  countedFree(p);
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
  return countedAllocation(size, alignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment)
{
  return countedAllocation(size, alignment);
}
void operator delete(void* p, std::align_val_t) noexcept
{
  countedFree(p);
}
void operator delete[](void* p, std::align_val_t) noexcept
{
  countedFree(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept
{
  countedFree(p);
}
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept
{
  countedFree(p);
}
