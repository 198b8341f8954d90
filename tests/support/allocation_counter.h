// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file allocation_counter.h Counts what goes through the global operator new of a test program.
 */
#pragma once

#include <cstddef>

namespace fastlio::testing
{
/** Calls of operator new since the program's start. */
[[nodiscard]] std::size_t allocationCount();

/** Bytes that are allocated now. */
[[nodiscard]] std::size_t allocatedBytes();

}  // namespace fastlio::testing
