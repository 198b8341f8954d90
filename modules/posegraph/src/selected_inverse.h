// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file selected_inverse.h Entries of the inverse of a sparse matrix, from its factorisation
 * (internal). */
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <vector>

namespace fastlio
{
/** The inverse of a positive definite matrix where its Cholesky factor has entries, by the
 * recursion of Takahashi, Fagan and Chen (1973). This costs about as much as the factorisation:
 * solving for each unknown would grow with the square of their number. */
class SelectedInverse
{
 public:
  using Factorization = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

  /** \param factorization of the matrix, which succeeded */
  explicit SelectedInverse(const Factorization& factorization);

  /** The entry at a place where the matrix itself has one. */
  [[nodiscard]] double at(int row, int column) const;

 private:
  Eigen::SparseMatrix<double> inverse_;  // lower triangle, permuted; without the diagonal
  std::vector<double> diagonal_;
  std::vector<int> position_;  // of each unknown in the permuted order
};

}  // namespace fastlio
