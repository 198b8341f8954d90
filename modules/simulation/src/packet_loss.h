// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file packet_loss.h Packets of a LiDAR that never arrive (internal). */
#pragma once

#include <fastlio/simulation/lidar_model.h>

#include <vector>

namespace fastlio
{
/** Which packets of sweep number \a index are lost: single ones, and all during outages.
 * \return per packet of the sweep; empty when no packet is ever lost */
[[nodiscard]] std::vector<bool> lostPackets(
    const Sweep& sweep, std::size_t index, const SimulationSettings& settings);

}  // namespace fastlio
