// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/filter/gravity.h>

namespace fastlio
{
FilterState withGravityOnSphere(const FilterState& state, double length)
{
  FilterState s = state;
  const Vec3 direction = s.x.g.normalized();
  s.x.g = length * direction;
  const Mat3 across = Mat3::Identity() - direction * direction.transpose();
  s.P.middleRows<3>(kGravity) = across.lazyProduct(s.P.middleRows<3>(kGravity)).eval();
  s.P.middleCols<3>(kGravity) = s.P.middleCols<3>(kGravity).lazyProduct(across).eval();
  return s;
}

}  // namespace fastlio
