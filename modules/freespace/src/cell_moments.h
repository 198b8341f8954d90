// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file cell_moments.h Whether the points of neighbouring voxels are on a flat surface (internal). */
#pragma once

#include "vote_blocks.h"
#include <fastlio/math/linear_algebra.h>

#include <optional>

namespace fastlio
{
/** Points of several cells about one centre. */
class CellMoments
{
 public:
  void add(const VotedCell& cell, const Vec3& shift)
  {
    const auto n = static_cast<double>(cell.points);
    const Vec3 sum = n * cell.mean();
    Mat3 squares;
    const auto entry = [&cell](std::size_t i) { return static_cast<double>(cell.squares[i]); };
    squares << entry(0), entry(1), entry(2), entry(1), entry(3), entry(4), entry(2), entry(4),
        entry(5);
    n_ += n;
    sum_ += sum + n * shift;
    squares_ +=
        squares + shift * sum.transpose() + sum * shift.transpose() + n * shift * shift.transpose();
  }

  /** The normal of a flat surface. */
  [[nodiscard]] std::optional<Vec3> normal() const
  {
    if (n_ < kPointsOfSurface) return std::nullopt;
    const Vec3 mean = sum_ / n_;
    const auto system = symmetricEigensystem(Mat3(squares_ / n_ - mean * mean.transpose()));
    const bool is_flat = system.values.x() < kThickest * kThickest &&
                         system.values.x() < kThinness * system.values.y();
    if (!is_flat) return std::nullopt;
    return Vec3(system.vectors.col(0));
  }

 private:
  static constexpr double kThickest = 0.04;      // thickest surface that counts as flat [m]
  static constexpr double kThinness = 0.1;       // of the smaller variances
  static constexpr double kPointsOfSurface = 6;  // that determine its direction

  double n_ = 0.0;
  Vec3 sum_ = Vec3::Zero();
  Mat3 squares_ = Mat3::Zero();
};

}  // namespace fastlio
