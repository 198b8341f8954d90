// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/parallel/stack_anchor.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace fastlio
{
namespace
{
constexpr std::uintptr_t kLine = 64;

/** Where in its cache line a number on the stack lies. */
[[gnu::noinline]] std::uintptr_t placeOnStack()
{
  volatile double number = 0.0;
  return reinterpret_cast<std::uintptr_t>(&number) % kLine;
}

[[gnu::noinline]] std::uintptr_t anchored()
{
  const StackAnchor anchor;
  return placeOnStack();
}

/** The result of \a place so many bytes further down. */
[[gnu::noinline]] std::uintptr_t below(std::size_t bytes, std::uintptr_t (*place)())
{
  auto* gap = static_cast<volatile char*>(__builtin_alloca(bytes));
  gap[0] = 0;
  const std::uintptr_t found = place();
  gap[0] = 1;  // so that the gap is there till now
  return found;
}

TEST(StackAnchor, PutsWhatIsBelowItAtOnePlace)
{
  std::set<std::uintptr_t> free, held;
  for (std::size_t bytes = 16; bytes <= 256; bytes += 16)
  {
    free.insert(below(bytes, placeOnStack));
    held.insert(below(bytes, anchored));
  }
  EXPECT_GT(free.size(), 1U);
  EXPECT_EQ(held.size(), 1U);
}
}  // namespace
}  // namespace fastlio
