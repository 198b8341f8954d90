// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "town_parts.h"

#include <fastlio/math/angles.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
constexpr double kGroundFloor = 3.4, kFloor = 2.9;  // heights [m]
constexpr double kBuried = 2.5;                     // houses reach below the ground of slopes

/** A box on the front of a house. */
struct FrontPart
{
  double along;  // middle, from the middle of the front
  double width;
  double bottom, height;  // from the street
  double depth;           // how far it stands out
};

class HouseBuilder
{
 public:
  HouseBuilder(Bodies& bodies, const House& house, Draws& draw)
      : bodies_(&bodies), house_(house), draw_(&draw)
  {
  }

  void build()
  {
    Draws& draw = *draw_;
    const House& h = house_;
    const double shade = draw(0.3, 0.7);
    bodies_->push_back(
        box({h.x, h.y, h.width, h.depth, h.height + kBuried, h.base - kBuried, h.yaw, shade}));
    part({0.0, h.width + 0.3, h.height - 0.35, 0.35, draw(0.2, 0.5)});
    if (draw.chance(0.5)) part({0.0, h.width, -kBuried, kBuried + draw(0.5, 1.0), 0.1});
    if (draw.chance(0.7)) addPorch();
    if (draw.chance(0.4)) addGable();
    switch (draw.below(4))
    {
      case 0:
        return addBays();
      case 1:
        return addBalconies();
      case 2:
        return addPilasters();
      default:
        return addFrames();
    }
  }

 private:
  void part(const FrontPart& p)
  {
    const double c = std::cos(house_.yaw), s = std::sin(house_.yaw), away = 0.5 * house_.depth;
    const double x = house_.x + c * p.along - s * away, y = house_.y + s * p.along + c * away;
    bodies_->push_back(
        box({x, y, p.width, 2.0 * p.depth, p.height, house_.base + p.bottom, house_.yaw, 0.5}));
  }

  [[nodiscard]] double column(int i, int count) const
  {
    return house_.width * ((i + 0.5) / count - 0.5);
  }

  void addPorch()
  {
    Draws& draw = *draw_;
    const double reach = std::max(0.5 * house_.width - 1.5, 0.0);
    part({draw(-reach, reach), draw(1.4, 2.6), -0.5, draw(2.9, 3.6), draw(0.4, 0.9)});
  }

  void addGable()
  {
    Draws& draw = *draw_;
    const House& h = house_;
    bodies_->push_back(box(
        {h.x, h.y, draw(0.3, 0.8) * h.width, draw(0.4, 0.9) * h.depth, draw(1.0, 2.6),
         h.base + h.height, h.yaw, 0.5}));
  }

  void addBays()
  {
    Draws& draw = *draw_;
    const int count = 1 + draw.below(std::max(1, static_cast<int>(house_.width / 4.0)));
    const double width = draw(1.4, 2.4), depth = draw(0.3, 0.9), bottom = draw(0.0, 3.0);
    for (int i = 0; i < count; ++i)
      part({column(i, count), width, bottom, draw(0.6, 0.9) * house_.height - bottom, depth});
  }

  void addBalconies()
  {
    Draws& draw = *draw_;
    const int count = std::max(1, static_cast<int>(house_.width / draw(3.5, 5.0)));
    const double width = draw(2.0, 3.0), depth = draw(0.7, 1.2);
    for (double z = kGroundFloor; z + kFloor < house_.height; z += kFloor)
      for (int i = 0; i < count; ++i)
        if (draw.chance(0.75)) part({column(i, count), width, z, 1.1, depth});
  }

  void addPilasters()
  {
    Draws& draw = *draw_;
    const int count = 3 + draw.below(4);
    const double width = draw(0.3, 0.6), depth = draw(0.15, 0.35);
    for (int i = 0; i < count; ++i)
      part({column(i, count), width, -1.0, house_.height + 0.6, depth});
  }

  void addFrames()
  {
    Draws& draw = *draw_;
    const int count = std::max(2, static_cast<int>(house_.width / draw(2.4, 3.6)));
    const double width = draw(1.0, 1.6), height = draw(1.3, 2.0), depth = draw(0.12, 0.3);
    for (double z = 1.0; z + height < house_.height; z += kFloor)
      for (int i = 0; i < count; ++i)
        part({column(i, count) + draw(-0.2, 0.2), width, z, height, depth});
  }

  Bodies* bodies_;
  House house_;
  Draws* draw_;
};

