// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/evaluation/consistency.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fastlio
{
double chiSquareQuantile(double probability, double degrees)
{
  if (!(probability > 0.0 && probability < 1.0))
    throw std::invalid_argument(
        "a probability must lie between 0 and 1, saw " + std::to_string(probability));
  if (!(degrees > 0.0) || !std::isfinite(degrees))
    throw std::invalid_argument(
        "degrees of freedom must be above 0, saw " + std::to_string(degrees));
  return boost::math::quantile(boost::math::chi_squared(degrees), probability);
}

}  // namespace fastlio
