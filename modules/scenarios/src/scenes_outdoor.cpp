// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/scenarios/scenes.h>
#include <fastlio/worlds/world_parts.h>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kWalkerHand = 1.4;  // height of a hand-held sensor

/** Lawn and paths: long waves and small bumps. */
double meadow(double x, double y)
{
  return 0.35 * std::sin(0.051 * x + 0.4) + 0.3 * std::sin(0.063 * y - 0.02 * x) +
         0.05 * std::sin(0.71 * x) * std::cos(0.63 * y) + 0.02 * std::sin(2.3 * x + 1.9 * y);
}

/** A road with a crown, hardly any waves. */
double roadway(double x, double y)
{
  return 0.05 * std::sin(0.11 * x) + 0.04 * std::sin(0.13 * y) +
         0.008 * std::sin(1.7 * x + 2.1 * y);
}

HeightField ground(double half_size, double cell, double (*height)(double, double))
{
  const int cells = static_cast<int>(std::ceil(2.0 * half_size / cell));
  return {{-half_size, -half_size, cell, cells, cells}, height, 0.25};
}

/** Buildings around a loop of about 46 m x 30 m and one within. */
Bodies campusBuildings()
{
  Bodies bodies;
  appendBuilding(bodies, {0, 0, 24, 10, 9, -0.5, 0.05, 0.5});
  appendBuilding(bodies, {-6, 36, 34, 12, 12, -0.5, -0.04, 0.5});
  appendBuilding(bodies, {32, 34, 16, 18, 7, -0.5, 0.2, 0.5});
  appendBuilding(bodies, {46, -4, 12, 36, 10, -0.5, 0.03, 0.5});
  appendBuilding(bodies, {8, -38, 46, 14, 11, -0.5, 0.0, 0.5});
  appendBuilding(bodies, {-44, 6, 14, 30, 8, -0.5, -0.12, 0.5});
  appendBuilding(bodies, {-40, -34, 18, 14, 6, -0.5, 0.5, 0.5});
  return bodies;
}

void appendCampusDetails(Bodies& bodies)
{
  const std::vector<Vec3> trees{{-30, 22, 7},  {-18, 22, 6}, {16, 22.5, 8}, {31, 18, 6},
                                {32, -18, 7},  {18, -23, 6}, {-4, -24, 8},  {-22, -22, 7},
                                {-31, -10, 6}, {-31, 8, 8},  {-12, 11, 5},  {15, -10, 5},
                                {-16, -6, 5},  {17, 8, 6}};
  for (const auto& t : trees)
    appendTree(bodies, t.x(), t.y(), meadow(t.x(), t.y()), t.z());
  for (const double x : {-24.0, -8.0, 8.0, 24.0})
    for (const double y : {-20.5, 20.5})
      bodies.push_back(pillar(x, y, 0.08, 5.5, meadow(x, y) - 0.1, 0.7));
  for (const double x : {-20.0, 3.0, 20.0})
    bodies.push_back(box({x, 19.5, 1.8, 0.5, 0.5, meadow(x, 19.5) - 0.05, 0.1, 0.4}));
  for (const double x : {-12.0, -4.0, 4.0, 26.0})
    appendCar(bodies, x, -28, meadow(x, -28), 1.5);
}

WorldDescription campusWorld()
{
  WorldDescription world;
  world.bodies = campusBuildings();
  appendCampusDetails(world.bodies);
  world.ground = ground(90, 1.0, meadow);
  return world;
}

/** City blocks along the streets of a rectangle, with parked cars, lamps and trees. */
WorldDescription streetWorld()
{
  WorldDescription world;
  for (int i = -3; i <= 3; ++i)
  {
    const double x = 26.0 * i, dy = 1.5 * ((i + 6) % 3);
    appendBuilding(world.bodies, {x, 56 + dy, 22, 14, 10.0 + 2 * ((i + 5) % 4), -0.5, 0.0, 0.5});
    appendBuilding(world.bodies, {x, -56 - dy, 20, 14, 8.0 + 3 * ((i + 4) % 3), -0.5, 0.0, 0.5});
  }
  for (int i = -1; i <= 1; ++i)
    for (const double x : {-86.0, 86.0})
      appendBuilding(world.bodies, {x, 30.0 * i, 14, 24, 11.0 + i, -0.5, 0.0, 0.5});
  for (int i = -1; i <= 1; ++i)
    for (const double y : {-14.0, 14.0})
      appendBuilding(
          world.bodies, {36.0 * i, y, 28, 18, 12.0 + 2 * i + 0.1 * y, -0.5, 0.02 * i, 0.5});
  for (int i = -5; i <= 5; ++i)
  {
    appendCar(world.bodies, 11.0 * i + 2, i % 2 == 0 ? 43.5 : 32.5, 0.0, 0.02 * i);
    appendCar(world.bodies, 11.0 * i - 3, i % 2 == 0 ? -43.5 : -32.5, 0.0, 0.01 * i);
  }
  for (int i = -4; i <= 4; ++i)
    for (const double y : {-45.5, 45.5})
      world.bodies.push_back(pillar(17.0 * i, y, 0.1, 7, -0.1));
  for (const double x : {-52.0, -26.0, 0.0, 26.0, 52.0})
    appendTree(world.bodies, x, 30, 0.0, 7);
  world.ground = ground(110, 1.0, roadway);
  return world;
}

