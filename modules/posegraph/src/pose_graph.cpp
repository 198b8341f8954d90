// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "linearized_graph.h"
#include "selected_inverse.h"
#include <fastlio/math/robust_weight.h>
#include <fastlio/posegraph/graph_factors.h>
#include <fastlio/posegraph/pose_graph.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;
using Aligned6 = Eigen::Matrix<double, 6, 6>;

constexpr double kEdgeQuantile = 22.46;   // chi-square, 6 degrees of freedom, 99.9 %
constexpr int kMostIterations = 30;       // of Gauss-Newton
constexpr int kMostStages = 60;           // of graduated non-convexity
constexpr double kConvexityFactor = 1.4;  // by the paper
constexpr double kSmallStep = 1e-9;       // [rad, m]

class Optimizer
{
 public:
  explicit Optimizer(const PoseGraph& graph)
      : graph_(graph), informations_(informationsOf(graph)), layout_(graph)
  {
    estimate_.nodes = graph.nodes;
    estimate_.up = graph.up;
    for (const Eigen::MatrixXd& sensor : graph.sensor_covariances)
      estimate_.sensor_errors.emplace_back(Vector::Zero(sensor.cols()));
    estimate_.T_earth_world = graph.T_earth_world;
    estimate_.edge_weights.assign(graph.edges.size(), 1.0);
    estimate_.position_weights.assign(graph.positions.size(), 1.0);
  }

  GraphEstimate run(bool with_covariances)
  {
    if (graph_.nodes.empty()) return std::move(estimate_);
    settle();
    makeRobust();
    if (with_covariances) findCovariances();
    return std::move(estimate_);
  }

 private:
  [[nodiscard]] const Pose& node(std::size_t i) const { return estimate_.nodes[i]; }

  static void move(Pose& pose, const Vector& step, int begin)
  {
    pose.R = normalizeRotation(pose.R * expSO3(step.segment<3>(begin)));
    pose.p += step.segment<3>(begin + 3);
  }

  void moveCommon(const Vector& step)
  {
    if (layout_.hasUp())
      estimate_.up =
          (estimate_.up + acrossOf(estimate_.up) * step.segment<GraphLayout::kUp>(layout_.upAt()))
              .normalized();
    for (std::size_t i = 0; i < estimate_.sensor_errors.size(); ++i)
      estimate_.sensor_errors[i] += step.segment(layout_.sensorAt(i), layout_.errorsOf(i));
    if (layout_.hasEarth()) move(*estimate_.T_earth_world, step, layout_.earthAt());
  }

  /** To the optimum of the weights that there are. */
  void settle()
  {
    estimate_.converged = false;
    for (int i = 0; i < kMostIterations && !estimate_.converged; ++i)
    {
      const NormalEquations equations = linearized(graph_, informations_, estimate_, layout_);
      factorize(equations.matrix());
      const Vector step = -solver_.solve(equations.gradient());
      for (std::size_t n = 0; n < estimate_.nodes.size(); ++n)
        move(estimate_.nodes[n], step, GraphLayout::at(n));
      moveCommon(step);
      estimate_.converged = step.lpNorm<Eigen::Infinity>() < kSmallStep * std::max(1.0, scale());
    }
  }

  /** Of the coordinates, against rounding [m]. */
  [[nodiscard]] double scale() const
  {
    double largest = 0.0;
    for (const Pose& pose : estimate_.nodes)
      largest = std::max(largest, pose.p.lpNorm<Eigen::Infinity>());
    return largest;
  }

  void factorize(const Sparse& matrix)
  {
    solver_.compute(matrix);
    if (solver_.info() != Eigen::Success)
      throw std::runtime_error(
          "the pose graph cannot be solved: its measurements leave poses open");
  }

  [[nodiscard]] double edgeError(std::size_t i) const
  {
    const GraphEdge& edge = graph_.edges[i];
    const Vector6 e = errorOf(edge.measured, node(edge.a), node(edge.b)).value;
    return e.dot(informations_.edges[i] * e);
  }

  [[nodiscard]] double positionError(std::size_t i) const
  {
    const PositionFactor& factor = graph_.positions[i];
    const Vec3 e = errorOf(factor, node(factor.node), *estimate_.T_earth_world).value;
    return e.dot(informations_.positions[i] * e);
  }

