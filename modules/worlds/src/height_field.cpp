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

using Two = Eigen::Array2d;  // x and y, or both triangles of a cell

/** The same for x and y within [0, high]. */
Span clip(Span span, const Two& origin, const Two& direction, const Two& high)
{
  const Two a = -origin / direction, b = (high - origin) / direction;
  const Two begin = a.min(b), end = a.max(b);
  for (Eigen::Index axis = 0; axis < 2; ++axis)
    span = direction[axis] != 0.0
               ? Span{std::max(span.begin, begin[axis]), std::min(span.end, end[axis])}
               : clip(span, origin[axis], 0.0, 0.0, high[axis]);
  return span;
}

/** Walks along one axis of the grid. */
struct AxisWalk
{
  int cell, step;
  double next, delta;  // ray parameter at the next cell border, and between borders

  /** Passes the next border, or stays. No branch: nobody can tell which axis is next. */
  void pass(bool is_next)
  {
    cell += is_next ? step : 0;
    next += is_next ? delta : 0.0;
  }
};

/** Both walks of a ray that enters the grid at the point \a entry of it. */
std::array<AxisWalk, 2> startWalks(
    const Two& origin, const Two& direction, const Two& entry, const HeightField::Extent& grid)
{
  const std::array<int, 2> cells{grid.cells_x, grid.cells_y};
  const Two place = entry / grid.cell, delta = grid.cell / direction.abs();
  std::array<AxisWalk, 2> walks;
  Two border;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const auto i = static_cast<Eigen::Index>(axis);
    const int cell = std::clamp(static_cast<int>(place[i]), 0, cells[axis] - 1);
    const int step = direction[i] > 0.0 ? 1 : -1;
    border[i] = grid.cell * (cell + (step > 0 ? 1 : 0));
    walks[axis] = {cell, step, kInfinity, delta[i]};
  }
  const Two next = (border - origin) / direction;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const auto i = static_cast<Eigen::Index>(axis);
    if (direction[i] != 0.0) walks[axis].next = next[i];
  }
  return walks;
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
  for (int j = 0; j < extent.cells_y; ++j)
    for (int i = 0; i < extent.cells_x; ++i)
      tops_.push_back(std::max(
          std::max(heights_[nodeIndex(i, j)], heights_[nodeIndex(i + 1, j)]),
          std::max(heights_[nodeIndex(i, j + 1)], heights_[nodeIndex(i + 1, j + 1)])));
  const auto [low, high] = std::minmax_element(heights_.begin(), heights_.end());
  lowest_ = static_cast<double>(*low) - kNearest;
  highest_ = static_cast<double>(*high) + kNearest;
  if (!std::all_of(heights_.begin(), heights_.end(), [](float h) { return std::isfinite(h); }))
    throw std::invalid_argument("HeightField: a height is not a finite number.");
}

std::size_t HeightField::nodeIndex(int i, int j) const
{
  return static_cast<std::size_t>(j) * static_cast<std::size_t>(extent_.cells_x + 1) +
         static_cast<std::size_t>(i);
}

double HeightField::node(int i, int j) const
{
  return static_cast<double>(heights_[nodeIndex(i, j)]);
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

double HeightField::top(int i, int j) const
{
  return static_cast<double>(
      tops_
          [static_cast<std::size_t>(j) * static_cast<std::size_t>(extent_.cells_x) +
           static_cast<std::size_t>(i)]);
}

std::optional<RayHit> HeightField::castCell(const Ray& ray, int i, int j, double max_range) const
{
  // In cell coordinates (a, b) in [0, 1]^2 each triangle is z = z0 + ga a + gb b.
  const double z00 = node(i, j), z11 = node(i + 1, j + 1);
  const double z10 = node(i + 1, j), z01 = node(i, j + 1);
  const double x0 = extent_.min_x + i * extent_.cell, y0 = extent_.min_y + j * extent_.cell;
  const Two ga(z10 - z00, z11 - z01), gb(z11 - z10, z01 - z00);
  const Two nx = -ga / extent_.cell, ny = -gb / extent_.cell;  // of the normals (nx, ny, 1)
  const Vec3 from_corner = ray.origin - Vec3(x0, y0, z00);
  const Two above = nx * from_corner.x() + ny * from_corner.y() + from_corner.z();
  const Two climb = nx * ray.direction.x() + ny * ray.direction.y() + ray.direction.z();
  const Two t = -above / climb;
  const Two a = (ray.origin.x() + t * ray.direction.x() - x0) / extent_.cell;
  const Two b = (ray.origin.y() + t * ray.direction.y() - y0) / extent_.cell;
  double range = max_range;
  Eigen::Index hit = -1;
  for (Eigen::Index triangle = 0; triangle < 2; ++triangle)
  {
    const double low = triangle == 0 ? b[triangle] : a[triangle];
    const double high = triangle == 0 ? a[triangle] : b[triangle];
    const bool inside = low >= -kSeam && low <= high + kSeam && high <= 1.0 + kSeam;
    if (!inside || !(t[triangle] > kNearest) || t[triangle] > range) continue;
    range = t[triangle];
    hit = triangle;
  }
  if (hit < 0) return std::nullopt;
  const double side = climb[hit] > 0.0 ? -1.0 : 1.0;
  return RayHit{range, side * Vec3(nx[hit], ny[hit], 1.0).normalized(), reflectivity_};
}

std::optional<RayHit> HeightField::cast(const Ray& ray, double max_range) const
{
  const auto& e = extent_;
  const Vec3 o = ray.origin - Vec3(e.min_x, e.min_y, 0.0);
  const Vec3& d = ray.direction;
  const Two origin(o.x(), o.y()), direction(d.x(), d.y());
  Span span = clip({0.0, max_range}, o.z(), d.z(), lowest_, highest_);
  if (span.begin > span.end) return std::nullopt;
  span = clip(span, origin, direction, {e.cell * e.cells_x, e.cell * e.cells_y});
  if (span.begin > span.end) return std::nullopt;
  auto [x, y] = startWalks(origin, direction, origin + span.begin * direction, e);
  double entered = span.begin;
  while (x.cell >= 0 && x.cell < e.cells_x && y.cell >= 0 && y.cell < e.cells_y)
  {
    const bool x_is_next = x.next < y.next;
    const double left = x_is_next ? x.next : y.next;
    // Most cells lie below all of the ray's way through them.
    const double lowest = o.z() + std::min(entered * d.z(), left * d.z());
    if (!(lowest > top(x.cell, y.cell) + kAbove))
      if (auto hit = castCell(ray, x.cell, y.cell, max_range)) return hit;
    if (left > span.end) return std::nullopt;
    entered = left;
    x.pass(x_is_next);
    y.pass(!x_is_next);
  }
  return std::nullopt;
}

}  // namespace fastlio
