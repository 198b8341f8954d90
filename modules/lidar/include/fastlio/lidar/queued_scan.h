// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file queued_scan.h A scan that waits for its inertial data. */
#pragma once

#include <fastlio/lidar/scan.h>

#include <deque>

namespace fastlio
{
/** A scan and its time span, found once. */
struct QueuedScan
{
  LidarScan scan;
  ScanSpan span;
};

/** Oldest first. */
using ScanQueue = std::deque<QueuedScan>;

}  // namespace fastlio
