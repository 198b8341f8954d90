// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Compiled with the flags of the libraries.

#include "public_types.h"

std::vector<fastlio::test::TypeLayout> fastlio::test::nativeLayouts()
{
  return FASTLIO_PUBLIC_LAYOUTS;
}
