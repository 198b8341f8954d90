// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file gravity.h The unit g of accelerations. */
#pragma once

namespace fastlio
{
constexpr double kStandardGravity = 9.80665;  // [m/s^2]

}  // namespace fastlio
