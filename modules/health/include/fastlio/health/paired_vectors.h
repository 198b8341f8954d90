// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file paired_vectors.h What two sensors saw of the same motion, over about the last minute. */
#pragma once

#include <fastlio/math/so3.h>

namespace fastlio
{
/** Sums over pairs of vectors, without their means: what is constant in one of the two, as a bias,
 * does not matter. What is older counts less. */
class PairedVectors
{
 public:
  /** With less correlation, one of the two sees mostly what is not motion. */
  static constexpr double kLeastCorrelation = 0.95;

  void add(const Vec3& scans, const Vec3& inertial);

  /** Do the sums hold pairs enough to compare anything? */
  [[nodiscard]] bool enough() const;
  /** How many pairs count. */
  [[nodiscard]] double count() const { return count_; }
  /** Sum of scans * inertial^T. */
  [[nodiscard]] Mat3 products() const;
  /** Sums of squared norms. */
  [[nodiscard]] double scanSquares() const { return scans_.centred(count_); }
  [[nodiscard]] double inertialSquares() const { return inertial_.centred(count_); }
  /** Sum of inertial * (its change since the pair before): what a lag by one pair would add to the
   * products. Motion that begins and ends in the sums adds little. */
  [[nodiscard]] double lagProduct() const { return lag_product_; }

 private:
  struct Sums
  {
    void add(const Vec3& vector);
    [[nodiscard]] double centred(double count) const;

    Vec3 sum = Vec3::Zero();
    double squares = 0.0;
  };

  Sums scans_, inertial_;
  Mat3 products_ = Mat3::Zero();
  double count_ = 0.0, lag_product_ = 0.0;
  Vec3 last_inertial_ = Vec3::Zero();
};

}  // namespace fastlio
