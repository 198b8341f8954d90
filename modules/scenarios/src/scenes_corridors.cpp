// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/scenarios/scenes.h>
#include <fastlio/worlds/world_parts.h>

#include <array>
#include <cmath>

namespace fastlio
{
namespace
{
// Corridors along x at these y, from x = 0 to kLong, between two lobbies along y.
constexpr std::array<double, 3> kCorridors{0.0, 8.0, 16.0};
constexpr double kLong = 30.0, kHalfWidth = 1.2, kLobby = 2.4;
constexpr double kStorey = 3.2, kClear = 2.8;  // floor to floor, floor to ceiling
constexpr double kThick = 0.3;                 // walls; doors are set back in them
constexpr double kStairsWide = 2.5;
constexpr double kSouth = kCorridors[0] - kHalfWidth, kNorth = kCorridors[2] + kHalfWidth;

Bodies raised(Bodies bodies, double by)
{
  for (Primitive& body : bodies)
    body.T_world_local.p.z() += by;
  return bodies;
}

/** Turned by half a turn about the middle of the building. */
Bodies turned(Bodies bodies)
{
  const Pose about_middle{expSO3({0.0, 0.0, kPi}), {kLong, kCorridors[0] + kCorridors[2], 0.0}};
  for (Primitive& body : bodies)
    body.T_world_local = about_middle * body.T_world_local;
  return bodies;
}

/** One wall of a corridor, with closed doors every 5 m. \param side +1 or -1 */
void appendCorridorWall(Bodies& bodies, double middle, double side)
{
  constexpr double kSpacing = 5.0, kLeaf = 0.06;
  const double at = middle + side * (kHalfWidth + 0.5 * kThick);
  std::vector<Door> doors;
  for (double x = 0.5 * kSpacing; x < kLong; x += kSpacing)
  {
    doors.push_back({x, 1.0});
    bodies.push_back(box({x, at + side * 0.5 * kThick, 1.0, kLeaf, 2.1, 0.0, 0.0, 0.5}));
  }
  appendWall(bodies, {true, 0.0, kLong, at, kClear, kThick}, doors);
}

/** The western lobby. \param stairs where its door to the staircase is */
void appendLobby(Bodies& bodies, double stairs)
{
  appendWall(
      bodies, {false, kSouth, kNorth, -kLobby - 0.5 * kThick, kStorey, kThick}, {{stairs, 1.4}});
  for (const double end : {kSouth - 0.5 * kThick, kNorth + 0.5 * kThick})
    appendWall(bodies, {true, -kLobby - kThick, 0.0, end, kStorey, kThick});
  for (std::size_t i = 0; i + 1 < kCorridors.size(); ++i)
    appendWall(
        bodies, {false, kCorridors[i] + kHalfWidth, kCorridors[i + 1] - kHalfWidth, 0.5 * kThick,
                 kClear, kThick});
}

/** A storey without furniture. \param stairs where the western lobby's door to the stairs is */
Bodies storey(double stairs)
{
  Bodies bodies;
  for (const double y : kCorridors)
    for (const double side : {-1.0, 1.0})
      appendCorridorWall(bodies, y, side);
  Bodies lobby;
  appendLobby(lobby, stairs);
  bodies.insert(bodies.end(), lobby.begin(), lobby.end());
  const Bodies opposite = turned(lobby);
  bodies.insert(bodies.end(), opposite.begin(), opposite.end());
  for (const auto& [z, reflectivity] : {std::pair{0.0, 0.3}, std::pair{kClear, 0.7}})
    bodies.push_back(slab(-kLobby, kSouth, kLong + kLobby, kNorth, z, reflectivity));
  return bodies;
}

constexpr int kSteps = 16;
constexpr double kGoing = 0.33, kFirstStep = 6.8;  // of the western stairs; they rise towards -y
constexpr double kLastStep = kFirstStep - kSteps * kGoing;

/** Stairs west of the western lobby: from its door at y = 8 up to the door at y = 0 above. */
Bodies westernStairs()
{
  constexpr double kEast = -kLobby - kThick, kWest = kEast - kStairsWide, kEnd = 9.6;
  constexpr double kMiddle = 0.5 * (kEast + kWest), kTop = kStorey + kClear;
  Bodies bodies{
      slab(kWest, kSouth, kEast, kEnd, 0.0), slab(kWest, kSouth, kEast, kEnd, kTop, 0.7),
      box({kMiddle, 0.5 * (kSouth + kLastStep), kStairsWide, kLastStep - kSouth, kStorey})};
  appendWall(bodies, {false, kSouth - kThick, kEnd + kThick, kWest - 0.5 * kThick, kTop, kThick});
  for (const double end : {kSouth - 0.5 * kThick, kEnd + 0.5 * kThick})
    appendWall(bodies, {true, kWest, kEast, end, kTop, kThick});
  for (int i = 0; i < kSteps; ++i)
    bodies.push_back(box(
        {kMiddle, kFirstStep - (i + 0.5) * kGoing, kStairsWide, kGoing, (i + 1) * kStorey / kSteps,
         0.0, 0.0, 0.5}));
  return bodies;
}

/** The differences: some cabinets, benches and pillars. z is the storey. */
Bodies fewDifferences()
{
  Bodies bodies;
  const auto against = [&](double x, double y, double side, int level, double length, double height)
  {
    constexpr double kDepth = 0.36;
    bodies.push_back(box(
        {x, y + side * (kHalfWidth - 0.5 * kDepth), length, kDepth, height, level * kStorey, 0.0,
         0.5}));
  };
  against(10.0, kCorridors[0], 1.0, 0, 1.0, 1.9);
  against(20.4, kCorridors[0], -1.0, 0, 1.6, 0.5);
  against(15.0, kCorridors[2], 1.0, 0, 0.8, 1.2);
  against(4.9, kCorridors[1], -1.0, 1, 1.2, 1.9);
  against(25.2, kCorridors[2], 1.0, 1, 1.8, 0.5);
  bodies.push_back(pillar(-kLobby + 0.3, 12.0, 0.25, 1.1, 0.0));
  bodies.push_back(pillar(kLong + kLobby - 0.3, 3.5, 0.25, 1.1, kStorey));
  bodies.push_back(box({-0.4, 4.0, 0.4, 1.6, 0.5, kStorey, 0.0, 0.5}));
  return bodies;
}

/** Through all corridors of the ground floor, up in the east, through all of the upper floor, down
 * in the west. */
std::vector<Vec3> walkThroughAll()
{
  constexpr double kHeld = 1.3, kUpper = kStorey + kHeld;  // height of the sensor
  constexpr double kWest = -0.5 * kLobby, kEast = kLong + 0.5 * kLobby;
  constexpr double kDown = -kLobby - kThick - 0.5 * kStairsWide, kUp = kLong - kDown;
  constexpr double kSum = kCorridors[0] + kCorridors[2];
  constexpr double kA = kCorridors[0], kB = kCorridors[1], kC = kCorridors[2];
  return {
      {kWest, 4.0, kHeld},
      {kWest, kA, kHeld},
      {kEast, kA, kHeld},
      {kEast, kC, kHeld},
      {kWest, kC, kHeld},
      {kWest, kB, kHeld},
      {kEast, kB, kHeld},
      {kUp, kB, kHeld},
      {kUp, kSum - kFirstStep, kHeld},
      {kUp, kSum - kLastStep, kUpper},
      {kUp, kC, kUpper},
      {kEast, kC, kUpper},
      {kWest, kC, kUpper},
      {kWest, kB, kUpper},
      {kEast, kB, kUpper},
      {kEast, kA, kUpper},
      {kWest, kA, kUpper},
      {kDown, kA, kUpper},
      {kDown, kLastStep, kUpper},
      {kDown, kFirstStep, kHeld},
      {kDown, kB, kHeld},
      {kWest, kB, kHeld}};
}
}  // namespace

Scene corridorsScene()
{
  Scene scene;
  Bodies& bodies = scene.world.bodies;
  const Bodies stairs = westernStairs();
  for (const Bodies& part :
       {storey(kCorridors[1]), raised(storey(kCorridors[0]), kStorey), stairs, turned(stairs)})
    bodies.insert(bodies.end(), part.begin(), part.end());
  for (const Primitive& thing : fewDifferences())
  {
    bodies.push_back(thing);
    noteMovable(scene, bodies.size() - 1);
  }
  Route route;
  route.corners = walkThroughAll();
  route.speed = 1.2;
  route.corner_cut = 0.8;
  scene.path = followRoute(route);
  addWalkingSway(scene.path, 1.8);
  return scene;
}

}  // namespace fastlio