  /** Weights of all robust factors. \return whether all are 0 or 1 */
  bool reweigh(double mu)
  {
    bool decided = true;
    const auto set = [&](double& weight, double squared_error, double limit)
    {
      weight = truncatedWeight(squared_error, limit, mu);
      decided = decided && (weight <= 0.0 || weight >= 1.0);
    };
    for (std::size_t i = 0; i < graph_.edges.size(); ++i)
      if (graph_.edges[i].robust) set(estimate_.edge_weights[i], edgeError(i), kEdgeQuantile);
    for (std::size_t i = 0; i < graph_.positions.size(); ++i)
      set(estimate_.position_weights[i], positionError(i), kPositionQuantile);
    return decided;
  }

  /** The largest error of a robust factor over its limit. */
  [[nodiscard]] double worstRatio() const
  {
    double worst = 0.0;
    for (std::size_t i = 0; i < graph_.edges.size(); ++i)
      if (graph_.edges[i].robust) worst = std::max(worst, edgeError(i) / kEdgeQuantile);
    for (std::size_t i = 0; i < graph_.positions.size(); ++i)
      worst = std::max(worst, positionError(i) / kPositionQuantile);
    return worst;
  }

  void makeRobust()
  {
    const double worst = worstRatio();
    if (worst <= 1.0) return;  // everything agrees
    double mu = 1.0 / std::max(2.0 * worst - 1.0, 1e-12);
    for (int stage = 0; stage < kMostStages; ++stage, mu *= kConvexityFactor)
    {
      const bool decided = reweigh(mu);
      settle();
      if (decided && mu > 1.0) break;
    }
    // What is left between is decided by its own limit.
    const auto decide = [](double& weight) { weight = weight >= 0.5 ? 1.0 : 0.0; };
    std::for_each(estimate_.edge_weights.begin(), estimate_.edge_weights.end(), decide);
    std::for_each(estimate_.position_weights.begin(), estimate_.position_weights.end(), decide);
    settle();
  }

  void findCovariances()
  {
    factorize(linearized(graph_, informations_, estimate_, layout_).matrix());
    const SelectedInverse inverse(solver_);
    const auto covarianceAt = [&inverse](int begin, int size = GraphLayout::kNode)
    {
      Eigen::MatrixXd covariance(size, size);
      for (int column = 0; column < size; ++column)
        for (int row = 0; row < size; ++row)
          covariance(row, column) = inverse.at(begin + row, begin + column);
      return covariance;
    };
    for (std::size_t n = 0; n < estimate_.nodes.size(); ++n)
      estimate_.covariances.emplace_back(covarianceAt(GraphLayout::at(n)));
    for (std::size_t i = 0; i < graph_.sensor_covariances.size(); ++i)
      estimate_.sensor_covariances.push_back(
          covarianceAt(layout_.sensorAt(i), layout_.errorsOf(i)));
    if (layout_.hasEarth()) estimate_.earth_covariance = covarianceAt(layout_.earthAt());
  }

  const PoseGraph& graph_;
  Informations informations_;
  GraphLayout layout_;
  GraphEstimate estimate_;
  SelectedInverse::Factorization solver_;
};
}  // namespace

double squaredError(const GraphEdge& edge, const Pose& a, const Pose& b)
{
  const Vector6 error = errorOf(edge.measured, a, b).value;
  return error.dot(inverseCovariance<Aligned6>(edge.measured.covariance, "an edge") * error);
}

RelativePose withoutSensorErrors(const GraphEdge& edge, const GraphEstimate& estimate)
{
  RelativePose motion = edge.measured;
  if (edge.by_sensor.cols() == 0) return motion;
  const Vector6 excess = edge.by_sensor * estimate.sensor_errors[edge.sensor];
  motion.T_a_b.R = normalizeRotation(motion.T_a_b.R * expSO3(-excess.head<3>()));
  motion.T_a_b.p -= excess.tail<3>();
  motion.covariance +=
      edge.by_sensor * estimate.sensor_covariances[edge.sensor] * edge.by_sensor.transpose();
  return motion;
}

GraphEstimate optimize(const PoseGraph& graph, bool with_covariances)
{
  return Optimizer(graph).run(with_covariances);
}

}  // namespace fastlio
