// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file packet_loss.h Packets of a LiDAR that never arrive. */
#pragma once

#include <fastlio/simulation/lidar_model.h>

#include <vector>

namespace fastlio
{
/** Which packets of a sweep are lost: single ones, and all during outages. */
class PacketLoss
{
 public:
  explicit PacketLoss(const SimulationSettings& settings) : settings_(settings) {}

  /** \return per packet of the sweep; empty when no packet is ever lost */
  [[nodiscard]] std::vector<bool> lostOf(const Sweep& sweep, std::size_t index) const;

 private:
  [[nodiscard]] bool inOutage(double t) const;

  SimulationSettings settings_;
};

}  // namespace fastlio
