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
  return factor.solve(Matrix::Identity(covariance.rows(), covariance.cols()));
}

/** Information matrices of all factors, made once. */
struct Informations
{
  std::vector<Eigen::Matrix<double, 6, 6>> edges;
  std::vector<Eigen::Matrix2d> tilts;
  std::vector<Eigen::MatrixXd> sensors;
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

/** Of a measurement that has errors of a sensor. */
inline void requireSensor(
    const PoseGraph& graph, std::size_t sensor, const Eigen::MatrixXd& by_sensor)
{
  if (by_sensor.cols() == 0) return;
  const std::vector<Eigen::MatrixXd>& all = graph.sensor_covariances;
  if (sensor >= all.size())
    throw std::invalid_argument(
        "a pose graph with " + std::to_string(all.size()) + " sensors has no sensor " +
        std::to_string(sensor));
  if (by_sensor.cols() != all[sensor].cols())
    throw std::invalid_argument(
        "sensor " + std::to_string(sensor) + " has " + std::to_string(all[sensor].cols()) +
        " errors; a measurement of it has " + std::to_string(by_sensor.cols()));
}

[[nodiscard]] inline Informations informationsOf(const PoseGraph& graph)
{
  Informations all;
  for (const GraphEdge& edge : graph.edges)
  {
    requireNode(graph, edge.a);
    requireNode(graph, edge.b);
    requireSensor(graph, edge.sensor, edge.by_sensor);
    all.edges.push_back(
        inverseCovariance<Eigen::Matrix<double, 6, 6>>(edge.measured.covariance, "an edge"));
  }
  for (const TiltFactor& tilt : graph.tilts)
  {
    requireNode(graph, tilt.node);
    requireSensor(graph, tilt.sensor, tilt.by_sensor);
    const Across across = acrossOf(tilt.up);
    all.tilts.push_back(inverseCovariance<Eigen::Matrix2d>(
        across.transpose() * tilt.covariance * across, "a tilt"));
  }
  for (const Eigen::MatrixXd& sensor : graph.sensor_covariances)
    all.sensors.push_back(inverseCovariance(sensor, "a sensor's errors"));
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
  /** \param common unknowns from here on are in many measurements: their products are added up
   * before they become entries of a sparse matrix */
  NormalEquations(int size, int common)
      : common_begin_(common),
        common_(Eigen::MatrixXd::Zero(size - common, size - common)),
        gradient_(Eigen::VectorXd::Zero(size))
  {
  }

  template <typename Block>
  void addBlock(int row, int column, const Block& block)
  {
    if (column >= common_begin_)
    {
      common_.block(row - common_begin_, column - common_begin_, block.rows(), block.cols()) +=
          block;
      return;
    }
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
  }

  [[nodiscard]] const Eigen::VectorXd& gradient() const { return gradient_; }
  /** The lower triangle. */
  [[nodiscard]] Eigen::SparseMatrix<double> matrix() const
  {
    std::vector<Eigen::Triplet<double>> entries = entries_;
    for (int j = 0; j < common_.cols(); ++j)
      for (int i = j; i < common_.rows(); ++i)
        entries.emplace_back(common_begin_ + i, common_begin_ + j, common_(i, j));
    Eigen::SparseMatrix<double> m(gradient_.size(), gradient_.size());
    m.setFromTriplets(entries.begin(), entries.end());
    return m;
  }

 private:
  template <typename Row, typename Weighted, typename Column>
  void addProduct(const Row& row, const Weighted& weighted, const Column& column)
  {
    if (row.begin >= column.begin) addBlock(row.begin, column.begin, (weighted * column.by).eval());
  }

  int common_begin_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::MatrixXd common_;
  Eigen::VectorXd gradient_;
};

}  // namespace fastlio
