// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sensor_imu.h Inertial samples of LiDARs as observations. */
#pragma once

#include <fastlio/math/so3.h>

#include <mrpt/obs/CObservationIMU.h>

#include <cstdint>
#include <string>

namespace fastlio
{
/** \param rate [rad/s]
 * \param acceleration [m/s^2] */
[[nodiscard]] mrpt::obs::CObservationIMU::Ptr makeImu(
    const std::string& label, std::int64_t stamp_ns, const Vec3& rate, const Vec3& acceleration);

}  // namespace fastlio
