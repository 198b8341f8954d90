// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file ros_messages.h Messages of ROS 1 and ROS 2 as observations. All functions throw
 * std::runtime_error for a message that is not what its type says. */
#pragma once

#include <fastlio/math/pose.h>
#include <fastlio/messages/wire_reader.h>

#include <mrpt/obs/CObservation.h>

#include <cstdint>
#include <string>
#include <vector>

namespace fastlio
{
/** std_msgs/Header. */
struct RosHeader
{
  std::int64_t stamp_ns = 0;
  std::string frame;
};
[[nodiscard]] RosHeader readRosHeader(WireReader& in);
/** Nanoseconds since 1970. */
[[nodiscard]] std::int64_t readRosTime(WireReader& in);

/** A converted message: an observation and the frame that it was measured in. */
struct RosObservation
{
  mrpt::obs::CObservation::Ptr observation;
  std::string frame;
};

/** \name By type. The label is that of the observation.
 * @{ */
[[nodiscard]] RosObservation readImu(WireReader& in, const std::string& label);
[[nodiscard]] RosObservation readPointCloud2(WireReader& in, const std::string& label);
[[nodiscard]] RosObservation readLivoxCustom(WireReader& in, const std::string& label);
[[nodiscard]] RosObservation readVelodyneScan(WireReader& in, const std::string& label);
/** A CObservationGPS with a GGA message and, where it is known, its covariance:
 * setStatedCovariance(). */
[[nodiscard]] RosObservation readNavSatFix(WireReader& in, const std::string& label);
[[nodiscard]] RosObservation readOdometry(WireReader& in, const std::string& label);
/** @} */

/** geometry_msgs/TransformStamped. */
struct RosTransform
{
  std::string parent, child;
  Pose T_parent_child;
};

/** tf2_msgs/TFMessage, without transforms whose numbers are not finite. */
[[nodiscard]] std::vector<RosTransform> readTransforms(WireReader& in);

}  // namespace fastlio
