// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "anderson.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>

namespace fastlio
{
namespace
{
// Steps have noise: differences that are small beside it must not be blown up.
constexpr double kRegularization = 1e-3;
// So much of the blocks' information is always believed; less is noise of the steps.
constexpr double kLeastInformation = 0.01;
}  // namespace

Eigen::MatrixXd AndersonIteration::differences(const std::vector<Eigen::VectorXd>& of)
{
  const auto columns = static_cast<Eigen::Index>(of.size()) - 1;
  Eigen::MatrixXd d(of.front().size(), columns);
  for (Eigen::Index i = 0; i < columns; ++i)
    d.col(i) = of[static_cast<std::size_t>(i) + 1] - of[static_cast<std::size_t>(i)];
  return d;
}

Eigen::VectorXd AndersonIteration::next(
    const Eigen::VectorXd& x, const Eigen::VectorXd& step, const Eigen::MatrixXd& M)
{
  points_.push_back(x);
  steps_.push_back(step);
  if (points_.size() > depth_ + 1)
  {
    points_.erase(points_.begin());
    steps_.erase(steps_.begin());
  }
  if (points_.size() == 1) return x + step;
  const Eigen::MatrixXd dx = differences(points_), ds = differences(steps_);
  const Eigen::MatrixXd weighted = M.ldlt().solve(ds);
  Eigen::MatrixXd normal = ds.transpose() * weighted;
  normal.diagonal() *= 1.0 + kRegularization;
  const Eigen::VectorXd gamma = normal.ldlt().solve(weighted.transpose() * step);
  return x + step - (dx + ds) * gamma;
}

Eigen::MatrixXd AndersonIteration::covariance(const Eigen::MatrixXd& M) const
{
  if (points_.size() < 2) return M;
  const Eigen::MatrixXd dx = differences(points_), ds = differences(steps_);
  const Eigen::MatrixXd weighted = M.ldlt().solve(dx);
  Eigen::MatrixXd of_blocks = dx.transpose() * weighted;  // information along dx, by M
  of_blocks.diagonal() *= 1.0 + 1e-9;
  of_blocks.diagonal().array() += std::numeric_limits<double>::min();  // x may stand still
  Eigen::MatrixXd of_all = -weighted.transpose() * ds;                 // the same, by H
  of_all = (0.5 * (of_all + of_all.transpose())).eval();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(of_all, of_blocks);
  Eigen::MatrixXd covariance = M;
  for (Eigen::Index i = 0; i < dx.cols(); ++i)
  {
    const double known = std::max(solver.eigenvalues()[i], kLeastInformation);
    if (known >= 1.0) continue;
    const Eigen::VectorXd direction = dx * solver.eigenvectors().col(i);
    covariance += (1.0 / known - 1.0) * direction * direction.transpose();
  }
  return covariance;
}

}  // namespace fastlio
