// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plugin.cpp One library that MRPT programs load to know everything of this project:
 *
 *     rawlog-edit -p libmrpt_fastlio_plugin.so ...
 *     LD_PRELOAD=libmrpt_fastlio_plugin.so icp-slam ...
 *
 * It has no interface of its own: loading it registers the classes. */

#include <fastlio/slam/CLidarInertialOdometry.h>

#include <mrpt/core/initializer.h>

MRPT_INITIALIZER(registerFastlioPluginClasses)
{
  fastlio::registerSlamClasses();
}
