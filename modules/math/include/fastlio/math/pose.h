// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file pose.h A rigid transformation, named by its frames: T_a_b takes coordinates of b to a. */
#pragma once

#include <fastlio/math/so3.h>

#include <cstdint>

namespace fastlio
{
/** Rotation and translation [m]: p_a = R p_b + p for a pose called T_a_b. */
struct Pose
{
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();

  [[nodiscard]] Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
  [[nodiscard]] Pose operator*(const Pose& b) const { return {R * b.R, R * b.p + p}; }
  [[nodiscard]] Vec3 operator*(const Vec3& point) const { return R * point + p; }
};

/** Between \a a (\a fraction 0) and \a b (1), with constant velocity and rate of turn. */
[[nodiscard]] inline Pose interpolated(const Pose& a, const Pose& b, double fraction)
{
  return {a.R * expSO3(fraction * logSO3(a.R.transpose() * b.R)), a.p + fraction * (b.p - a.p)};
}

/** Where a body was at an instant. */
struct StampedPose
{
  std::int64_t stamp_ns = 0;  //!< on the clock of whatever it is part of [ns]
  Pose T_world_body;          //!< body to world; the body may be the IMU
};

}  // namespace fastlio
