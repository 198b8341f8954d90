// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file information_lanes.h The sums of the information form, kept apart per lane. */
#pragma once

#include "measurement_lanes.h"
#include <fastlio/filter/update.h>

#include <cstddef>

namespace fastlio
{
// As many double-precision numbers as the widest registers of the processor family hold.
constexpr std::size_t kLanes = 8;

/** Sum over the lanes, in their order. */
template <std::size_t N>
[[nodiscard]] double total(const double (&lanes)[N])
{
  double sum = 0.0;
  for (const double lane : lanes)
    sum += lane;
  return sum;
}

/** Weights of the first \a filled lanes that are consistent with the model. The others become zero
 * in every respect, as a NaN times a weight of zero would not. \return how many count */
template <std::size_t N>
std::size_t weigh(
    MeasurementLanes<N>& m, std::size_t filled, const ResidualModel& model, double (&weight)[N])
{
  bool counts[N];
  std::size_t count = 0;
  for (std::size_t l = 0; l < N; ++l)
  {
    const double h[6] = {m.h[0][l], m.h[1][l], m.h[2][l], m.h[3][l], m.h[4][l], m.h[5][l]};
    counts[l] = l < filled && withinGate(m.z[l], m.variance[l], h, model);
    weight[l] = counts[l] ? 1.0 / m.variance[l] : 0.0;
    m.z[l] = counts[l] ? m.z[l] : 0.0;
    count += counts[l] ? 1 : 0;
  }
  for (auto& row : m.h)
    for (std::size_t l = 0; l < N; ++l)
      row[l] = counts[l] ? row[l] : 0.0;
  return count;
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
template <std::size_t N>
class InformationLanes
{
 public:
  /** Adds the first \a filled lanes that are consistent with the model; the others may hold
   * anything. */
  void add(MeasurementLanes<N>& m, std::size_t filled, const ResidualModel& model)
  {
    double weight[N];
    count_ += weigh(m, filled, model, weight);
    information_.add(weight, m.h);
    for (std::size_t l = 0; l < N; ++l)
    {
      const double weighted_z = weight[l] * m.z[l];
      for (std::size_t c = 0; c < 6; ++c)
        hz_[c][l] += weighted_z * m.h[c][l];
      squares_[l] += m.z[l] * m.z[l];
      weighted_squares_[l] += weighted_z * m.z[l];
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
  OuterProductLanes<N> information_;
  double hz_[6][N] = {};
  double squares_[N] = {};
  double weighted_squares_[N] = {};
  std::size_t count_ = 0;
};

}  // namespace fastlio
