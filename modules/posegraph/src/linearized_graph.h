// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file linearized_graph.h The normal equations of a pose graph at an estimate (internal). */
#pragma once

#include "normal_equations.h"

namespace fastlio
{
/** Where the unknowns of a graph begin: nodes, the vertical, errors of the sensors, the earth. */
class GraphLayout
{
 public:
  static constexpr int kNode = 6;
  static constexpr int kUp = 2;
  static constexpr int kBias = 3;

  explicit GraphLayout(const PoseGraph& graph)
      : nodes_(static_cast<int>(graph.nodes.size())),
        sensors_(static_cast<int>(graph.sensors.size())),
        has_up_(!graph.tilts.empty()),
        has_earth_(graph.T_earth_world.has_value())
  {
  }

  [[nodiscard]] bool hasUp() const { return has_up_; }
  [[nodiscard]] bool hasEarth() const { return has_earth_; }
  [[nodiscard]] static int at(std::size_t node) { return static_cast<int>(node) * kNode; }
  [[nodiscard]] int upAt() const { return nodes_ * kNode; }
  [[nodiscard]] int driftAt(std::size_t sensor) const
  {
    return upAt() + (has_up_ ? kUp : 0) + static_cast<int>(sensor) * (kNode + kBias);
  }
  [[nodiscard]] int biasAt(std::size_t sensor) const { return driftAt(sensor) + kNode; }
  [[nodiscard]] int earthAt() const { return driftAt(static_cast<std::size_t>(sensors_)); }
  [[nodiscard]] int size() const { return earthAt() + (has_earth_ ? kNode : 0); }

 private:
  int nodes_, sensors_;
  bool has_up_, has_earth_;
};

/** At the poses and with the weights of an estimate. */
[[nodiscard]] NormalEquations linearized(
    const PoseGraph& graph, const Informations& informations, const GraphEstimate& estimate,
    const GraphLayout& layout);

}  // namespace fastlio
