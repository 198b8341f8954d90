// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ros2_definitions.h The definitions of messages that tools want in a file. */
#pragma once

#include <string>

namespace fastlio
{
/** In the format "ros2msg", with all parts; empty: the type is not written.
 * \param type "sensor_msgs/msg/Imu" */
[[nodiscard]] std::string ros2DefinitionOf(const std::string& type);

}  // namespace fastlio
