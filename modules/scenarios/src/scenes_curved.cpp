// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/scenarios/scenes.h>
#include <fastlio/worlds/world_parts.h>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kHandHeight = 1.4;  // of a sensor that is carried

/** Hills with slopes of up to 20 %, and tufts. */
double parkGround(double x, double y)
{
  return 1.9 * std::sin(0.09 * x + 0.3) + 1.6 * std::cos(0.085 * y - 0.2) +
         0.04 * std::sin(1.1 * x) * std::cos(0.9 * y) + 0.015 * std::sin(2.9 * x + 2.3 * y);
}

/** Points spread evenly over a disc, in a fixed order (a sunflower's). */
Vec3 sunflower(int i, double spacing)
{
  const double r = spacing * std::sqrt(i + 0.5), angle = 2.399963229728653 * i;
  return {r * std::cos(angle), r * std::sin(angle), 0.0};
}

/** Horizontal distance of a place to a path. */
double distanceTo(const CarrierPath& path, const Vec3& place)
{
  double least = 1e9;
  for (double u = 0.0; u < path.loop_time; u += 0.2)
  {
    const double dx = path.channels[CarrierPath::kX].value(u) - place.x();
    const double dy = path.channels[CarrierPath::kY].value(u) - place.y();
    least = std::min(least, std::hypot(dx, dy));
  }
  return least;
}

Primitive foliage(const Vec3& center, double radius)
{
  return {Primitive::Shape::Foliage, {Mat3::Identity(), center}, Vec3::Constant(radius), 0.3};
}

/** A trunk that leans a little and a crown of leaves; no two alike. */
void appendLeafyTree(Bodies& bodies, const Vec3& place, int kind)
{
  const double height = 5.0 + kind % 5, base = parkGround(place.x(), place.y()) - 0.1;
  Primitive trunk = pillar(place.x(), place.y(), 0.12 + 0.03 * (kind % 4), 0.6 * height, base, 0.3);
  trunk.T_world_local.R = expSO3({0.05 * std::sin(1.3 * kind), 0.05 * std::cos(2.1 * kind), 0.0});
  bodies.push_back(trunk);
  const Vec3 top(place.x(), place.y(), base + 0.72 * height);
  bodies.push_back(foliage(top, 0.26 * height));
  bodies.push_back(foliage(top + Vec3(0.17, 0.1, -0.1) * height, 0.18 * height));
  bodies.push_back(foliage(top + Vec3(-0.13, -0.16, -0.12) * height, 0.2 * height));
}

void appendPlant(Bodies& bodies, const Vec3& place, int kind)
{
  const double x = place.x(), y = place.y(), base = parkGround(x, y);
  switch (kind % 6)
  {
    case 0:  // a rock
      bodies.push_back(ball({x, y, base + 0.1}, 0.4 + 0.05 * (kind % 7), 0.35));
      break;
    case 1:  // a bush
      bodies.push_back(foliage({x, y, base + 0.5}, 0.9));
      break;
    case 2:  // a bench
      bodies.push_back(box({x, y, 1.7, 0.5, 0.5, base, 0.7 * kind, 0.4}));
      bodies.push_back(box({x, y, 1.7, 0.08, 0.9, base, 0.7 * kind, 0.4}));
      break;
    case 3:  // a lamp
      bodies.push_back(pillar(x, y, 0.07, 4.0, base - 0.1, 0.6));
      break;
    default:
      appendLeafyTree(bodies, place, kind);
  }
}

/** Round buildings and a mound: nothing flat. */
void appendRoundBuildings(Bodies& bodies)
{
  bodies.push_back(pillar(2, 1, 4.0, 7.0, -2.0, 0.55));
  bodies.push_back(pillar(36, -20, 6.0, 11.0, -4.0, 0.5));
  bodies.push_back(pillar(-30, -27, 5.0, 9.0, -4.0, 0.6));
  bodies.push_back(ball({-36, 18, -2.5}, 8.0, 0.4));
  bodies.push_back(ball({10, 38, -1.5}, 6.0, 0.4));
}

/** Things on show around a ring: boxes at any angle, spheres, columns. */
void appendExhibits(Bodies& bodies)
{
  constexpr int kColumns = 11, kExhibits = 19;
  for (int i = 0; i < kColumns; ++i)
  {
    const double a = kTwoPi * i / kColumns;
    bodies.push_back(pillar(10.2 * std::cos(a), 10.2 * std::sin(a), 0.25, 5.0, 0.0, 0.6));
  }
  for (int i = 0; i < kExhibits; ++i)
  {
    const double a = kTwoPi * i / kExhibits + 0.1 * std::sin(2.7 * i);
    const double r = i % 3 == 0 ? 5.0 : 9.5 + 0.3 * std::sin(1.9 * i);
    const double x = r * std::cos(a), y = r * std::sin(a), high = 0.7 + 0.25 * (i % 4);
    bodies.push_back(
        box({x, y, 0.6, 0.4 + 0.1 * (i % 5), high, 0.0, 1.7 * i, 0.2 + 0.06 * (i % 9)}));
    if (i % 2 == 0) bodies.push_back(ball({x, y, high + 0.25}, 0.25, 0.5));
  }
}

/** The floor of a ramp that winds around a drum, of slabs as a builder pours them. */
struct RoundRamp
{
  static constexpr double kDrum = 6.0, kOuter = 15.0;  // radii [m]
  static constexpr double kRise = 3.2;                 // of a turn [m]
  static constexpr int kSlabs = 24;                    // of a turn

