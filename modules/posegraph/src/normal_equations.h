// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file normal_equations.h What a pose graph is linearised to: information matrices and sparse normal
 * equations (internal). */
#pragma once

#include <fastlio/posegraph/graph_factors.h>
#include <fastlio/posegraph/pose_graph.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include <stdexcept>
#include <string>
#include <vector>

namespace fastlio
{
/** \exception std::invalid_argument it has none */
template <typename Matrix>
[[nodiscard]] Matrix inverseCovariance(const Matrix& covariance, const std::string& what)
{
  const Eigen::LDLT<Matrix> factor(covariance);
  const bool usable = covariance.allFinite() && factor.info() == Eigen::Success &&
                      factor.vectorD().minCoeff() > 0.0;
  if (!usable) throw std::invalid_argument("the covariance of " + what + " has no inverse");
  return factor.solve(Matrix::Identity());
}

/** Information matrices of all factors, made once. */
struct Informations
{
  std::vector<Eigen::Matrix<double, 6, 6>> edges;
  std::vector<Eigen::Matrix2d> tilts;
  std::vector<Eigen::Matrix<double, 6, 6>> drifts;
  std::vector<Mat3> biases;
  std::vector<Mat3> positions;
  Eigen::Matrix<double, 6, 6> first;
};

inline void requireNode(const PoseGraph& graph, std::size_t node)
{
  if (node >= graph.nodes.size())
    throw std::invalid_argument(
        "a pose graph of " + std::to_string(graph.nodes.size()) + " nodes has no node " +
        std::to_string(node));
}

[[nodiscard]] inline std::invalid_argument noSensor(const PoseGraph& graph, std::size_t sensor)
{
  return std::invalid_argument(
      "a pose graph with " + std::to_string(graph.sensors.size()) + " sensors has no sensor " +
      std::to_string(sensor));
}

[[nodiscard]] inline Informations informationsOf(const PoseGraph& graph)
{
  Informations all;
  for (const GraphEdge& edge : graph.edges)
  {
    requireNode(graph, edge.a);
    requireNode(graph, edge.b);
    if (edge.travel != 0.0 && edge.sensor >= graph.sensors.size())
      throw noSensor(graph, edge.sensor);
    all.edges.push_back(
        inverseCovariance<Eigen::Matrix<double, 6, 6>>(edge.measured.covariance, "an edge"));
  }
  for (const TiltFactor& tilt : graph.tilts)
  {
    requireNode(graph, tilt.node);
    if (tilt.sensor >= graph.sensors.size()) throw noSensor(graph, tilt.sensor);
    const Across across = acrossOf(tilt.up);
    all.tilts.push_back(inverseCovariance<Eigen::Matrix2d>(
        across.transpose() * tilt.covariance * across, "a tilt"));
  }
  for (const SensorErrors& sensor : graph.sensors)
  {
    all.drifts.push_back(
        inverseCovariance<Eigen::Matrix<double, 6, 6>>(sensor.drift_covariance, "a drift"));
    all.biases.push_back(inverseCovariance<Mat3>(sensor.bias_covariance, "a bias"));
  }
  if (!graph.positions.empty() && !graph.T_earth_world)
    throw std::invalid_argument("a pose graph with positions needs a pose of their frame");
  for (const PositionFactor& position : graph.positions)
  {
    requireNode(graph, position.node);
    all.positions.push_back(inverseCovariance<Mat3>(position.covariance, "a position"));
  }
  all.first =
      inverseCovariance<Eigen::Matrix<double, 6, 6>>(graph.first_covariance, "the first node");
  return all;
}

/** The derivative of a measurement by one of its unknowns. */
template <typename Jacobian>
struct PartOf
{
  int begin;  //!< of the unknown
  Jacobian by;
};
template <typename Jacobian>
PartOf(int, Jacobian) -> PartOf<Jacobian>;

/** The normal equations of one iteration. */
class NormalEquations
{
 public:
  explicit NormalEquations(int size) : gradient_(Eigen::VectorXd::Zero(size)) {}

  template <typename Block>
  void addBlock(int row, int column, const Block& block)
  {
    for (int j = 0; j < block.cols(); ++j)
      for (int i = 0; i < block.rows(); ++i)
        if (row + i >= column + j) entries_.emplace_back(row + i, column + j, block(i, j));
  }

  /** One measurement of some unknowns. \param parts where each begins, with the Jacobian by it */
  template <typename Error, typename Information, typename... Parts>
  void add(const Error& error, const Information& information, const Parts&... parts)
  {
    const auto addRow = [&](const auto& part)
    {
      const auto weighted = (part.by.transpose() * information).eval();
      gradient_.segment(part.begin, part.by.cols()) += weighted * error;
      (addProduct(part, weighted, parts), ...);
    };
    (addRow(parts), ...);
    cost_ += error.dot(information * error);
  }

  [[nodiscard]] double cost() const { return cost_; }
  [[nodiscard]] const Eigen::VectorXd& gradient() const { return gradient_; }
  /** The lower triangle. */
  [[nodiscard]] Eigen::SparseMatrix<double> matrix() const
  {
    Eigen::SparseMatrix<double> m(gradient_.size(), gradient_.size());
    m.setFromTriplets(entries_.begin(), entries_.end());
    return m;
  }

 private:
  template <typename Row, typename Weighted, typename Column>
  void addProduct(const Row& row, const Weighted& weighted, const Column& column)
  {
    if (row.begin >= column.begin) addBlock(row.begin, column.begin, (weighted * column.by).eval());
  }

  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd gradient_;
  double cost_ = 0.0;
};

}  // namespace fastlio
