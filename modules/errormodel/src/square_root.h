// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file square_root.h The square root of a covariance. */
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace fastlio
{
/** C with C C^T = m for a positive semi-definite m. */
inline Eigen::Matrix<double, 6, 6> squareRoot(const Eigen::Matrix<double, 6, 6>& m)
{
  using Square = Eigen::Matrix<double, 6, 6>;
  // Keeps the factor finite where some direction has no error at all.
  constexpr double kRelativeFloor = 1e-12;
  const Square floor = (kRelativeFloor * m.diagonal().array() + 1e-300).matrix().asDiagonal();
  const Eigen::LLT<Square> llt(m + floor);
  return llt.info() == Eigen::Success ? Square(llt.matrixL()) : Square(Square::Zero());
}
}  // namespace fastlio