MovingObject swinging(const Primitive& body, const Vec3& amplitude, double period, double phase)
{
  return {body, amplitude, 6.283185307179586 / period, phase};
}

void appendCrowd(std::vector<MovingObject>& moving)
{
  // On both long sides of the loop, most of them walking along beside the path.
  for (int i = 0; i < 40; ++i)
  {
    const double x = -26.0 + 1.35 * (i - i % 2), y = (i % 2 == 0 ? -20.0 : 19.0) + 0.4 * (i % 5);
    const Vec3 way = i % 5 == 0 ? Vec3(0.0, 1.2, 0.0) : Vec3(6.0, 0.2 * (i % 4), 0.0);
    const Primitive person = pillar(x, y, 0.28, 1.75, meadow(x, y), 0.4);
    moving.push_back(swinging(person, way, 14.0 + i, 0.9 * i));
  }
  for (int i = 0; i < 3; ++i)
  {
    const Primitive van = box({-5.0 + 8 * i, -24.5, 4.6, 1.9, 1.7, 0.1, 0.0, 0.6});
    moving.push_back(swinging(van, {14.0, 0.0, 0.0}, 16.0 + 3 * i, 2.0 * i));
  }
}
}  // namespace

Scene campusScene()
{
  Scene scene;
  scene.world = campusWorld();
  Route route;
  route.corners = {{-25, -16, kWalkerHand}, {0, -18, kWalkerHand}, {25, -16, kWalkerHand},
                   {27, 0, kWalkerHand},    {25, 15, kWalkerHand}, {2, 16.5, kWalkerHand},
                   {-25, 15, kWalkerHand},  {-27, 0, kWalkerHand}};
  route.speed = 1.4;
  route.corner_cut = 4.0;
  route.ground = meadow;
  // Scaled to a round length, which averaging the corners has shortened.
  constexpr double kLoop = 140.0;
  for (int i = 0; i < 3; ++i)
  {
    const double scale = kLoop / loopLength(followRoute(route));
    for (auto& corner : route.corners)
      corner.head<2>() *= scale;
  }
  scene.path = followRoute(route);
  addWalkingSway(scene.path, 1.9);
  return scene;
}

Scene uavScene()
{
  Scene scene;
  scene.world = campusWorld();
  Route route;
  route.corners = {{-22, -15, 4}, {10, -18, 7}, {25, -12, 6}, {26, 14, 9},
                   {0, 16, 6},    {-26, 16, 8}, {-28, 0, 5}};
  route.speed = 6.0;
  route.corner_cut = 10.0;
  scene.path = followRoute(route);
  addThrustTilt(scene.path, 9.81);
  addOscillation(scene.path, CarrierPath::kZ, 0.15, 0.4);
  addOscillation(scene.path, CarrierPath::kRoll, 0.03, 1.3);
  addOscillation(scene.path, CarrierPath::kPitch, 0.03, 1.1);
  return scene;
}

Scene streetScene()
{
  Scene scene;
  scene.world = streetWorld();
  Route route;
  route.corners = {{-50, -38, 1.6}, {66, -38, 1.6}, {66, 38, 1.6}, {-66, 38, 1.6}, {-66, -38, 1.6}};
  route.speed = 8.5;
  route.corner_cut = 14.0;
  route.ground = roadway;
  scene.path = followRoute(route);
  addOscillation(scene.path, CarrierPath::kZ, 0.012, 1.4);
  addOscillation(scene.path, CarrierPath::kPitch, 0.008, 1.2);
  addOscillation(scene.path, CarrierPath::kRoll, 0.012, 1.0);
  return scene;
}

Scene openAreaScene()
{
  Scene scene;
  Bodies& bodies = scene.world.bodies;
  for (int i = 0; i < 5; ++i)
  {
    const double x = -55.0 + 24.0 * i, y = i % 2 == 0 ? 46.0 : 52.0;
    bodies.push_back(box({x, y, 12.2, 2.44, 2.6 * (1 + i % 3), 0.0, 0.1 * i, 0.6}));
  }
  bodies.push_back(box({62, -12, 12.2, 2.44, 5.2, 0.0, 1.4, 0.6}));
  bodies.push_back(box({-66, -20, 12.2, 2.44, 2.6, 0.0, 0.7, 0.6}));
  for (const double x : {-40.0, -25.0})
    for (const double y : {-62.0, -52.0})
      bodies.push_back(box({x, y, 1.2, 1.2, 28, 0.0, 0.0, 0.5}));
  for (const double x : {-45.0, 10.0, 50.0})
    bodies.push_back(pillar(x, -36, 0.25, 12, 0.0, 0.7));
  for (const double x : {-12.0, 0.0, 12.0})
    bodies.push_back(pillar(x, 22, 0.3, 0.7, -0.05, 0.5));
  scene.world.ground = ground(150, 2.0, roadway);
  Route route;
  route.corners = {
      {-16, -14, kWalkerHand},
      {18, -14, kWalkerHand},
      {20, 12, kWalkerHand},
      {-16, 14, kWalkerHand}};
  route.speed = 1.5;
  route.corner_cut = 6.0;
  route.ground = roadway;
  scene.path = followRoute(route);
  addWalkingSway(scene.path, 1.9);
  return scene;
}

Scene crowdScene()
{
  Scene scene = campusScene();
  appendCrowd(scene.world.moving);
  return scene;
}

}  // namespace fastlio
