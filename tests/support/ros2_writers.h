// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ros2_writers.h Containers of ROS 2 for tests, written from the documents of the formats. */
#pragma once

#include "bag_writers.h"

#include <string>
#include <vector>

namespace fastlio::testing
{
/** MCAP; the encoding is cdr, or ros1. */
std::string mcapOf(
    const std::vector<TopicMessage>& messages, const BagStyle& style = {},
    const std::string& encoding = "cdr");

/** An SQLite database with the tables of rosbag2. */
void writeDb3(const std::string& path, const std::vector<TopicMessage>& messages);

}  // namespace fastlio::testing
