// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file allocation_counter.h Counts what goes through the global operator new of a test program,
 * and lets it fail. */
#pragma once

#include <cstddef>

namespace fastlio::testing
{
/** Calls of operator new since the program's start. */
[[nodiscard]] std::size_t allocationCount();

/** Bytes that are allocated now. */
[[nodiscard]] std::size_t allocatedBytes();

/** The call number \a n from now on throws std::bad_alloc, once; 0: none does. */
void failAllocation(std::size_t n);

}  // namespace fastlio::testing
