// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "common_elevation.h"

#include <cmath>

namespace fastlio
{
Eigen::VectorXd shareOut(
    const CommonElevation& common, const Eigen::VectorXd& prior_std, Eigen::VectorXd& x,
    Eigen::MatrixXd& covariance)
{
  if (common.direction.isZero(0.0)) return Eigen::VectorXd::Zero(x.size());
  // The least s^2 + |(x + s response) / prior_std|^2.
  double squares = 1.0, product = 0.0;
  for (Eigen::Index i = 0; i < prior_std.size(); ++i)
  {
    if (!(prior_std[i] > 0.0)) continue;
    const double change = common.response[i] / prior_std[i];
    squares += change * change;
    product += change * x[i] / prior_std[i];
  }
  const Eigen::VectorXd change = common.direction + common.response;
  x -= product / squares * change;
  Eigen::VectorXd unknown = change / std::sqrt(squares);
  covariance += unknown * unknown.transpose();
  return unknown;
}

}  // namespace fastlio
