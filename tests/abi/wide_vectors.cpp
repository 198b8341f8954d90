// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for the widest vectors, where Eigen aligns fixed-size types to 64 bytes, and never run:
// such an alignment must not get into a public type.

#include "public_types.h"

namespace fastlio
{
#define FASTLIO_CHECK(Type) \
  static_assert(alignof(Type) <= alignof(std::max_align_t), #Type " must be Eigen::DontAlign");
FASTLIO_PUBLIC_TYPES(FASTLIO_CHECK)
}  // namespace fastlio
