// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file angles.h Poses as six numbers. */
#pragma once

#include <fastlio/math/pose.h>

#include <array>

namespace fastlio
{
/** x, y, z [m], yaw, pitch, roll [deg]; R = Rz(yaw) Ry(pitch) Rx(roll). */
using SixNumbers = std::array<double, 6>;

[[nodiscard]] SixNumbers numbersFromPose(const Pose& pose);

}  // namespace fastlio
