// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file information_lanes.h The sums of the information form, kept apart per lane. */
#pragma once

#include <fastlio/filter/update.h>
#include <fastlio/matching/measurement_block.h>

#include <cstddef>

namespace fastlio
{
/** Sum over the lanes, in their order. */
template <std::size_t N>
[[nodiscard]] double total(const double (&lanes)[N])
{
  double sum = 0.0;
  for (const double lane : lanes)
    sum += lane;
  return sum;
}

/** Sum of w h h^T of vectors h with D elements. */
template <std::size_t N, std::size_t D = 6>
class OuterProductLanes
{
 public:
  static constexpr int kSize = static_cast<int>(D);
  using Square = Eigen::Matrix<double, kSize, kSize, Eigen::DontAlign>;

  void add(const double (&weight)[N], const double (&h)[D][N])
  {
    std::size_t k = 0;
    for (std::size_t c = 0; c < D; ++c)
    {
      double weighted[N];
      for (std::size_t l = 0; l < N; ++l)
        weighted[l] = weight[l] * h[c][l];
      for (std::size_t r = 0; r <= c; ++r, ++k)
        for (std::size_t l = 0; l < N; ++l)
          upper_[k][l] += weighted[l] * h[r][l];
    }
  }

  /** Over all lanes. */
  [[nodiscard]] Square sum() const
  {
    Square s;
    std::size_t k = 0;
    for (int c = 0; c < kSize; ++c)
      for (int r = 0; r <= c; ++r, ++k)
        s(r, c) = s(c, r) = total(upper_[k]);
    return s;
  }

 private:
  double upper_[D * (D + 1) / 2][N] = {};
};

/** InformationSums of the measurements of each lane. */
class InformationLanes
{
 public:
  void add(const MeasurementBlock& block)
  {
    information_.add(block.weight, block.h);
    for (std::size_t l = 0; l < kLanes; ++l)
    {
      const double weighted_z = block.weight[l] * block.z[l];
      for (std::size_t c = 0; c < 6; ++c)
        hz_[c][l] += weighted_z * block.h[c][l];
      squares_[l] += block.z[l] * block.z[l];
      weighted_squares_[l] += weighted_z * block.z[l];
      count_ += block.weight[l] > 0.0 ? 1 : 0;
    }
  }

  /** Over all lanes. */
  [[nodiscard]] InformationSums sums() const
  {
    InformationSums s;
    s.HtRinvH = information_.sum();
    for (int c = 0; c < 6; ++c)
      s.HtRinvz[c] = total(hz_[static_cast<std::size_t>(c)]);
    s.squares = total(squares_);
    s.weighted_squares = total(weighted_squares_);
    s.count = count_;
    return s;
  }

 private:
  OuterProductLanes<kLanes> information_;
  double hz_[6][kLanes] = {};
  double squares_[kLanes] = {};
  double weighted_squares_[kLanes] = {};
  std::size_t count_ = 0;
};

}  // namespace fastlio
