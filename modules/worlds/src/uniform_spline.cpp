// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/worlds/uniform_spline.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
constexpr int kOrder = 6;

// Row j: weight of the j-th of the six control points around an interval, as a polynomial in the
// position x within the interval (ascending powers), times 120.
constexpr std::array<std::array<double, kOrder>, kOrder> kBasis{
    {{1, -5, 10, -10, 5, -1},
     {26, -50, 20, 20, -20, 5},
     {66, 0, -60, 0, 30, -10},
     {26, 50, 20, -20, -20, 10},
     {1, 5, 10, 10, 5, -5},
     {0, 0, 0, 0, 0, 1}}};
constexpr double kBasisScale = 1.0 / 120.0;

struct Interval
{
  long index;
  double x;  // position within, [0, 1)
};

Interval locate(double u, double spacing)
{
  const double s = u / spacing;
  const double floor = std::floor(s);
  return {static_cast<long>(floor), s - floor};
}

double polynomial(const std::array<double, kOrder>& c, double x)
{
  double value = c[kOrder - 1];
  for (int k = kOrder - 2; k >= 0; --k)
    value = value * x + c[static_cast<std::size_t>(k)];
  return value;
}

Jet polynomialJet(const std::array<double, kOrder>& c, double x)
{
  Jet jet{c[kOrder - 1], 0.0, 0.0};
  for (int k = kOrder - 2; k >= 0; --k)
  {
    jet.second = jet.second * x + 2.0 * jet.first;
    jet.first = jet.first * x + jet.value;
    jet.value = jet.value * x + c[static_cast<std::size_t>(k)];
  }
  return jet;
}
}  // namespace

UniformSpline::UniformSpline(std::vector<double> control, double spacing, double winding)
    : control_(std::move(control)), spacing_(spacing), winding_(winding)
{
  if (!(spacing > 0.0) || !std::isfinite(spacing) || !std::isfinite(winding))
    throw std::invalid_argument(
        "UniformSpline: knot spacing " + std::to_string(spacing) + " and winding " +
        std::to_string(winding) + "; the spacing must be positive and both finite.");
  for (const double c : control_)
    if (!std::isfinite(c))
      throw std::invalid_argument("UniformSpline: a control point is not a finite number.");
}

double UniformSpline::control(long index) const
{
  const long n = static_cast<long>(control_.size());
  const long turns = index >= 0 ? index / n : -((n - 1 - index) / n);
  return control_[static_cast<std::size_t>(index - turns * n)] +
         static_cast<double>(turns) * winding_;
}

double UniformSpline::value(double u) const
{
  if (empty()) return 0.0;
  const Interval i = locate(u, spacing_);
  double sum = 0.0;
  for (int j = 0; j < kOrder; ++j)
    sum += polynomial(kBasis[static_cast<std::size_t>(j)], i.x) * control(i.index + j - 2);
  return sum * kBasisScale;
}

Jet UniformSpline::at(double u) const
{
  if (empty()) return {};
  const Interval i = locate(u, spacing_);
  Jet sum;
  for (int j = 0; j < kOrder; ++j)
  {
    const Jet weight = polynomialJet(kBasis[static_cast<std::size_t>(j)], i.x);
    const double c = control(i.index + j - 2);
    sum.value += weight.value * c;
    sum.first += weight.first * c;
    sum.second += weight.second * c;
  }
  return {
      sum.value * kBasisScale, sum.first * kBasisScale / spacing_,
      sum.second * kBasisScale / (spacing_ * spacing_)};
}

}  // namespace fastlio