  [[nodiscard]] static Vec3 place(double radius, double angle)
  {
    return {radius * std::cos(angle), radius * std::sin(angle), kRise * angle / kTwoPi};
  }
};

void appendRampSlabs(Bodies& bodies, double angle)
{
  constexpr double kThickness = 0.25, kWidth = 0.5 * (RoundRamp::kOuter - RoundRamp::kDrum);
  for (const double inner : {RoundRamp::kDrum, RoundRamp::kDrum + kWidth})
  {
    const double radius = inner + 0.5 * kWidth;
    const double slope = std::atan(RoundRamp::kRise / (kTwoPi * radius));
    const double half_length = (inner + kWidth) * std::tan(kPi / RoundRamp::kSlabs);
    const Vec3 top = RoundRamp::place(radius, angle);
    bodies.push_back(
        {Primitive::Shape::Box,
         {expSO3({0.0, 0.0, angle + 0.5 * kPi}) * expSO3({0.0, -slope, 0.0}),
          top - Vec3(0.0, 0.0, 0.5 * kThickness)},
         {half_length, 0.5 * kWidth, 0.5 * kThickness},
         0.35});
  }
}

/** Floors, parked cars, columns; the ramp goes on below the way and above it. */
void appendRamp(Bodies& bodies, int turns)
{
  constexpr int kColumns = 10;
  const double height = (turns + 2) * RoundRamp::kRise, below = -1.5 * RoundRamp::kRise;
  bodies.push_back(pillar(0, 0, RoundRamp::kOuter, height - below, below, 0.5));
  bodies.push_back(pillar(0, 0, RoundRamp::kDrum, height - below + 1.0, below - 0.5, 0.45));
  for (int i = 0; i < kColumns; ++i)
  {
    const Vec3 foot = RoundRamp::place(12.4, kTwoPi * i / kColumns);
    bodies.push_back(pillar(foot.x(), foot.y(), 0.3, height - below, below, 0.5));
  }
  for (int i = -RoundRamp::kSlabs; i < (turns + 2) * RoundRamp::kSlabs; ++i)
  {
    const double angle = kTwoPi * (i + 0.5) / RoundRamp::kSlabs;
    appendRampSlabs(bodies, angle);
    const Vec3 stand = RoundRamp::place(13.5, angle);
    // Never two beside each other: a car is longer than a slab.
    if (i > 0 && i % 2 == 0 && (i * i + 3 * i) % 7 < 4)
      appendCar(bodies, stand.x(), stand.y(), stand.z(), angle + 0.5 * kPi);
  }
}
}  // namespace

Scene parkScene()
{
  Scene scene;
  Route route;
  route.corners = {{-20, -14, kHandHeight}, {2, -19, kHandHeight}, {22, -12, kHandHeight},
                   {24, 8, kHandHeight},    {8, 15, kHandHeight},  {-8, 12, kHandHeight},
                   {-24, 16, kHandHeight},  {-26, 0, kHandHeight}};
  route.speed = 1.3;
  route.corner_cut = 5.0;
  route.ground = parkGround;
  scene.path = followRoute(route);
  constexpr int kPlants = 130;
  constexpr double kSpacing = 4.4, kPathWidth = 2.6;
  appendRoundBuildings(scene.world.bodies);
  for (int i = 3; i < kPlants; ++i)
    if (const Vec3 place = sunflower(i, kSpacing); distanceTo(scene.path, place) > kPathWidth)
      appendPlant(scene.world.bodies, place, i);
  scene.world.ground = HeightField({-90, -90, 0.75, 240, 240}, parkGround, 0.25);
  addWalkingSway(scene.path, 1.9);
  return scene;
}

Scene rotundaScene()
{
  constexpr double kHeight = 5.0, kOuter = 11.0, kDrum = 4.0, kWalk = 7.3;
  constexpr int kCorners = 9;
  Scene scene;
  // Cylinders have lids: floor and ceiling.
  scene.world.bodies = {
      pillar(0, 0, kOuter, kHeight, 0.0, 0.6), pillar(0, 0, kDrum, kHeight + 1.0)};
  appendExhibits(scene.world.bodies);
  Route route;
  for (int i = 0; i < kCorners; ++i)
  {
    const double a = kTwoPi * i / kCorners, r = kWalk + 0.5 * std::sin(2.0 * a);
    route.corners.emplace_back(r * std::cos(a), r * std::sin(a), kHandHeight);
  }
  route.speed = 1.0;
  route.corner_cut = 3.0;
  scene.path = followRoute(route);
  addWalkingSway(scene.path, 1.8);
  return scene;
}

Scene rampScene()
{
  constexpr int kTurns = 4, kCorners = 24 * kTurns;
  constexpr double kUp = 8.4, kDown = 11.2;  // radii of both lanes [m]
  Scene scene;
  appendRamp(scene.world.bodies, kTurns);
  Route route;
  const Vec3 sensor(0.0, 0.0, 1.2);
  for (int i = 0; i <= kCorners; ++i)
    route.corners.emplace_back(RoundRamp::place(kUp, kTwoPi * i / 24) + sensor);
  for (int i = kCorners; i >= 0; --i)
    route.corners.emplace_back(RoundRamp::place(kDown, kTwoPi * i / 24) + sensor);
  route.speed = 3.0;
  route.corner_cut = 2.0;
  route.acceleration = 1.2;
  scene.path = followRoute(route);
  return scene;
}

}  // namespace fastlio
