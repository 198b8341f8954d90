// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file register_classes.h Makes the classes of recordings known to MRPT's class registry. */
#pragma once

namespace fastlio
{
/** Registers every class that this module reads or writes, among them CPointsMapXYZIRT where MRPT
 * lacks it, and CGenericPointsMap. Call it before reading or writing streams; RawlogSource does so
 * itself. Repeated calls and calls from several threads are fine. */
void registerBridgeClasses();

}  // namespace fastlio
