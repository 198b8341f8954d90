// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "town_parts.h"
#include <fastlio/math/angles.h>

#include <cmath>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kPeriod = 17.5;  // of the facades along x [m]
constexpr int kPeriods = 15;      // the ends are out of reach from the middle
constexpr double kCross = 150.0;  // x of the side streets, east and west
constexpr double kBack = 64.0;    // y of the street behind
constexpr double kRiderHeight = 1.6;

/** A road whose roughness repeats with the facades. */
double levelRoad(double x, double y)
{
  return 0.005 * std::sin(3.0 * kTwoPi / kPeriod * x + 1.7 * y);
}

/** One period: the same houses, tree, lamp and parked cars every time. */
void appendPeriod(Scene& scene, double x)
{
  constexpr double kDepth = 10.0, kHouses = StreetWidths::kHouses + 0.5 * kDepth;
  Bodies& bodies = scene.world.bodies;
  Draws north(3), south(8);
  appendHouse(bodies, {x, kHouses, kPi, 0.6 * kPeriod, kDepth, 10.5, 0.0}, north);
  appendHouse(
      bodies, {x + 0.5 * kPeriod, kHouses + 1.0, kPi, 0.4 * kPeriod, kDepth, 8.0, 0.0}, north);
  appendHouse(bodies, {x, -kHouses, 0.0, 0.5 * kPeriod, kDepth, 9.0, 0.0}, south);
  appendHouse(
      bodies, {x + 0.5 * kPeriod, -kHouses - 0.7, 0.0, 0.5 * kPeriod, kDepth, 12.0, 0.0}, south);
  appendTree(bodies, x + 3.0, StreetWidths::kTrees, -0.1, 6.0);
  bodies.push_back(pillar(x - 4.0, -StreetWidths::kTrees, 0.1, 6.0, -0.1, 0.6));
  for (const auto& [along, away] : {std::pair{1.5, 1.0}, std::pair{-5.0, -1.0}})
  {
    const std::size_t before = bodies.size();
    appendCar(bodies, x + along, away * StreetWidths::kParked, 0.0, 0.0);
    noteMovable(scene, before);
  }
}

void appendOtherStreets(Scene& scene)
{
  unsigned seed = 100;
  const auto street = [&](const Vec3& from, const Vec3& to) {
    appendStreet(scene, {from, to, seed += 2}, levelRoad);
  };
  street({-kCross, kBack, 0}, {kCross, kBack, 0});
  for (const double side : {-1.0, 1.0})
  {
    street({side * kCross, 0, 0}, {side * kCross, kBack, 0});
    street({side * (kCross + 58), -50, 0}, {side * (kCross + 58), 50, 0});
    street({side * kCross - 30, -36, 0}, {side * kCross + 40, -36, 0});
    street({side * kCross - 35, kBack + 32, 0}, {side * kCross + 35, kBack + 32, 0});
  }
}

/** East, back west after a turn, around by the street behind, west again and back after a turn. */
Route thereAndBack()
{
  constexpr double kLane = 1.8, kTurn = 8.0;
  Route route;
  route.corners = {
      {-100, -kLane, 0},
      {kCross, -kLane, 0},
      {kCross + 10, -kTurn, 0},
      {kCross + 22, -kTurn, 0},
      {kCross + 28, 0, 0},
      {kCross + 22, kTurn, 0},
      {kCross + 10, kTurn, 0},
      {kCross, kLane, 0},
      {-kCross + kLane, kLane + 0.2, 0},
      {-kCross + kLane, kBack - kLane, 0},
      {kCross - kLane, kBack - kLane, 0},
      {kCross - kLane, kLane - 0.3, 0},
      {-kCross, kLane - 0.3, 0},
      {-kCross - 10, kTurn, 0},
      {-kCross - 22, kTurn, 0},
      {-kCross - 28, 0, 0},
      {-kCross - 22, -kTurn, 0},
      {-kCross - 10, -kTurn, 0},
      {-kCross, -kLane, 0}};
  for (Vec3& corner : route.corners)
    corner.z() = kRiderHeight;
  route.speed = 7.5;
  route.acceleration = 2.0;
  route.corner_cut = 10.0;
  route.ground = levelRoad;
  return route;
}
}  // namespace

Scene facadesScene()
{
  Scene scene;
  constexpr int kMiddle = (kPeriods - 1) / 2;
  for (int i = 0; i < kPeriods; ++i)
    appendPeriod(scene, kPeriod * (i - kMiddle));
  appendOtherStreets(scene);
  constexpr double kHalfX = kCross + 130.0, kSouthEdge = -120.0, kCell = 2.5;
  scene.world.ground = HeightField(
      {-kHalfX, kSouthEdge, kCell, static_cast<int>(2.0 * kHalfX / kCell), 130}, levelRoad, 0.25);
  scene.blend = 8.0;
  scene.path = followRoute(thereAndBack());
  addOscillation(scene.path, CarrierPath::kZ, 0.015, 1.5);
  addOscillation(scene.path, CarrierPath::kPitch, 0.010, 1.3);
  addOscillation(scene.path, CarrierPath::kRoll, 0.014, 0.9);
  addOscillation(scene.path, CarrierPath::kYaw, 0.008, 0.35);
  return scene;
}

}  // namespace fastlio
