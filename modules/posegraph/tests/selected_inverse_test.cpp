// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "selected_inverse.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <random>

namespace fastlio
{
/** Entries of the inverse from the factorisation, as of the inverse itself. */
TEST(SelectedInverse, IsThatOfTheWholeMatrix)
{
  constexpr int kSize = 60;
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(kSize, kSize);
  // A chain with some loops and two unknowns that all have in common.
  const auto couple = [&](int a, int b) { dense(a, b) = dense(b, a) = 0.4 * uniform(engine); };
  for (int i = 0; i < kSize; ++i)
  {
    if (i > 0) couple(i, i - 1);
    if (i % 7 == 0) couple(i, (3 * i + 11) % (kSize - 2));
    if (i < kSize - 2)
    {
      couple(i, kSize - 1);
      couple(i, kSize - 2);
    }
  }
  for (int i = 0; i < kSize; ++i)
    dense(i, i) = 1.0 + dense.row(i).cwiseAbs().sum();
  const Eigen::SparseMatrix<double> sparse = dense.sparseView();
  const SelectedInverse::Factorization factorization(sparse);
  ASSERT_EQ(factorization.info(), Eigen::Success);
  const SelectedInverse selected(factorization);
  const Eigen::MatrixXd expected = dense.inverse();
  for (int row = 0; row < kSize; ++row)
    for (int column = 0; column < kSize; ++column)
    {
      if (dense(row, column) == 0.0) continue;
      EXPECT_NEAR(selected.at(row, column), expected(row, column), 1e-12);
    }
}

}  // namespace fastlio
