// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file uniform_spline.h A quintic B-spline over equally spaced knots: four continuous
 * derivatives. */
#pragma once

#include <vector>

namespace fastlio
{
/** A scalar function's value and derivatives at one argument. */
struct Jet
{
  double value = 0.0;
  double first = 0.0;
  double second = 0.0;
};

/** A periodic quintic B-spline that may wind: s(u + period) = s(u) + winding (an angle that turns
 * once per loop has the winding 2 pi). Without control points it is zero. */
class UniformSpline
{
 public:
  UniformSpline() = default;

  /** \param control one control point per knot interval, first at u = 0
   * \param spacing distance of knots, positive \param winding growth per period
   * \exception std::invalid_argument spacing not positive or a value not finite */
  UniformSpline(std::vector<double> control, double spacing, double winding = 0.0);

  [[nodiscard]] bool empty() const { return control_.empty(); }
  [[nodiscard]] double period() const { return spacing_ * static_cast<double>(control_.size()); }

  [[nodiscard]] double value(double u) const;
  /** Value and exact derivatives with respect to u. */
  [[nodiscard]] Jet at(double u) const;

 private:
  [[nodiscard]] double control(long index) const;

  std::vector<double> control_;
  double spacing_ = 1.0;
  double winding_ = 0.0;
};

}  // namespace fastlio
