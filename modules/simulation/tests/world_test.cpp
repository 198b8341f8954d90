// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_bodies.h"
#include <fastlio/worlds/world.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace fastlio
{
namespace
{
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

TEST(World, RowsThatGetWiderAndWiderAreSearchedToTheirEnd)
{
  // Each cut leaves most of such a row on one side, so that its tree gets deep.
  constexpr int kCount = 500;
  WorldDescription parts;
  for (int i = 0; i < kCount; ++i)
  {
    const double at = std::pow(2.0, i);
    parts.bodies.push_back(
        {Primitive::Shape::Sphere, {Mat3::Identity(), {at, 0.0, at}}, Vec3::Constant(0.25 * at)});
  }
  const World world(parts);
  for (int i = 0; i < kCount; ++i)
  {
    const double at = std::pow(2.0, i);
    const auto hit = world.cast({{at, 0.0, 0.0}, Vec3::UnitZ()}, 0.0, 2.0 * at);
    ASSERT_TRUE(hit) << "sphere " << i;
    EXPECT_NEAR(hit->range / at, 0.75, 1e-9) << "sphere " << i;
  }
  // All of them on one ray.
  const auto first = world.cast({Vec3::Zero(), Vec3(1.0, 0.0, 1.0).normalized()}, 0.0, 1e300);
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->range, std::sqrt(2.0) - 0.25, 1e-9);
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
