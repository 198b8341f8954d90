// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file folder_writers.h Recordings as folders of files, and as captures, for tests. */
#pragma once

#include "capture_writer.h"
#include "test_files.h"

#include <string>
#include <vector>

namespace fastlio::testing
{
/** The inertial samples as a table with the columns time [ns], wx, wy, wz, ax, ay, az. */
std::string imuTableOf(const std::vector<Object>& objects);

/** Velodyne's packets, each with the time of its first firing. */
std::vector<SentPacket> packetsOf(const std::vector<Object>& objects);

/** PCD files with times [ns] and lines, named by their stamps, and imu.csv. */
void writePcdFolder(const std::string& folder, const std::vector<Object>& objects);

/** A drive of KITTI's raw data; clouds lose their times and lines. */
void writeKittiDrive(const std::string& folder, const std::vector<Object>& objects);

}  // namespace fastlio::testing
