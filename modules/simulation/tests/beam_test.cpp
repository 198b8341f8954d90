// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/simulation/beam.h>
#include <fastlio/simulation/panes.h>
#include <fastlio/worlds/world.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kFar = 100.0;

Primitive wall(double x, double min_y, double max_y, double reflectivity = 0.5)
{
  return {
      Primitive::Shape::Box,
      {Mat3::Identity(), {x + 0.5, 0.5 * (min_y + max_y), 0.0}},
      {0.5, 0.5 * (max_y - min_y), 20.0},
      reflectivity};
}

std::optional<Return> through(const Panes& panes, const Ray& ray, const FirstHit& first)
{
  return panes.follow(ray, first(ray, kFar), kFar, first);
}

/** Ranges of a fan of horizontal beams from the origin. */
class Fan
{
 public:
  Fan(std::vector<Primitive> bodies, const BeamSettings& beam)
      : world_({std::move(bodies), {}, std::nullopt}), beam_(beam)
  {
  }

  [[nodiscard]] std::optional<Return> at(double azimuth) const
  {
    const Ray middle{Vec3::Zero(), {std::cos(azimuth), std::sin(azimuth), 0.0}};
    const RayBundle rays = beam_.rays(middle, Vec3::UnitZ());
    const BundleHits hits = world_.cast(rays, 0.0, kFar);
    BeamReturns backs;
    for (std::size_t i = 0; i < rays.count; ++i)
      backs[i] = through(Panes({}), rays.ray(i), [&](const Ray&, double) { return hits[i]; });
    return beam_.receive(backs);
  }

 private:
  World world_;
  Beam beam_;
};

BeamSettings wide()
{
  BeamSettings beam;
  beam.divergence_horizontal = 3e-3;
  beam.divergence_vertical = 1.5e-3;
  return beam;
}

/** Azimuths whose ranges lie between two walls, neither on the one nor on the other. */
double mixedWidth(const Fan& fan, double near, double far)
{
  constexpr double kStep = 1e-5;
  int mixed = 0;
  for (double azimuth = -0.01; azimuth < 0.01; azimuth += kStep)
  {
    const auto back = fan.at(azimuth);
    if (!back) continue;
    const double depth = back->range * std::cos(azimuth);
    mixed += depth > near + 0.01 && depth < far - 0.01 ? 1 : 0;
  }
  return mixed * kStep;
}

TEST(Beam, MixesTwoSurfacesAtAnEdgeOverItsWidth)
{
  // The edge of the near wall is at azimuth 0; the far one is within a pulse behind.
  const std::vector<Primitive> step{wall(10.0, -5.0, 0.0), wall(10.4, -5.0, 5.0)};
  EXPECT_EQ(mixedWidth(Fan(step, {}), 10.0, 10.4), 0.0);
  // Rays lie at 0.6 of the half widths.
  EXPECT_NEAR(mixedWidth(Fan(step, wide()), 10.0, 10.4), 0.6 * 3e-3, 1e-4);
}

TEST(Beam, TakesTheStrongerOfTwoSurfacesFarApart)
{
  const std::vector<Primitive> step{wall(10.0, -5.0, 0.0, 0.5), wall(20.0, -9.0, 9.0, 0.5)};
  const Fan fan(step, wide());
  EXPECT_EQ(mixedWidth(fan, 10.0, 20.0), 0.0);
  // Two of five rays meet the near wall, which gives 2 / 10^2 against 3 / 20^2.
  const auto back = fan.at(0.6e-3);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->range, 10.0, 0.01);
  const auto beyond = fan.at(1.2e-3);
  ASSERT_TRUE(beyond);
  EXPECT_NEAR(beyond->range, 20.0, 0.01);
}

TEST(Beam, IsARayWhereItMeetsOneFlatSurface)
{
  const std::vector<Primitive> one{wall(10.0, -50.0, 50.0)};
  const Fan narrow(one, {}), broad(one, wide());
  for (double azimuth = -1.0; azimuth <= 1.0; azimuth += 0.1)
    EXPECT_NEAR(broad.at(azimuth)->range, narrow.at(azimuth)->range, 2e-4) << azimuth;
}

