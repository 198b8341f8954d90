// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/loops/wall_thickness.h>
#include <fastlio/math/statistics.h>
#include <fastlio/submaps/registration.h>

#include <Eigen/LU>

#include <cmath>

namespace fastlio
{
namespace
{
// Fewer points do not show the thickness of a wall.
constexpr float kFewestPoints = 20.0F;
constexpr float kLeastSpread = 1e-4F;  // of single precision [m]
constexpr double kUpright = 0.5;       // cosine between normal and gravity

/** A plane in double precision. */
struct Wall
{
  explicit Wall(const VoxelPlane& voxel)
      : normal(voxel.normal()), centroid(voxel.centroid()), plane(voxel)
  {
  }

  Vec3 normal, centroid;
  VoxelPlane plane;
};

/** Upright planes of a submap, whose variance is the one that was measured: the floor for the
 * sensor's noise would hide how thin a single pass is. */
std::vector<VoxelPlane> wallsOf(const SubmapSurfaces& submap, const Mat3& R_world_submap)
{
  std::vector<VoxelPlane> walls;
  for (std::size_t i = 0; i < submap.planes.size(); ++i)
  {
    VoxelPlane plane = submap.planes[i];
    const bool is_upright = std::abs((R_world_submap * plane.normal()).z()) < kUpright;
    if (!is_upright || plane.inverse_count * kFewestPoints > 1.0F) continue;
    const float spread = std::max(submap.spreads[i], kLeastSpread);
    plane.variance = spread * spread;
    walls.push_back(plane);
  }
  return walls;
}

/** Second moment of a wall's points about their centroid [m^2]. */
Mat3 momentOf(const Wall& wall)
{
  const Mat3 across = wall.normal * wall.normal.transpose();
  // The leverage is the inverse within the plane, over the number of points.
  const Mat3 within = wall.plane.leverageMatrix() / static_cast<double>(wall.plane.inverse_count);
  const Mat3 regular = within + across;
  return regular.inverse() + (static_cast<double>(wall.plane.variance) - 1.0) * across;
}

/** rms distance of two walls' points from one plane: through the middle between them, with their
 * mean direction. The plane of least squares would lean over from the one patch to the other where
 * these lie beside each other, and hide a step. */
double thicknessOf(const Wall& a, const Wall& b, const Pose& T_a_b)
{
  const Vec3 turned = T_a_b.R * b.normal;
  const Vec3 n = (a.normal + (a.normal.dot(turned) < 0.0 ? -1.0 : 1.0) * turned).normalized();
  const double apart = n.dot(T_a_b * b.centroid - a.centroid);
  const Vec3 n_in_b = T_a_b.R.transpose() * n;
  const double of_both = n.dot(momentOf(a) * n) + n_in_b.dot(momentOf(b) * n_in_b);
  return std::sqrt(std::max(0.0, 0.5 * of_both + 0.25 * apart * apart));
}

/** Whether both are the same piece of wall: beside each other, seen from the same side. The
 * distance across the wall does not matter. */
bool isSameWall(const PlanePair& pair, const Wall& target, const Pose& T_a_b)
{
  const VoxelPlane& plane = pair.target;
  const Eigen::Vector3f at = pair.at.cast<float>();
  // Within a standard deviation of the target's points, along the wall.
  const bool is_beside =
      plane.offsetVariance(at.x(), at.y(), at.z()) <= 2.0F * plane.variance * plane.inverse_count;
  const Vec3& n = target.normal;
  return is_beside && n.dot(target.centroid) * n.dot(pair.at - T_a_b.p) > 0.0;
}

/** Of each wall. */
struct Thicknesses
{
  std::vector<double> single, before, after;
};

void addWalls(const MappingResult& r, const Closure& closure, Thicknesses& all)
{
  const Submap &a = r.submaps.at(closure.a), &b = r.submaps.at(closure.b);
  const Pose &T_world_a = r.estimate.nodes.at(closure.a),
             &T_world_b = r.estimate.nodes.at(closure.b);
  const Pose T_a_b = T_world_a.inverse() * T_world_b;
  const Pose odometry = a.reference.T_world_body.inverse() * b.reference.T_world_body;
  const std::vector<VoxelPlane> sources = wallsOf(*b.surfaces.get(), T_world_b.R);
  for (const PlanePair& pair :
       SubmapRegistration(wallsOf(*a.surfaces.get(), T_world_a.R)).pairs(sources, T_a_b))
  {
    const Wall target(pair.target), source(sources[pair.source]);
    if (!isSameWall(pair, target, T_a_b)) continue;
    all.single.push_back(
        std::sqrt(0.5 * static_cast<double>(target.plane.variance + source.plane.variance)));
    all.after.push_back(thicknessOf(target, source, T_a_b));
    if (a.session == b.session) all.before.push_back(thicknessOf(target, source, odometry));
  }
}
}  // namespace

std::optional<WallThickness> wallThickness(const MappingResult& result)
{
  Thicknesses all;
  for (const Closure& closure : result.closures)
    if (closure.verdict == ClosureVerdict::Accepted) addWalls(result, closure, all);
  if (all.after.empty()) return std::nullopt;
  WallThickness thickness;
  thickness.walls = all.after.size();
  if (!all.before.empty()) thickness.before = median(std::move(all.before));
  thickness.single = median(std::move(all.single));
  thickness.after = median(std::move(all.after));
  return thickness;
}

}  // namespace fastlio
