// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "selected_inverse.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace fastlio
{
SelectedInverse::SelectedInverse(const Factorization& factorization)
    : inverse_(factorization.matrixL().nestedExpression())
{
  const Eigen::VectorXd d = factorization.vectorD();
  const auto size = static_cast<int>(d.size());
  const auto& order = factorization.permutationP().indices();
  position_.assign(order.data(), order.data() + order.size());
  diagonal_.resize(static_cast<std::size_t>(size));
  const int* begins = inverse_.outerIndexPtr();
  const int* rows = inverse_.innerIndexPtr();
  double* values = inverse_.valuePtr();
  // Where the present column has a row; -1: it has none.
  std::vector<int> place(static_cast<std::size_t>(size), -1);
  std::vector<double> factor, sums;
  for (int column = size - 1; column >= 0; --column)
  {
    // Columns to the right hold the inverse already, this one still the factor.
    const int begin = begins[column], count = begins[column + 1] - begin;
    factor.assign(values + begin, values + begin + count);
    sums.assign(static_cast<std::size_t>(count), 0.0);
    for (int i = 0; i < count; ++i)
      place[static_cast<std::size_t>(rows[begin + i])] = i;
    for (int i = 0; i < count; ++i)
    {
      const int row = rows[begin + i];
      const auto here = static_cast<std::size_t>(i);
      sums[here] += diagonal_[static_cast<std::size_t>(row)] * factor[here];
      for (int entry = begins[row]; entry < begins[row + 1]; ++entry)
      {
        const int other = place[static_cast<std::size_t>(rows[entry])];
        if (other < 0) continue;
        const auto there = static_cast<std::size_t>(other);
        sums[there] += values[entry] * factor[here];
        sums[here] += values[entry] * factor[there];
      }
    }
    double own = 1.0 / d[column];
    for (int i = 0; i < count; ++i)
    {
      const auto here = static_cast<std::size_t>(i);
      values[begin + i] = -sums[here];
      own += factor[here] * sums[here];
      place[static_cast<std::size_t>(rows[begin + i])] = -1;
    }
    diagonal_[static_cast<std::size_t>(column)] = own;
  }
}

double SelectedInverse::at(int row, int column) const
{
  int a = position_[static_cast<std::size_t>(row)], b = position_[static_cast<std::size_t>(column)];
  if (a == b) return diagonal_[static_cast<std::size_t>(a)];
  if (a < b) std::swap(a, b);
  return inverse_.coeff(a, b);
}

}  // namespace fastlio