TEST(Beam, ThatNothingSendsBackGivesNothing)
{
  EXPECT_FALSE(Fan({}, wide()).at(0.0));
}

/** How many of many horizontal rays through a long wall come back from where. */
struct Shares
{
  double wall = 0.0, behind = 0.0, mirrored = 0.0, none = 0.0;
};

Shares sharesOf(const SurfaceSettings& settings)
{
  // Rays go from x = 0 askew to a thin wall at x = 10; beyond it is one, and one behind the rays.
  Primitive thin = wall(10.0, -9e3, 9e3);
  thin.size.x() = 0.05;
  thin.T_world_local.p.x() = 10.05;
  const World world({{thin, wall(16.0, -9e3, 9e3), wall(-9.0, -9e3, 9e3)}, {}, std::nullopt});
  const Panes panes(settings);
  const FirstHit first = [&](const Ray& ray, double reach)
  {
    auto hit = world.cast(ray, 0.0, reach);
    // Only the thin wall has panes.
    if (hit) hit->flat = std::abs((ray.origin + hit->range * ray.direction).x() - 10.5) < 0.6;
    return hit;
  };
  Shares shares;
  constexpr int kRays = 20000;
  const Vec3 direction = Vec3(2.0, 1.0, 0.0).normalized();
  for (int i = 0; i < kRays; ++i)
  {
    const auto back = through(panes, {{0.0, 0.37 * i - 4000.0, 0.5}, direction}, first);
    const double depth = back ? back->range * direction.x() : 0.0;
    const auto is = [depth](double x) { return std::abs(depth - x) < 1e-3 ? 1.0 / kRays : 0.0; };
    shares.wall += is(10.0);
    shares.behind += is(16.0);
    shares.mirrored += is(10.0 + 18.0);
    shares.none += back ? 0.0 : 1.0 / kRays;
  }
  return shares;
}

TEST(Panes, AreTheShareOfUprightFlatSurfacesThatTheSettingsSay)
{
  const Shares shares = sharesOf({0.2, 0.1});
  EXPECT_NEAR(shares.mirrored, 0.1, 0.02);
  EXPECT_NEAR(shares.behind, 0.2, 0.03);
  EXPECT_NEAR(shares.wall, 0.7, 0.03);
  const Shares matt = sharesOf({});
  EXPECT_NEAR(matt.wall, 1.0, 1e-9);
}

TEST(Panes, ShineBackAtARightAngleOnly)
{
  const World world({{wall(10.0, -9e3, 9e3)}, {}, std::nullopt});
  const Panes glass({1.0, 0.0});
  const FirstHit first = [&](const Ray& ray, double reach) { return world.cast(ray, 0.0, reach); };
  const auto straight = through(glass, {Vec3::Zero(), Vec3::UnitX()}, first);
  ASSERT_TRUE(straight);
  EXPECT_NEAR(straight->range, 10.0, 1e-9);
  EXPECT_FALSE(through(glass, {Vec3::Zero(), Vec3(1.0, 0.3, 0.0).normalized()}, first));
}

TEST(Panes, AreNeitherGroundNorRound)
{
  WorldDescription parts;
  parts.bodies.push_back(
      {Primitive::Shape::Rectangle, {Mat3::Identity(), {0, 0, -1}}, {50, 50, 0}, 0.5});
  parts.bodies.push_back(
      {Primitive::Shape::Cylinder, {Mat3::Identity(), {20, 0, 0}}, {2, 2, 9}, 0.5});
  const World world(parts);
  const Panes all_glass({1.0, 0.0});
  const FirstHit first = [&](const Ray& ray, double reach) { return world.cast(ray, 0.0, reach); };
  EXPECT_NEAR(through(all_glass, {Vec3::Zero(), -Vec3::UnitZ()}, first)->range, 1.0, 1e-9);
  EXPECT_NEAR(through(all_glass, {{0, 0.5, 0}, Vec3::UnitX()}, first)->range, 18.06, 0.01);
}
}  // namespace
}  // namespace fastlio