/** One side of a street: places along it and away from its middle. */
class StreetSide
{
 public:
  StreetSide(const Street& street, double side, const GroundHeight& ground)
      : from_(street.from), side_(side), ground_(&ground)
  {
    const Vec3 way = street.to - street.from;
    length_ = std::hypot(way.x(), way.y());
    ahead_ = Vec3(way.x(), way.y(), 0.0) / length_;
  }

  [[nodiscard]] double begin() const { return StreetWidths::kCrossing; }
  [[nodiscard]] double end() const { return length_ - StreetWidths::kCrossing; }

  /** On the ground. */
  [[nodiscard]] Vec3 at(double along, double away) const
  {
    const Vec3 outwards = side_ * Vec3(-ahead_.y(), ahead_.x(), 0.0);
    Vec3 p = from_ + along * ahead_ + away * outwards;
    p.z() = (*ground_)(p.x(), p.y());
    return p;
  }

  [[nodiscard]] double yaw() const { return std::atan2(ahead_.y(), ahead_.x()); }
  /** Of a house that faces the street. */
  [[nodiscard]] double houseYaw() const { return side_ > 0.0 ? yaw() + kPi : yaw(); }

 private:
  Vec3 from_, ahead_;
  double side_, length_ = 0.0;
  const GroundHeight* ground_;
};

void appendHouses(Bodies& bodies, const StreetSide& side, Draws& draw)
{
  constexpr double kNarrowest = 6.0;
  for (double along = side.begin(); side.end() - along > kNarrowest;)
  {
    const double width = std::min(draw(8.0, 16.0), side.end() - along);
    const double depth = draw(8.0, 12.0), setback = draw(0.0, 1.6);
    const Vec3 front = side.at(along + 0.5 * width, StreetWidths::kHouses);
    const Vec3 middle = side.at(along + 0.5 * width, StreetWidths::kHouses + setback + 0.5 * depth);
    appendHouse(
        bodies, {middle.x(), middle.y(), side.houseYaw(), width, depth, draw(5.5, 15.0), front.z()},
        draw);
    along += width + (draw.chance(0.25) ? draw(2.0, 7.0) : 0.0);
  }
}

void appendParkedCars(Scene& scene, const StreetSide& side, Draws& draw)
{
  constexpr double kSlot = 6.2, kTaken = 0.45;
  for (double along = side.begin() + 3.0; along < side.end() - 3.0; along += kSlot)
  {
    const bool taken = draw.chance(kTaken);
    const double shift = draw(-0.4, 0.4), out = draw(-0.1, 0.2);
    const Vec3 at = side.at(along + shift, StreetWidths::kParked + out);
    const double yaw = side.yaw() + draw(-0.04, 0.04);
    Bodies car;
    appendCar(car, at.x(), at.y(), at.z(), yaw);
    if (!taken)
    {
      scene.spare.push_back(car);
      continue;
    }
    const std::size_t before = scene.world.bodies.size();
    scene.world.bodies.insert(scene.world.bodies.end(), car.begin(), car.end());
    noteMovable(scene, before);
  }
}

void appendTreesAndPoles(Scene& scene, const StreetSide& side, Draws& draw)
{
  Bodies& bodies = scene.world.bodies;
  for (double along = side.begin() + draw(0.0, 6.0); along < side.end(); along += draw(7.0, 12.0))
  {
    const Vec3 at = side.at(along, StreetWidths::kTrees);
    const double kind = draw(0.0, 1.0);
    if (kind < 0.3)
      appendTree(bodies, at.x(), at.y(), at.z() - 0.1, draw(5.0, 8.0));
    else if (kind < 0.55)
    {
      const double radius = draw(0.06, 0.14), height = draw(3.0, 7.0);
      bodies.push_back(pillar(at.x(), at.y(), radius, height, at.z() - 0.1, 0.6));
    }
    else if (kind < 0.75)
    {
      bodies.push_back(box(
          {at.x(), at.y(), draw(0.6, 1.4), draw(0.5, 0.8), draw(0.9, 1.5), at.z() - 0.05,
           side.yaw() + draw(-0.1, 0.1), 0.4}));
      noteMovable(scene, bodies.size() - 1);
    }
  }
}
}  // namespace

void appendHouse(Bodies& bodies, const House& house, Draws& draw)
{
  HouseBuilder(bodies, house, draw).build();
}

void appendStreet(Scene& scene, const Street& street, const GroundHeight& ground)
{
  for (const double side : {-1.0, 1.0})
  {
    Draws draw(street.seed + (side > 0.0 ? 1U : 0U));
    const StreetSide place(street, side, ground);
    appendHouses(scene.world.bodies, place, draw);
    appendParkedCars(scene, place, draw);
    appendTreesAndPoles(scene, place, draw);
  }
}

}  // namespace fastlio
