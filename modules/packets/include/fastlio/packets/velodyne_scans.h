// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file velodyne_scans.h Raw packets of a Velodyne as MRPT's observation. */
#pragma once

#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace fastlio
{
/** Of a data packet without the heads of the network. */
inline constexpr std::size_t kVelodynePacketBytes = 1206;

/** Points to so many bytes. */
using VelodynePacketBytes = const std::uint8_t*;

/** The calibration is the default of the model that the packets name.
 * \param stamp_ns of the first packet
 * \exception std::runtime_error no packets */
[[nodiscard]] mrpt::obs::CObservationVelodyneScan::Ptr makeVelodyneScan(
    const std::vector<VelodynePacketBytes>& packets, const std::string& label,
    std::int64_t stamp_ns);

}  // namespace fastlio
