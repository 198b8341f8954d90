// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "surface_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace fastlio
{
namespace
{
class Dice
{
 public:
  double operator()(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 point(double half)
  {
    const double x = (*this)(-half, half), y = (*this)(-half, half), z = (*this)(-half, half);
    return {x, y, z};
  }
  Vec3 direction() { return point(1.0).normalized(); }

 private:
  std::mt19937_64 engine_{7};
};

Primitive randomPrimitive(Dice& dice, double spread)
{
  Primitive p;
  p.shape = static_cast<Primitive::Shape>(static_cast<int>(dice(0.0, 3.999)));
  p.T_world_local = {expSO3(dice.point(2.0)), dice.point(spread)};
  p.size = Vec3(dice(0.2, 2.0), dice(0.2, 2.0), dice(0.2, 2.0));
  return p;
}

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

TEST(Primitive, RaysHitWhereSphereTracingDoes)
{
  Dice dice;
  int hits = 0;
  for (int i = 0; i < 3000; ++i)
  {
    const Primitive primitive = randomPrimitive(dice, 2.0);
    const Vec3 origin = dice.point(4.0);
    const Ray ray{origin, (dice.point(2.0) - origin).normalized()};
    const auto hit = intersect(primitive, ray);
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
    const Primitive primitive = randomPrimitive(dice, 2.0);
    const Vec3 origin = dice.point(4.0);
    const Ray ray{origin, (dice.point(2.0) - origin).normalized()};
    const auto hit = intersect(primitive, ray);
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
    const Primitive primitive = randomPrimitive(dice, 2.0);
    const Vec3 origin = dice.point(4.0);
    const Ray ray{origin, (dice.point(2.0) - origin).normalized()};
    const auto hit = intersect(primitive, ray);
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

TEST(World, HierarchyFindsWhatTestingEveryBodyFinds)
{
  Dice dice;
  WorldDescription parts;
  for (int i = 0; i < 300; ++i)
    parts.bodies.push_back(randomPrimitive(dice, 15.0));
  const World world(parts);
  int hits = 0;
  for (int i = 0; i < 4000; ++i)
  {
    Ray ray{dice.point(15.0), dice.direction()};
    if (i % 10 == 0) ray.direction = Vec3::Unit(i / 10 % 3);  // zero components
    std::optional<RayHit> nearest;
    for (const auto& body : parts.bodies)
    {
      const auto hit = intersect(body, ray);
      if (hit && hit->range <= (nearest ? nearest->range : 40.0)) nearest = hit;
    }
    const auto found = world.cast(ray, 0.0, 40.0);
    ASSERT_EQ(found.has_value(), nearest.has_value());
    if (!found) continue;
    EXPECT_EQ(found->range, nearest->range);
    ++hits;
  }
  EXPECT_GT(hits, 1000);
}

double hilly(double x, double y)
{
  return 1.5 * std::sin(0.4 * x) * std::cos(0.3 * y) + 0.1 * x;
}

TEST(World, ABundleMeetsWhatItsRaysMeetOneByOne)
{
  Dice dice;
  WorldDescription parts;
  for (int i = 0; i < 200; ++i)
    parts.bodies.push_back(randomPrimitive(dice, 15.0));
  for (int i = 0; i < 20; ++i)
    parts.moving.push_back({randomPrimitive(dice, 15.0), dice.point(2.0), 0.7, 0.1 * i});
  parts.ground.emplace(HeightField::Extent{-15.0, -15.0, 1.0, 30, 30}, hilly, 0.3);
  const World world(parts);
  int hits = 0;
  for (int i = 0; i < 2000; ++i)
  {
    RayBundle rays({dice.point(15.0), dice.direction()});
    const double width = i % 2 == 0 ? 0.01 : 1.0;
    while (rays.count < 1 + static_cast<std::size_t>(i) % RayBundle::kMost)
      rays.directions[rays.count++] = (rays.directions[0] + width * dice.direction()).normalized();
    const double t = 0.01 * i;
    const BundleHits found = world.cast(rays, t, 20.0);
    for (std::size_t ray = 0; ray < rays.count; ++ray)
    {
      const auto alone = world.cast(rays.ray(ray), t, 20.0);
      ASSERT_EQ(found[ray].has_value(), alone.has_value());
      if (!alone) continue;
      EXPECT_EQ(found[ray]->range, alone->range);
      EXPECT_EQ(found[ray]->normal, alone->normal);
      EXPECT_EQ(found[ray]->reflectivity, alone->reflectivity);
      ++hits;
    }
    for (std::size_t none = rays.count; none < RayBundle::kMost; ++none)
      EXPECT_FALSE(found[none].has_value());
  }
  EXPECT_GT(hits, 3000);
}

TEST(World, OfBodiesInTheSamePlaceTheSameOneIsHitFromEverySide)
{
  Dice dice;
  WorldDescription parts;
  for (int i = 0; i < 50; ++i)
  {
    parts.bodies.push_back(randomPrimitive(dice, 15.0));
    parts.bodies.back().reflectivity = 0.01 * i;
    parts.bodies.push_back(parts.bodies.back());
    parts.bodies.back().reflectivity += 0.5;
  }
  const World world(parts);
  std::map<int, double> seen;  // which of two, by the pair's number
  for (int i = 0; i < 4000; ++i)
    if (const auto hit = world.cast({dice.point(15.0), dice.direction()}, 0.0, 40.0))
    {
      const int pair = static_cast<int>(std::lround(100.0 * hit->reflectivity)) % 50;
      EXPECT_EQ(seen.emplace(pair, hit->reflectivity).first->second, hit->reflectivity);
    }
  EXPECT_GT(seen.size(), 30U);
}

TEST(HeightField, RaysEndOnTheSurfaceAndPassNothingBefore)
{
  Dice dice;
  const HeightField field({-20, -15, 0.5, 80, 60}, hilly, 0.3);
  int hits = 0;
  for (int i = 0; i < 3000; ++i)
  {
    const Vec3 side = dice.point(14.0);
    const Ray ray{
        Vec3(side.x(), side.y(), field.height(side.x(), side.y()) + dice(0.05, 4.0)),
        dice.direction()};
    const auto hit = field.cast(ray, 60.0);
    const double end = hit ? hit->range : 60.0;
    for (double t = 0.0; t < end; t += 0.05)
    {
      const Vec3 p = ray.origin + t * ray.direction;
      const bool within = std::abs(p.x()) < 20.0 && std::abs(p.y()) < 15.0;
      const double above = within ? p.z() - field.height(p.x(), p.y()) : 0.0;
      ASSERT_GT(above, -1e-9) << "ray " << i;
    }
    if (!hit) continue;
    const Vec3 at = ray.origin + hit->range * ray.direction;
    EXPECT_NEAR(at.z(), field.height(at.x(), at.y()), 1e-6);
    EXPECT_LT(hit->normal.dot(ray.direction), 0.0);
    ++hits;
  }
  EXPECT_GT(hits, 1000);
}

TEST(HeightField, VerticalRaysAndRaysFromBelowHit)
{
  const HeightField field({-5, -5, 1.0, 10, 10}, hilly, 0.3);
  for (const double x : {-4.3, 0.0, 2.0, 4.99})
  {
    const auto down = field.cast({{x, 1.0, 50.0}, -Vec3::UnitZ()}, 100.0);
    const auto up = field.cast({{x, 1.0, -50.0}, Vec3::UnitZ()}, 100.0);
    ASSERT_TRUE(down && up);
    EXPECT_NEAR(50.0 - down->range, field.height(x, 1.0), 1e-9);
    EXPECT_NEAR(up->range - 50.0, field.height(x, 1.0), 1e-9);
  }
  EXPECT_FALSE(field.cast({{7.0, 1.0, 50.0}, -Vec3::UnitZ()}, 100.0));
  EXPECT_THROW(HeightField({0, 0, 1.0, 0, 5}, hilly, 0.3), std::invalid_argument);
}

TEST(World, MovingObjectsAreHitWhereTheyAre)
{
  MovingObject object;
  object.body.shape = Primitive::Shape::Sphere;
  object.body.T_world_local.p = Vec3(10.0, 0.0, 0.0);
  object.amplitude = Vec3(4.0, 0.0, 0.0);
  object.angular_frequency = 0.5;
  WorldDescription parts;
  parts.moving.push_back(object);
  const World world(parts);
  for (double t = 0.0; t < 15.0; t += 0.7)
  {
    const auto hit = world.cast({Vec3::Zero(), Vec3::UnitX()}, t, 100.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->range, 9.0 + 4.0 * std::sin(0.5 * t), 1e-9);
  }
}

TEST(World, EmptyWorldsAndFarSurfacesGiveNoHit)
{
  EXPECT_FALSE(World({}).cast({Vec3::Zero(), Vec3::UnitX()}, 0.0, 1e6));
  WorldDescription parts;
  parts.bodies.push_back({Primitive::Shape::Box, {Mat3::Identity(), {50, 0, 0}}, {1, 1, 1}, 0.5});
  const World world(parts);
  EXPECT_TRUE(world.cast({Vec3::Zero(), Vec3::UnitX()}, 0.0, 49.1));
  EXPECT_FALSE(world.cast({Vec3::Zero(), Vec3::UnitX()}, 0.0, 48.9));
}
}  // namespace
}  // namespace fastlio
