// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/scenarios/scenes.h>
#include <fastlio/worlds/world_parts.h>

#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kOfficeHeight = 2.8;
constexpr double kHand = 1.3;  // height of a hand-held sensor

/** Six rooms, three on each side of a corridor along x. */
Bodies officeBuilding()
{
  Bodies bodies{
      slab(0, 0, 24, 12, 0.0), slab(0, 0, 24, 12, kOfficeHeight, 0.7),
      shell({-0.3, -0.3, -0.3}, {24.3, 12.3, 3.1})};
  for (const double y : {5.0, 7.0})
    appendWall(bodies, {true, 0, 24, y, kOfficeHeight}, {{4.0}, {12.0}, {20.0}});
  for (const double y : {0.0, 12.0})
    appendWall(bodies, {true, 0, 24, y, kOfficeHeight});
  for (const double x : {0.0, 24.0})
    appendWall(bodies, {false, 0, 12, x, kOfficeHeight});
  for (const double x : {8.0, 16.0})
  {
    appendWall(bodies, {false, 0, 5, x, kOfficeHeight});
    appendWall(bodies, {false, 7, 12, x, kOfficeHeight});
  }
  for (const double x : {7.6, 16.4})
    bodies.push_back(pillar(x, 5.3, 0.2, kOfficeHeight));
  return bodies;
}

std::vector<Vec3> officeWaypoints()
{
  return {{4, 2.0, kHand},    {4, 6, kHand},      {12, 6, kHand},     {12, 8.0, kHand},
          {10.6, 9.5, kHand}, {12, 10.6, kHand},  {13.4, 9.5, kHand}, {12, 8.0, kHand},
          {12, 6, kHand},     {20, 6, kHand},     {20, 3.8, kHand},   {18.8, 2.6, kHand},
          {20, 1.6, kHand},   {21.2, 2.6, kHand}, {20, 3.8, kHand},   {20, 6, kHand},
          {4, 6, kHand},      {4, 4.0, kHand},    {2.8, 2.6, kHand}};
}

/** A furnished room from the origin, without doors. */
Bodies room(double length, double width, double height, int pieces, unsigned seed)
{
  Bodies bodies{shell({0, 0, 0}, {length, width, height})};
  appendFurniture(bodies, {0, 0, length, width, pieces, seed, {{0.5 * length, 0.5 * width, 0}}});
  bodies.push_back(pillar(0.2 * length, 0.75 * width, 0.25, height));
  bodies.push_back(pillar(0.8 * length, 0.3 * width, 0.15, height));
  return bodies;
}

/** A carrier that stays near the middle of a room. */
CarrierPath hoverAt(double x, double y, double z)
{
  CarrierPath path;
  path.channels[CarrierPath::kX].offset = x;
  path.channels[CarrierPath::kY].offset = y;
  path.channels[CarrierPath::kZ].offset = z;
  return path;
}
}  // namespace

Scene officeScene()
{
  Scene scene;
  Bodies& bodies = scene.world.bodies;
  bodies = officeBuilding();
  const std::vector<Vec3> way = officeWaypoints();
  const std::size_t walls = bodies.size();
  unsigned seed = 11;
  for (const double x : {0.0, 8.0, 16.0})
    for (const double y : {0.0, 7.2})
      appendFurniture(bodies, {x, y, x + 8, y + 4.8, 7, ++seed, way});
  for (std::size_t i = walls; i < bodies.size(); ++i)
    scene.movable.push_back({i, 1});
  Route route;
  route.corners = way;
  route.speed = 1.0;
  route.corner_cut = 0.8;
  scene.path = followRoute(route);
  addWalkingSway(scene.path, 1.8);
  return scene;
}

Scene shakeScene()
{
  Scene scene;
  scene.world.bodies = room(9, 7, 3, 9, 31);
  CarrierPath& path = scene.path = hoverAt(4.5, 3.5, 1.3);
  // Peak rates: yaw 9.9 rad/s, roll 6.6 rad/s, pitch 5.9 rad/s.
  addOscillation(path, CarrierPath::kYaw, 1.05, 1.5);
  addOscillation(path, CarrierPath::kRoll, 0.5, 2.1);
  addOscillation(path, CarrierPath::kPitch, 0.55, 1.7);
  addOscillation(path, CarrierPath::kX, 0.25, 0.9);
  addOscillation(path, CarrierPath::kY, 0.20, 1.1);
  addOscillation(path, CarrierPath::kZ, 0.15, 1.3);
  return scene;
}

Scene spinScene()
{
  Scene scene;
  scene.world.bodies = room(14, 11, 4, 14, 47);
  CarrierPath& path = scene.path = hoverAt(7, 5.5, 1.4);
  path.channels[CarrierPath::kYaw].slope = 19.5;  // 1117 deg/s
  addOscillation(path, CarrierPath::kPitch, 0.10, 0.7);
  addOscillation(path, CarrierPath::kRoll, 0.12, 0.5);
  addOscillation(path, CarrierPath::kX, 0.5, 0.11);
  addOscillation(path, CarrierPath::kY, 0.4, 0.17);
  addOscillation(path, CarrierPath::kZ, 0.1, 0.23);
  return scene;
}

Scene stairsScene()
{
  constexpr double kRise = 0.17, kGoing = 0.28, kFlight = 1.7;  // ten steps per flight
  constexpr int kFlights = 4, kSteps = 10;
  Scene scene;
  Bodies& bodies = scene.world.bodies;
  bodies = {shell({0, 0, 0}, {5.6, 3.0, kFlights * kFlight + 3.0})};
  std::vector<Vec3> up;
  for (int flight = 0; flight < kFlights; ++flight)
  {
    const bool there = flight % 2 == 0;
    const double y = there ? 0.75 : 2.25, base = flight * kFlight;
    const auto along = [there](double s) { return there ? 1.4 + s : 4.2 - s; };
    for (int step = 0; step < kSteps; ++step)
      bodies.push_back(box(
          {along((step + 0.5) * kGoing), y, kGoing, 1.4, 2 * kRise, base + (step - 1) * kRise, 0.0,
           0.5}));
    bodies.push_back(
        box({there ? 4.9 : 0.7, 1.5, 1.4, 3.0, 0.15, base + kFlight - 0.15, 0.0, 0.5}));
    up.insert(
        up.end(), {{along(0.0), y, base + kHand},
                   {along(2.8), y, base + kFlight + kHand},
                   {along(3.4), y, base + kFlight + kHand}});
  }
  bodies.push_back(box({2.8, 1.5, 2.2, 0.06, 0.9 + kFlights * kFlight, 0.0, 0.0, 0.6}));
  Route route;
  route.corners = up;
  route.corners.insert(route.corners.end(), up.rbegin(), up.rend());
  route.speed = 0.7;
  route.corner_cut = 0.5;
  scene.path = followRoute(route);
  addWalkingSway(scene.path, 1.7);
  return scene;
}

Scene tunnelScene()
{
  Scene scene;
  // Both ends are out of the sensor's reach.
  scene.world.bodies = {shell({-400, -2.6, 0}, {400, 2.6, 3.8})};
  Route route;
  route.corners = {{-15, -1, 1.2}, {15, -1, 1.2}, {17, 0, 1.2},
                   {15, 1, 1.2},   {-15, 1, 1.2}, {-17, 0, 1.2}};
  route.speed = 1.5;
  route.corner_cut = 1.5;
  scene.path = followRoute(route);
  addWalkingSway(scene.path, 1.8, 0.7);
  return scene;
}

}  // namespace fastlio
