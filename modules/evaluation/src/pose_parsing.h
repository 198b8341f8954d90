// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pose_parsing.h From columns of text to poses; shared by the readers. */
#pragma once

#include "text_numbers.h"
#include <fastlio/evaluation/trajectory.h>

namespace fastlio
{
/** Pose from the columns x y z qx qy qz qw; fails when the quaternion is not of unit length. */
[[nodiscard]] Pose parsePoseQuaternion(
    const std::vector<std::string_view>& seven_columns, const TextPlace& place);

/** Adds a pose; fails when its stamp is not newer than the last one. */
void appendPose(Trajectory& trajectory, const StampedPose& pose, const TextPlace& place);

}  // namespace fastlio
