// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_bodies.h"
#include "surface_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace fastlio
{
namespace
{
/** First distance at which a ray comes within tolerance of a surface, by sphere tracing. */
double traced(const Primitive& primitive, const Ray& ray, double max_range)
{
  double t = 0.0;
  while (t < max_range)
  {
    const double d = testing::surfaceDistance(primitive, ray.origin + t * ray.direction);
    if (d < 1e-9) return t;
    t += std::max(d, 1e-9);
  }
  return max_range;
}

/** A body, and a ray to somewhere near it. */
struct Aimed
{
  Primitive primitive;
  Ray ray;
  std::optional<RayHit> hit;
};

Aimed aimed(Dice& dice)
{
  const Primitive primitive = randomPrimitive(dice, 2.0);
  const Vec3 origin = dice.point(4.0);
  const Ray ray{origin, (dice.point(2.0) - origin).normalized()};
  return {primitive, ray, intersect(primitive, ray)};
}

TEST(Primitive, RaysHitWhereSphereTracingDoes)
{
  Dice dice;
  int hits = 0;
  for (int i = 0; i < 3000; ++i)
  {
    const auto [primitive, ray, hit] = aimed(dice);
    const double expected = traced(primitive, ray, 20.0);
    // Sphere tracing creeps past grazing surfaces: both must agree whenever the ray is not grazing.
    if (hit && std::abs(hit->normal.dot(ray.direction)) < 0.02) continue;
    EXPECT_NEAR(hit ? hit->range : 20.0, expected, 1e-6) << "ray " << i;
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, 300);
}

TEST(Primitive, NormalsAreUnitAndFaceTheRay)
{
  Dice dice;
  for (int i = 0; i < 2000; ++i)
  {
    const auto [primitive, ray, hit] = aimed(dice);
    if (!hit) continue;
    EXPECT_NEAR(hit->normal.norm(), 1.0, 1e-12);
    EXPECT_LE(hit->normal.dot(ray.direction), 0.0);
    // Along the normal the distance grows as fast as the way.
    const Vec3 at = ray.origin + hit->range * ray.direction;
    const double off = testing::surfaceDistance(primitive, at + 1e-5 * hit->normal);
    EXPECT_NEAR(off, 1e-5, 1e-8);
  }
}

TEST(Primitive, BoundsHoldTheSurface)
{
  Dice dice;
  for (int i = 0; i < 2000; ++i)
  {
    const auto [primitive, ray, hit] = aimed(dice);
    if (!hit) continue;
    const Vec3 at = ray.origin + hit->range * ray.direction;
    const Bounds bounds = boundsOf(primitive);
    EXPECT_TRUE((at - bounds.min).minCoeff() > -1e-8 && (bounds.max - at).minCoeff() > -1e-8);
  }
}

/** Fraction of rays through the middle of a crown of leaves that end within a depth of its border.
 */
double caughtWithin(const Primitive& crown, double depth)
{
  Dice dice;
  constexpr int kRays = 4000;
  int caught = 0;
  for (int i = 0; i < kRays; ++i)
  {
    const Vec3 aside = 0.2 * dice.direction();
    const Vec3 origin = crown.T_world_local.p + 9.0 * dice.direction();
    const Vec3 target = crown.T_world_local.p + aside;
    const auto hit = intersect(crown, {origin, (target - origin).normalized()});
    if (!hit) continue;
    const Vec3 at = origin + hit->range * (target - origin).normalized();
    EXPECT_LE((at - crown.T_world_local.p).norm(), crown.size.x() + 1e-9);
    caught += (at - crown.T_world_local.p).norm() > crown.size.x() - depth ? 1 : 0;
  }
  return static_cast<double>(caught) / kRays;
}

TEST(Primitive, FoliageCatchesLightAtRandomDepths)
{
  const Primitive crown{
      Primitive::Shape::Foliage, {Mat3::Identity(), {3.0, -2.0, 4.0}}, Vec3::Constant(2.0), 0.3};
  // One of six steps of 0.1 m ends at a leaf.
  EXPECT_NEAR(caughtWithin(crown, 0.3), 1.0 - std::pow(5.0 / 6.0, 3), 0.06);
  EXPECT_NEAR(caughtWithin(crown, 1.0), 1.0 - std::pow(5.0 / 6.0, 10), 0.04);
  // Trees stand still: the same ray ends at the same leaf.
  const Ray ray{Vec3::Zero(), Vec3(3.0, -2.0, 4.2).normalized()};
  ASSERT_TRUE(intersect(crown, ray));
  EXPECT_EQ(intersect(crown, ray)->range, intersect(crown, ray)->range);
}
}  // namespace
}  // namespace fastlio
