// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "linearized_graph.h"

#include <fastlio/posegraph/graph_factors.h>

namespace fastlio
{
namespace
{
using Aligned6 = Eigen::Matrix<double, 6, 6>;
using Dynamic = Eigen::MatrixXd;

constexpr int kNode = GraphLayout::kNode;
// Gravity is the same for both, but its vertical is not quite the normal of the ellipsoid: they are
// 0.03 mrad apart on average, 0.5 mrad in high mountains. This lies between [rad].
constexpr double kEarthTilt = 3e-4;

class Linearization
{
 public:
  Linearization(
      const PoseGraph& graph, const Informations& informations, const GraphEstimate& estimate,
      const GraphLayout& layout)
      : graph_(graph), informations_(informations), estimate_(estimate), layout_(layout)
  {
  }

  [[nodiscard]] NormalEquations run() const
  {
    NormalEquations equations(layout_.size(), layout_.upAt());
    const EdgeError first = errorOf(RelativePose{graph_.nodes.front(), {}}, Pose{}, node(0));
    equations.add(first.value, informations_.first, PartOf{0, first.by_b});
    addEdges(equations);
    addTilts(equations);
    for (std::size_t i = 0; i < graph_.sensor_covariances.size(); ++i)
    {
      const int errors = layout_.errorsOf(i);
      equations.add(
          estimate_.sensor_errors[i], informations_.sensors[i],
          PartOf{layout_.sensorAt(i), Dynamic(Dynamic::Identity(errors, errors))});
    }
    addPositions(equations);
    return equations;
  }

 private:
  [[nodiscard]] const Pose& node(std::size_t i) const { return estimate_.nodes[i]; }

  void addTilts(NormalEquations& equations) const
  {
    for (std::size_t i = 0; i < graph_.tilts.size(); ++i)
    {
      const TiltFactor& factor = graph_.tilts[i];
      const TiltError error = errorOf(factor, node(factor.node), estimate_.up);
      const PartOf by_attitude{GraphLayout::at(factor.node), error.by_attitude};
      const PartOf by_up{layout_.upAt(), error.by_up};
      addWithSensor(
          equations, error.value, informations_.tilts[i], factor.sensor, error.by_sensor,
          by_attitude, by_up);
    }
  }

  void addEdges(NormalEquations& equations) const
  {
    for (std::size_t i = 0; i < graph_.edges.size(); ++i)
    {
      const GraphEdge& edge = graph_.edges[i];
      if (estimate_.edge_weights[i] <= 0.0) continue;
      const EdgeError error = errorOf(edge.measured, node(edge.a), node(edge.b));
      const Aligned6 information = estimate_.edge_weights[i] * informations_.edges[i];
      const PartOf by_a{GraphLayout::at(edge.a), error.by_a},
          by_b{GraphLayout::at(edge.b), error.by_b};
      addWithSensor(equations, error.value, information, edge.sensor, edge.by_sensor, by_a, by_b);
    }
  }

  /** A measurement that may have errors of a sensor. \param parts by the other unknowns */
  template <typename Error, typename Information, typename... Parts>
  void addWithSensor(
      NormalEquations& equations, const Error& error, const Information& information,
      std::size_t sensor, const Dynamic& by_sensor, const Parts&... parts) const
  {
    if (by_sensor.cols() == 0) return equations.add(error, information, parts...);
    const Error value = error + by_sensor * estimate_.sensor_errors[sensor];
    equations.add(value, information, parts..., PartOf{layout_.sensorAt(sensor), by_sensor});
  }

  void addPositions(NormalEquations& equations) const
  {
    if (!layout_.hasEarth()) return;
    const Pose& T_earth_world = *estimate_.T_earth_world;
    for (std::size_t i = 0; i < graph_.positions.size(); ++i)
    {
      const PositionFactor& factor = graph_.positions[i];
      if (estimate_.position_weights[i] <= 0.0) continue;
      const PositionError error = errorOf(factor, node(factor.node), T_earth_world);
      equations.add(
          error.value, (estimate_.position_weights[i] * informations_.positions[i]).eval(),
          PartOf{GraphLayout::at(factor.node), error.by_node},
          PartOf{layout_.earthAt(), error.by_earth});
    }
    levelEarth(equations);
    // Keeps the system solvable where positions do not determine the heading.
    equations.addBlock(layout_.earthAt(), layout_.earthAt(), (1e-9 * Aligned6::Identity()).eval());
  }

  /** The earth's z axis points up, too. */
  void levelEarth(NormalEquations& equations) const
  {
    const Mat3& R = estimate_.T_earth_world->R;
    const Vec3 up = R * estimate_.up;
    const Eigen::Vector2d error = up.head<2>();
    const Eigen::Matrix2d information = Eigen::Matrix2d::Identity() / (kEarthTilt * kEarthTilt);
    Eigen::Matrix<double, 2, kNode> by_earth = Eigen::Matrix<double, 2, kNode>::Zero();
    by_earth.leftCols<3>() = -(R * skew(estimate_.up)).topRows<2>();
    const Eigen::Matrix2d by_up = (R * acrossOf(estimate_.up)).topRows<2>();
    if (layout_.hasUp())
      equations.add(
          error, information, PartOf{layout_.earthAt(), by_earth}, PartOf{layout_.upAt(), by_up});
    else
      equations.add(error, information, PartOf{layout_.earthAt(), by_earth});
  }

  const PoseGraph& graph_;
  const Informations& informations_;
  const GraphEstimate& estimate_;
  const GraphLayout& layout_;
};
}  // namespace

NormalEquations linearized(
    const PoseGraph& graph, const Informations& informations, const GraphEstimate& estimate,
    const GraphLayout& layout)
{
  return Linearization(graph, informations, estimate, layout).run();
}

}  // namespace fastlio
