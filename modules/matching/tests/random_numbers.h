// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file random_numbers.h Numbers and vectors for tests of residuals. */
#pragma once

#include <fastlio/math/so3.h>

#include <random>

namespace fastlio
{
class Random
{
 public:
  explicit Random(unsigned seed) : rng_(seed) {}
  double normal(double sigma = 1.0) { return sigma * normal_(rng_); }
  Vec3 vector(double sigma = 1.0) { return {normal(sigma), normal(sigma), normal(sigma)}; }
  double uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(rng_);
  }

 private:
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
};

}  // namespace fastlio
