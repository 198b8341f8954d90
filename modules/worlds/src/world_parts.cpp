// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/worlds/world_parts.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
Mat3 yawRotation(double yaw)
{
  return expSO3({0.0, 0.0, yaw});
}

/** Centre of a part given in the frame of a box. */
Vec3 inBox(const BoxOnGround& b, double x, double y)
{
  return Vec3(b.x, b.y, b.base) + yawRotation(b.yaw) * Vec3(x, y, 0.0);
}

/** Bays along one front of a building: side = +1 or -1, along its x or y axis. */
void appendBays(Bodies& bodies, const BoxOnGround& block, bool along_x, double side)
{
  constexpr double kPitch = 4.0, kBay = 1.6, kDepth = 0.35;
  const double front = along_x ? block.length : block.width;
  const double away = 0.5 * (along_x ? block.width : block.length) * side;
  const int count = std::max(1, static_cast<int>(front / kPitch));
  for (int i = 0; i < count; ++i)
  {
    const double along = front * ((i + 0.5) / count - 0.5);
    const Vec3 at = along_x ? inBox(block, along, away) : inBox(block, away, along);
    bodies.push_back(box(
        {at.x(), at.y(), along_x ? kBay : 2 * kDepth, along_x ? 2 * kDepth : kBay,
         0.55 * block.height, block.base + 0.25 * block.height, block.yaw, 0.6}));
  }
}
}  // namespace

Primitive box(const BoxOnGround& b)
{
  return {
      Primitive::Shape::Box,
      {yawRotation(b.yaw), {b.x, b.y, b.base + 0.5 * b.height}},
      {0.5 * b.length, 0.5 * b.width, 0.5 * b.height},
      b.reflectivity};
}

Primitive pillar(double x, double y, double radius, double height, double base, double reflectivity)
{
  return {
      Primitive::Shape::Cylinder,
      {Mat3::Identity(), {x, y, base + 0.5 * height}},
      {radius, radius, 0.5 * height},
      reflectivity};
}

Primitive ball(const Vec3& center, double radius, double reflectivity)
{
  return {
      Primitive::Shape::Sphere, {Mat3::Identity(), center}, Vec3::Constant(radius), reflectivity};
}

Primitive slab(
    double min_x, double min_y, double max_x, double max_y, double z, double reflectivity)
{
  return {
      Primitive::Shape::Rectangle,
      {Mat3::Identity(), {0.5 * (min_x + max_x), 0.5 * (min_y + max_y), z}},
      {0.5 * (max_x - min_x), 0.5 * (max_y - min_y), 0.0},
      reflectivity};
}

Primitive shell(const Vec3& min, const Vec3& max, double reflectivity)
{
  return {
      Primitive::Shape::Box,
      {Mat3::Identity(), 0.5 * (min + max)},
      0.5 * (max - min),
      reflectivity};
}

void appendWall(Bodies& bodies, const WallSpec& wall, const std::vector<Door>& doors)
{
  const auto piece = [&](double begin, double end, double base, double height)
  {
    const double middle = 0.5 * (begin + end), length = end - begin;
    if (length <= 0.0 || height <= 0.0) return;
    bodies.push_back(
        wall.along_x ? box({middle, wall.at, length, wall.thickness, height, base, 0.0, 0.6})
                     : box({wall.at, middle, wall.thickness, length, height, base, 0.0, 0.6}));
  };
  double begin = wall.begin;
  for (const Door& door : doors)
  {
    const double left = door.at - 0.5 * door.width, right = door.at + 0.5 * door.width;
    piece(begin, left, 0.0, wall.height);
    piece(left, right, door.height, wall.height - door.height);
    begin = right;
  }
  piece(begin, wall.end, 0.0, wall.height);
}

void appendTree(Bodies& bodies, double x, double y, double base, double height)
{
  bodies.push_back(pillar(x, y, 0.025 * height + 0.05, 0.6 * height, base, 0.3));
  const Vec3 top(x, y, base + 0.72 * height);
  bodies.push_back(ball(top, 0.28 * height, 0.25));
  bodies.push_back(ball(top + Vec3(0.2, 0.12, -0.08) * height, 0.17 * height, 0.25));
  bodies.push_back(ball(top + Vec3(-0.15, -0.2, -0.1) * height, 0.19 * height, 0.25));
}

void appendBuilding(Bodies& bodies, const BoxOnGround& block)
{
  bodies.push_back(box(block));
  for (const double side : {-1.0, 1.0})
  {
    appendBays(bodies, block, true, side);
    appendBays(bodies, block, false, side);
  }
  bodies.push_back(box(
      {block.x, block.y, block.length + 0.8, block.width + 0.8, 0.4,
       block.base + block.height - 0.2, block.yaw, 0.5}));
}

void appendCar(Bodies& bodies, double x, double y, double base, double yaw)
{
  const BoxOnGround lower{x, y, 4.4, 1.8, 0.7, base + 0.25, yaw, 0.5};
  bodies.push_back(box(lower));
  const Vec3 cabin = inBox(lower, -0.3, 0.0);
  bodies.push_back(box({cabin.x(), cabin.y(), 2.2, 1.6, 0.55, base + 0.95, yaw, 0.3}));
}

void appendFurniture(Bodies& bodies, const FurnitureArea& area)
{
  Draws draw(area.seed);
  for (int made = 0, tried = 0; made < area.pieces && tried < 50 * area.pieces; ++tried)
  {
    const double x = draw(area.min_x + 0.5, area.max_x - 0.5);
    const double y = draw(area.min_y + 0.5, area.max_y - 0.5);
    const double length = draw(0.5, 1.4), width = draw(0.3, 0.7);
    const double height = draw(0.5, 1.9), yaw = draw(-0.3, 0.3);
    const bool blocks = std::any_of(
        area.keep_free.begin(), area.keep_free.end(),
        [&](const Vec3& p) { return std::hypot(p.x() - x, p.y() - y) < 0.9 + 0.5 * length; });
    if (blocks) continue;
    bodies.push_back(box({x, y, length, width, height, 0.0, yaw, draw(0.2, 0.8)}));
    ++made;
  }
}

}  // namespace fastlio
