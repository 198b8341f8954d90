// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/own_body.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
/** Of a coordinate over the largest one, -1 to 1. */
int indexOf(float ratio)
{
  const int index = static_cast<int>((ratio + 1.0F) * (0.5F * DirectionCells::kPerEdge));
  return std::clamp(index, 0, DirectionCells::kPerEdge - 1);
}

std::size_t cellAt(int face, float u, float v)
{
  const int row = face * DirectionCells::kPerEdge + indexOf(u);
  const int cell = row * DirectionCells::kPerEdge + indexOf(v);
  return static_cast<std::size_t>(cell);
}
}  // namespace

std::size_t DirectionCells::of(float x, float y, float z)
{
  const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
  if (ax >= ay && ax >= az) return cellAt(x > 0.0F ? 0 : 1, y / ax, z / ax);
  if (ay >= az) return cellAt(y > 0.0F ? 2 : 3, x / ay, z / ay);
  return cellAt(z > 0.0F ? 4 : 5, x / az, y / az);
}

Vec3 DirectionCells::middle(std::size_t cell)
{
  constexpr auto edge = static_cast<std::size_t>(kPerEdge);
  const std::size_t face = cell / (edge * edge);
  const auto coordinate = [](std::size_t index)
  { return (2.0 * static_cast<double>(index) + 1.0) / kPerEdge - 1.0; };
  const double u = coordinate(cell / edge % edge), v = coordinate(cell % edge);
  const double side = face % 2 == 0 ? 1.0 : -1.0;
  const Vec3 corner = face < 2 ? Vec3(side, u, v) : face < 4 ? Vec3(u, side, v) : Vec3(u, v, side);
  return corner.normalized();
}

std::array<std::size_t, 9> DirectionCells::around(std::size_t cell)
{
  // By directions and not by indices: beyond the edge of a face lies another one.
  constexpr double kStep = 2.0 / kPerEdge;
  const Vec3 ahead = middle(cell);
  const Vec3 side = ahead.unitOrthogonal(), up = ahead.cross(side);
  // Cells are narrower towards the corners of a face.
  const double step = kStep * std::pow(ahead.cwiseAbs().maxCoeff(), 1.5);
  std::array<std::size_t, 9> cells{};
  std::size_t n = 0;
  for (const double a : {0.0, -step, step})
    for (const double b : {0.0, -step, step})
    {
      const Eigen::Vector3f d = (ahead + a * side + b * up).cast<float>();
      cells[n++] = of(d.x(), d.y(), d.z());
    }
  return cells;
}

}  // namespace fastlio
