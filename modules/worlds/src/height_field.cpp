// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/worlds/height_field.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNearest = 1e-6;
constexpr double kAbove = 1e-3;  // rays that pass higher above a cell cannot hit it [m]
constexpr double kSeam = 1e-9;   // triangles overlap by this fraction, so that no ray slips through

struct Span
{
  double begin, end;
};

/** Part of the span in which origin + t direction is within [low, high]. */
Span clip(const Span& span, double origin, double direction, double low, double high)
{
  const double a = (low - origin) / direction;
  const double b = (high - origin) / direction;
  if (direction == 0.0) return origin >= low && origin <= high ? span : Span{kInfinity, -kInfinity};
  return {std::max(span.begin, std::min(a, b)), std::min(span.end, std::max(a, b))};
}

/** Walks along one axis of the grid. */
struct AxisWalk
{
  int cell, step;
  double next, delta;  // ray parameter at the next cell border, and between borders
};

AxisWalk startWalk(double origin, double direction, double at, double cell, int cells)
{
  const int index = std::clamp(static_cast<int>(std::floor(at / cell)), 0, cells - 1);
  if (direction == 0.0) return {index, 0, kInfinity, kInfinity};
  const int step = direction > 0.0 ? 1 : -1;
  const double border = cell * (index + (step > 0 ? 1 : 0));
  return {index, step, (border - origin) / direction, cell / std::abs(direction)};
}
}  // namespace

HeightField::HeightField(
    const Extent& extent, const std::function<double(double x, double y)>& height,
    double reflectivity)
    : extent_(extent), reflectivity_(reflectivity)
{
  if (extent.cells_x < 1 || extent.cells_y < 1 || !(extent.cell > 0.0))
    throw std::invalid_argument(
        "HeightField: " + std::to_string(extent.cells_x) + " x " + std::to_string(extent.cells_y) +
        " cells of " + std::to_string(extent.cell) + " m; all must be positive.");
  for (int j = 0; j <= extent.cells_y; ++j)
    for (int i = 0; i <= extent.cells_x; ++i)
      heights_.push_back(static_cast<float>(
          height(extent.min_x + i * extent.cell, extent.min_y + j * extent.cell)));
  const auto [low, high] = std::minmax_element(heights_.begin(), heights_.end());
  lowest_ = static_cast<double>(*low) - kNearest;
  highest_ = static_cast<double>(*high) + kNearest;
  if (!std::all_of(heights_.begin(), heights_.end(), [](float h) { return std::isfinite(h); }))
    throw std::invalid_argument("HeightField: a height is not a finite number.");
}

double HeightField::node(int i, int j) const
{
  return static_cast<double>(
      heights_
          [static_cast<std::size_t>(j) * static_cast<std::size_t>(extent_.cells_x + 1) +
           static_cast<std::size_t>(i)]);
}

double HeightField::height(double x, double y) const
{
  const double u =
      std::clamp((x - extent_.min_x) / extent_.cell, 0.0, static_cast<double>(extent_.cells_x));
  const double v =
      std::clamp((y - extent_.min_y) / extent_.cell, 0.0, static_cast<double>(extent_.cells_y));
  const int i = std::min(static_cast<int>(u), extent_.cells_x - 1);
  const int j = std::min(static_cast<int>(v), extent_.cells_y - 1);
  const double a = u - i, b = v - j;
  const double middle = a > b ? node(i + 1, j) : node(i, j + 1);
  return a > b ? node(i, j) + a * (middle - node(i, j)) + b * (node(i + 1, j + 1) - middle)
               : node(i, j) + b * (middle - node(i, j)) + a * (node(i + 1, j + 1) - middle);
}

double HeightField::highestNode(int i, int j) const
{
  return std::max({node(i, j), node(i + 1, j), node(i, j + 1), node(i + 1, j + 1)});
}

std::optional<RayHit> HeightField::castCell(const Ray& ray, int i, int j, double max_range) const
{
  // In cell coordinates (a, b) in [0, 1]^2 each triangle is z = z0 + ga a + gb b.
  const double z00 = node(i, j), z11 = node(i + 1, j + 1);
  const double z10 = node(i + 1, j), z01 = node(i, j + 1);
  const double x0 = extent_.min_x + i * extent_.cell, y0 = extent_.min_y + j * extent_.cell;
  const std::array<std::array<double, 2>, 2> slopes{
      {{z10 - z00, z11 - z10}, {z11 - z01, z01 - z00}}};
  std::optional<RayHit> best;
  for (std::size_t triangle = 0; triangle < 2; ++triangle)
  {
    const auto [ga, gb] = slopes[triangle];
    const Vec3 n(-ga / extent_.cell, -gb / extent_.cell, 1.0);
    const double t = -n.dot(ray.origin - Vec3(x0, y0, z00)) / n.dot(ray.direction);
    const double a = (ray.origin.x() + t * ray.direction.x() - x0) / extent_.cell;
    const double b = (ray.origin.y() + t * ray.direction.y() - y0) / extent_.cell;
    const double low = triangle == 0 ? b : a;
    const double high = triangle == 0 ? a : b;
    const bool inside = low >= -kSeam && low <= high + kSeam && high <= 1.0 + kSeam;
    if (!inside || !(t > kNearest) || t > (best ? best->range : max_range)) continue;
    const double side = n.dot(ray.direction) > 0.0 ? -1.0 : 1.0;
    best = RayHit{t, side * n.normalized(), reflectivity_};
  }
  return best;
}

std::optional<RayHit> HeightField::cast(const Ray& ray, double max_range) const
{
  const auto& e = extent_;
  const Vec3 o = ray.origin - Vec3(e.min_x, e.min_y, 0.0);
  const Vec3& d = ray.direction;
  Span span{0.0, max_range};
  span = clip(span, o.z(), d.z(), lowest_, highest_);
  span = clip(span, o.x(), d.x(), 0.0, e.cell * e.cells_x);
  span = clip(span, o.y(), d.y(), 0.0, e.cell * e.cells_y);
  if (span.begin > span.end) return std::nullopt;
  const Vec3 entry = o + span.begin * d;
  AxisWalk x = startWalk(o.x(), d.x(), entry.x(), e.cell, e.cells_x);
  AxisWalk y = startWalk(o.y(), d.y(), entry.y(), e.cell, e.cells_y);
  double entered = span.begin;
  while (x.cell >= 0 && x.cell < e.cells_x && y.cell >= 0 && y.cell < e.cells_y)
  {
    AxisWalk& nearer = x.next < y.next ? x : y;
    // Most cells lie below all of the ray's way through them.
    const double lowest = o.z() + std::min(entered * d.z(), nearer.next * d.z());
    if (!(lowest > highestNode(x.cell, y.cell) + kAbove))
      if (auto hit = castCell(ray, x.cell, y.cell, max_range)) return hit;
    if (nearer.next > span.end) return std::nullopt;
    entered = nearer.next;
    nearer.cell += nearer.step;
    nearer.next += nearer.delta;
  }
  return std::nullopt;
}

}  // namespace fastlio
