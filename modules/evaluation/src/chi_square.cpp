// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/consistency.h>

#include <Eigen/Core>

#include <cmath>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/SpecialFunctions>

namespace fastlio
{
namespace
{
/** Eigen's series needs about 6 sqrt(degrees) terms and stops at 2000. */
constexpr double kMaxDegreesOfSeries = 2e4;

/** Where an increasing function reaches a target, between two bounds, to the last digit or so. */
template <typename F>
double bisect(const F& increasing, double target, double low, double high)
{
  constexpr int kHalvings = 80;
  for (int i = 0; i < kHalvings; ++i)
  {
    const double middle = 0.5 * (low + high);
    (increasing(middle) < target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double normalQuantile(double probability)
{
  constexpr double kFar = 40.0;  // standard deviations: beyond the smallest double
  const auto cdf = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  return bisect(cdf, probability, -kFar, kFar);
}

/** Wilson and Hilferty 1931: the cube root is nearly normal; relative error below 1e-6 here. */
double quantileOfManyDegrees(double probability, double degrees)
{
  const double variance = 2.0 / (9.0 * degrees);
  return degrees * std::pow(1.0 - variance + normalQuantile(probability) * std::sqrt(variance), 3);
}

double quantileOfFewDegrees(double probability, double degrees)
{
  const auto cdf = [degrees](double x) { return Eigen::numext::igamma(0.5 * degrees, 0.5 * x); };
  double high = degrees + 1.0;
  while (cdf(high) < probability)
    high *= 2.0;
  return bisect(cdf, probability, 0.0, high);
}

}  // namespace

double chiSquareQuantile(double probability, double degrees)
{
  if (!(probability > 0.0 && probability < 1.0))
    throw std::invalid_argument(
        "a probability must lie between 0 and 1, saw " + std::to_string(probability));
  if (!(degrees > 0.0) || !std::isfinite(degrees))
    throw std::invalid_argument(
        "degrees of freedom must be above 0, saw " + std::to_string(degrees));
  return degrees > kMaxDegreesOfSeries ? quantileOfManyDegrees(probability, degrees)
                                       : quantileOfFewDegrees(probability, degrees);
}

}  // namespace fastlio
