// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file newer_points_maps.h MRPT's own point maps as MRPT 2.15.3 and newer write them (internal).
 */
#pragma once

namespace fastlio
{
/** From 2.15.3 on, the options of insertion within the stream of every point map have a form that
 * older versions refuse. Makes archives read CSimplePointsMap and CPointsMapXYZI in both forms; the
 * objects are of MRPT's classes and are saved as such. Nothing to do on newer versions. */
void registerNewerPointsMaps();

}  // namespace fastlio
