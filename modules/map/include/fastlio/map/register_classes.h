// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file register_classes.h Makes the map classes known to MRPT's factories. */
#pragma once

namespace fastlio
{
/** Registers the classes of this module with mrpt::rtti, so that archives holding them can be read
 * by any MRPT program that loads this library. It runs by itself when the library is loaded;
 * calling it again is harmless, and it keeps linkers from dropping a library that is used by name
 * only. */
void registerMapClasses();

}  // namespace fastlio
