// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "town_parts.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kSensorHeight = 1.6, kTownLane = 1.8;  // [m]

/** A crossing: column and row of the plan. */
using Crossing = std::pair<int, int>;

/** Hills with slopes of up to 6 % and a rough road. */
double townGround(double x, double y)
{
  return 1.9 * std::sin(0.0231 * x + 0.4) + 1.5 * std::sin(0.0262 * y - 0.006 * x) +
         0.006 * std::sin(1.3 * x + 1.7 * y);
}

unsigned mixed(int a, int b, int c)
{
  unsigned hash = 2166136261U;
  for (const int v : {a, b, c})
    hash = (hash ^ static_cast<unsigned>(v)) * 16777619U;
  return hash ^ (hash >> 15U);
}

/** Streets along the lines of a grid that is nowhere square. */
struct TownPlan
{
  int columns, rows;  // of blocks
  double block;       // mean distance of crossings [m]

  [[nodiscard]] Vec3 middleOf(const Crossing& c) const
  {
    Draws draw(mixed(c.first, c.second, 7));
    const double dx = draw(-4.5, 4.5), dy = draw(-4.5, 4.5);
    return {block * c.first + dx, block * c.second + dy, 0.0};
  }
};

void goTo(std::vector<Crossing>& tour, int column, int row)
{
  Crossing at = tour.back();
  while (at != Crossing{column, row})
  {
    at.first += std::clamp(column - at.first, -1, 1);
    at.second += std::clamp(row - at.second, -1, 1);
    tour.push_back(at);
  }
}

/** Crossings on the way, the first of them again at the end: around the town, then along streets
 * that are known from both directions and two that are new. */
std::vector<Crossing> tourOf(const TownPlan& plan)
{
  const int last = plan.columns, top = plan.rows;
  std::vector<Crossing> tour{{0, 0}};
  for (const Crossing& c : std::vector<Crossing>{
           {last, 0},
           {last, top},
           {0, top},
           {0, 0},  // around
           {last - 1, 0},
           {last - 1, top},
           {last, top},  // last street: the other direction
           {last, 0},
           {1, 0},
           {1, top},
           {0, top},
           {0, 0}})  // known streets but one
    goTo(tour, c.first, c.second);
  return tour;
}

/** The plan whose tour has about the given length with blocks of a usual size. */
TownPlan planFor(double length)
{
  constexpr double kUsualBlock = 55.0;
  TownPlan best{2, 1, 0.0};
  for (int columns = 2; columns < 1000; ++columns)
  {
    TownPlan plan{columns, columns - 1, 0.0};
    plan.block = length / static_cast<double>(tourOf(plan).size() - 1);
    if (std::abs(plan.block - kUsualBlock) < std::abs(best.block - kUsualBlock)) best = plan;
    if (plan.block < kUsualBlock) break;
  }
  return best;
}

/** Where the right lane turns from one street into the next. */
Vec3 laneCorner(const Vec3& before, const Vec3& at, const Vec3& after, double lane)
{
  const Vec3 in = (at - before).normalized(), out = (after - at).normalized();
  const Vec3 right_in(in.y(), -in.x(), 0.0), right_out(out.y(), -out.x(), 0.0);
  return at + lane * (right_in + right_out) / (1.0 + right_in.dot(right_out));
}

Route routeThrough(const TownPlan& plan)
{
  std::vector<Crossing> tour = tourOf(plan);
  tour.pop_back();
  const std::size_t n = tour.size();
  Route route;
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vec3 before = plan.middleOf(tour[(i + n - 1) % n]), at = plan.middleOf(tour[i]);
    const Vec3 after = plan.middleOf(tour[(i + 1) % n]);
    // Nobody drives in the same track twice.
    const double lane = kTownLane + 0.35 * std::sin(1.7 * static_cast<double>(i));
    route.corners.push_back(laneCorner(before, at, after, lane));
    route.corners.back().z() = kSensorHeight;
  }
  // Starts between two crossings.
  route.corners.insert(route.corners.begin(), 0.5 * (route.corners[0] + route.corners[1]));
  std::rotate(route.corners.begin() + 1, route.corners.begin() + 2, route.corners.end());
  route.speed = 7.5;
  route.acceleration = 2.0;
  route.corner_cut = 12.0;
  route.ground = townGround;
  return route;
}

/** Streets that the sensor can see from the way. */
std::set<std::pair<Crossing, Crossing>> streetsNear(const TownPlan& plan)
{
  std::set<std::pair<Crossing, Crossing>> streets;
  const auto add = [&](const Crossing& a, const Crossing& b)
  {
    if (std::min(a.first, a.second) >= 0 && b.first <= plan.columns && b.second <= plan.rows)
      streets.insert({a, b});
  };
  for (const auto& [x, y] : tourOf(plan))
    for (int i = x - 1; i <= x + 1; ++i)
      for (int j = y - 1; j <= y + 1; ++j)
      {
        add({i, j}, {i + 1, j});
        add({i, j}, {i, j + 1});
      }
  return streets;
}

HeightField townField(const TownPlan& plan)
{
  constexpr double kMargin = 110.0, kCell = 2.5;
  const auto cells = [&](int blocks)
  { return static_cast<int>(std::ceil((plan.block * blocks + 2.0 * kMargin) / kCell)); };
  return {{-kMargin, -kMargin, kCell, cells(plan.columns), cells(plan.rows)}, townGround, 0.25};
}
}  // namespace

Scene townScene(const WorldSettings& settings)
{
  Scene scene;
  TownPlan plan = planFor(settings.length);
  for (int i = 0; i < 3; ++i)
    plan.block *= settings.length / loopLength(followRoute(routeThrough(plan)));
  for (const auto& [a, b] : streetsNear(plan))
  {
    const int along = a.second == b.second ? 0 : 2;
    appendStreet(
        scene, {plan.middleOf(a), plan.middleOf(b), mixed(a.first, a.second, along)}, townGround);
  }
  scene.world.ground = townField(plan);
  scene.blend = 8.0;
  scene.path = followRoute(routeThrough(plan));
  addGroundTilt(scene.path, townGround);
  addOscillation(scene.path, CarrierPath::kZ, 0.015, 1.5);
  addOscillation(scene.path, CarrierPath::kPitch, 0.010, 1.3);
  addOscillation(scene.path, CarrierPath::kRoll, 0.014, 0.9);
  addOscillation(scene.path, CarrierPath::kYaw, 0.008, 0.35);
  return scene;
}

}  // namespace fastlio
