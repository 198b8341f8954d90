// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file anderson.h Anderson acceleration (D. G. Anderson, "Iterative procedures for nonlinear
 * integral equations", Journal of the ACM, 1965), and the uncertainty that its steps imply. */
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace fastlio
{
/** Finds the x at which no step is wanted, from the steps wanted at the points that it proposes.
 *
 * A step is that of least squares with unknowns in blocks, each as if it knew the others: s = -M H
 * (x - solution), with the covariance M of the blocks and the information H of all together. Where
 * blocks explain the same data, the steps are small though x is far off. The differences between
 * steps give H in these directions: they shorten the way, and they give the uncertainty of x. */
class AndersonIteration
{
 public:
  /** \param depth so many points before the last one are used */
  explicit AndersonIteration(std::size_t depth) : depth_(depth) {}

  /** The next point. \param M covariance of the blocks, block by block */
  [[nodiscard]] Eigen::VectorXd next(
      const Eigen::VectorXd& x, const Eigen::VectorXd& step, const Eigen::MatrixXd& M);

  /** Covariance of x: M, and more in the directions in which the blocks compete. */
  [[nodiscard]] Eigen::MatrixXd covariance(const Eigen::MatrixXd& M) const;

 private:
  /** Differences between neighbours, by columns. */
  [[nodiscard]] static Eigen::MatrixXd differences(const std::vector<Eigen::VectorXd>& of);

  std::size_t depth_;
  std::vector<Eigen::VectorXd> points_, steps_;  // ascending by time
};

}  // namespace fastlio
