// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Compiled with the flags of the libraries.

#include "public_types.h"

std::vector<fastlio::testing::TypeLayout> fastlio::testing::nativeLayouts()
{
  return FASTLIO_PUBLIC_LAYOUTS;
}
