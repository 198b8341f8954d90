// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file side_by_side.h The order of a world's bodies (internal). */
#pragma once

#include <fastlio/worlds/primitive.h>

#include <vector>

namespace fastlio
{
/** Puts bodies that are near to each other side by side. Of two bodies that touch, the later one is
 * seen: recordings depend on the order. */
void sortSideBySide(std::vector<Primitive>& bodies);

}  // namespace fastlio
