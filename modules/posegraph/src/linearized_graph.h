// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file linearized_graph.h The normal equations of a pose graph at an estimate (internal). */
#pragma once

#include "normal_equations.h"

#include <vector>

namespace fastlio
{
/** Where the unknowns of a graph begin: nodes, the vertical, errors of the sensors, the earth. */
class GraphLayout
{
 public:
  static constexpr int kNode = 6;
  static constexpr int kUp = 2;

  explicit GraphLayout(const PoseGraph& graph)
      : nodes_(static_cast<int>(graph.nodes.size())),
        has_up_(!graph.tilts.empty()),
        has_earth_(graph.T_earth_world.has_value())
  {
    sensors_at_.push_back(upAt() + (has_up_ ? kUp : 0));
    for (const Eigen::MatrixXd& sensor : graph.sensor_covariances)
      sensors_at_.push_back(sensors_at_.back() + static_cast<int>(sensor.cols()));
  }

  [[nodiscard]] bool hasUp() const { return has_up_; }
  [[nodiscard]] bool hasEarth() const { return has_earth_; }
  [[nodiscard]] static int at(std::size_t node) { return static_cast<int>(node) * kNode; }
  [[nodiscard]] int upAt() const { return nodes_ * kNode; }
  [[nodiscard]] int sensorAt(std::size_t sensor) const { return sensors_at_[sensor]; }
  [[nodiscard]] int errorsOf(std::size_t sensor) const
  {
    return sensors_at_[sensor + 1] - sensors_at_[sensor];
  }
  [[nodiscard]] int earthAt() const { return sensors_at_.back(); }
  [[nodiscard]] int size() const { return earthAt() + (has_earth_ ? kNode : 0); }

 private:
  int nodes_;
  bool has_up_, has_earth_;
  std::vector<int> sensors_at_;  // and the end of the last one
};

/** At the poses and with the weights of an estimate. */
[[nodiscard]] NormalEquations linearized(
    const PoseGraph& graph, const Informations& informations, const GraphEstimate& estimate,
    const GraphLayout& layout);

}  // namespace fastlio
