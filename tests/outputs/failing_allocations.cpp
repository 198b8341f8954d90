// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Memory of the process, one piece of which is refused.

#include "injection.h"

#include <cerrno>
#include <cstdlib>
#include <new>

using fastlio::testing::failsNow;

// Memory is what is made here. NOLINTBEGIN(cppcoreguidelines-no-malloc)

namespace
{
void* refusable(std::size_t size, std::size_t alignment)
{
  if (failsNow("new", "")) throw std::bad_alloc();
  void* memory = alignment == 0 ? malloc(size == 0 ? 1 : size) : nullptr;
  if (alignment > 0 && posix_memalign(&memory, alignment, size) != 0) memory = nullptr;
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

void* operator new(std::size_t size)
{
  return refusable(size, 0);
}

void* operator new[](std::size_t size)
{
  return refusable(size, 0);
}

void* operator new(std::size_t size, std::align_val_t alignment)
{
  return refusable(size, static_cast<std::size_t>(alignment));
}

void* operator new[](std::size_t size, std::align_val_t alignment)
{
  return refusable(size, static_cast<std::size_t>(alignment));
}

void operator delete(void* memory) noexcept
{
  free(memory);
}

void operator delete[](void* memory) noexcept
{
  free(memory);
}

void operator delete(void* memory, std::size_t /*size*/) noexcept
{
  free(memory);
}

void operator delete[](void* memory, std::size_t /*size*/) noexcept
{
  free(memory);
}

void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept
{
  free(memory);
}

void operator delete[](void* memory, std::align_val_t /*alignment*/) noexcept
{
  free(memory);
}

void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept
{
  free(memory);
}

void operator delete[](void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept
{
  free(memory);
}
// NOLINTEND(cppcoreguidelines-no-malloc)
