// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file statistics.h Small statistics of samples. */
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fastlio
{
/** Standard deviation over median absolute deviation, of normally distributed samples. */
constexpr double kStdOverMedianDeviation = 1.4826;

/** The upper median; 0 of nothing. */
template <typename Number>
[[nodiscard]] Number median(std::vector<Number> values)
{
  if (values.empty()) return {};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace fastlio
