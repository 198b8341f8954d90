// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/statistics.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
/** Middle value; the mean of the two middle ones for an even count. */
double medianOf(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

ErrorStatistics summarize(std::vector<double> errors)
{
  ErrorStatistics s;
  s.count = errors.size();
  if (errors.empty()) return s;
  const auto n = static_cast<double>(errors.size());
  double squares = 0.0;
  for (const double e : errors)
  {
    s.mean += e / n;
    squares += e * e / n;
  }
  double variance = 0.0;
  for (const double e : errors)
    variance += (e - s.mean) * (e - s.mean) / n;
  s.rmse = std::sqrt(squares);
  s.std = std::sqrt(variance);
  s.max = *std::max_element(errors.begin(), errors.end());
  s.median = medianOf(errors);
  return s;
}

}  // namespace fastlio
