// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plane_patches.h Points on known planes, for the tests of a voxel's plane. */
#pragma once

#include <fastlio/map/plane_voxel.h>

#include <Eigen/Geometry>

#include <random>

namespace fastlio::testing
{
using Eigen::Vector3d;
using Eigen::Vector3f;

class Random
{
 public:
  explicit Random(unsigned seed) : rng_(seed) {}
  double normal(double sigma = 1.0) { return sigma * normal_(rng_); }
  double uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(rng_);
  }
  Vector3d axis() { return Vector3d(normal(), normal(), normal()).normalized(); }

 private:
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
};

/** A plane through a voxel: center + s e1 + t e2 + offset n. */
struct TruePlane
{
  Vector3d n, e1, e2;
  double offset = 0.0;

  [[nodiscard]] Vector3d at(double s, double t) const { return s * e1 + t * e2 + offset * n; }
};

inline TruePlane planeAcross(const Vector3d& normal, double offset = 0.0)
{
  const Vector3d n = normal.normalized();
  const Vector3d e1 = n.unitOrthogonal();
  return {n, e1, n.cross(e1), offset};
}

/** Adds points of a disc-like patch with noise across it, seen along the normal. */
inline void addPatch(
    PlaneVoxel& voxel, const TruePlane& plane, int count, double half_width, double noise,
    Random& random)
{
  for (int i = 0; i < count; ++i)
  {
    const double s = random.uniform(-half_width, half_width);
    const double t = random.uniform(-half_width, half_width);
    const Vector3d p = plane.at(s, t) + random.normal(noise) * plane.n;
    voxel.add(p.cast<float>(), plane.n.cast<float>());
  }
}

inline PlaneRules rulesWithNoise(double noise)
{
  PlaneRules rules;
  rules.point_noise = float(noise);
  return rules;
}

inline double distanceTo(const VoxelPlane& plane, const Vector3d& p)
{
  return double(plane.nx) * p.x() + double(plane.ny) * p.y() + double(plane.nz) * p.z() +
         double(plane.offset());
}
}  // namespace fastlio::testing
