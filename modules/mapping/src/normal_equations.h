// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file normal_equations.h What a pose graph is linearised to: information matrices and sparse normal
 * equations (internal). */
#pragma once

#include <fastlio/mapping/pose_graph.h>

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

[[nodiscard]] inline Informations informationsOf(const PoseGraph& graph)
{
  Informations all;
  for (const GraphEdge& edge : graph.edges)
  {
    requireNode(graph, edge.a);
    requireNode(graph, edge.b);
    all.edges.push_back(
        inverseCovariance<Eigen::Matrix<double, 6, 6>>(edge.measured.covariance, "an edge"));
  }
  for (const TiltFactor& tilt : graph.tilts)
  {
    requireNode(graph, tilt.node);
    all.tilts.push_back(inverseCovariance<Eigen::Matrix2d>(tilt.covariance, "a tilt"));
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

  /** One measurement of one unknown, beginning at \a at. */
  template <typename Error, typename Jacobian, typename Information>
  void add(int at, const Error& error, const Jacobian& J, const Information& information)
  {
    addBlock(at, at, (J.transpose() * information * J).eval());
    gradient_.segment(at, J.cols()) += J.transpose() * information * error;
    cost_ += error.dot(information * error);
  }

  /** One measurement of two unknowns. */
  template <typename Error, typename JacobianA, typename JacobianB, typename Information>
  void add(
      int a, const JacobianA& by_a, int b, const JacobianB& by_b, const Error& error,
      const Information& information)
  {
    addBlock(a, a, (by_a.transpose() * information * by_a).eval());
    addBlock(b, b, (by_b.transpose() * information * by_b).eval());
    if (a > b)
      addBlock(a, b, (by_a.transpose() * information * by_b).eval());
    else
      addBlock(b, a, (by_b.transpose() * information * by_a).eval());
    gradient_.segment(a, by_a.cols()) += by_a.transpose() * information * error;
    gradient_.segment(b, by_b.cols()) += by_b.transpose() * information * error;
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
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd gradient_;
  double cost_ = 0.0;
};

}  // namespace fastlio
