// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "leaves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fastlio
{
namespace
{
/** Boxes whose centres lie in one slice of space. */
struct Slice
{
  Bounds box;
  std::size_t count = 0;

  void include(const Slice& other) { box.include(other.box), count += other.count; }

  /** Time for all of it, in the mean over rays: a box is met as often as its surface is large. */
  [[nodiscard]] double cost() const
  {
    const Vec3 edge = box.max - box.min;
    const double surface = edge.x() * edge.y() + edge.y() * edge.z() + edge.z() * edge.x();
    return count == 0 ? 0.0 : surface * static_cast<double>(count);
  }
};

constexpr std::size_t kSlices = 32;

/** A plane across an axis, between two slices of it. */
struct Cut
{
  double cost = std::numeric_limits<double>::infinity();
  Eigen::Index axis = 0;
  std::size_t slice = 0;  // the first one behind the plane
};

/** Which slice a centre lies in. */
std::size_t sliceOf(const Vec3& center, const Bounds& centers, Eigen::Index axis)
{
  const double length = centers.max[axis] - centers.min[axis];
  const double place = (center[axis] - centers.min[axis]) / length * kSlices;
  return std::min(static_cast<std::size_t>(place), kSlices - 1);
}

Cut bestCut(const std::array<Slice, kSlices>& slices, Eigen::Index axis)
{
  std::array<double, kSlices> cost_behind{};
  Slice behind, before;
  for (std::size_t i = kSlices; i-- > 0;)
  {
    behind.include(slices[i]);
    cost_behind[i] = behind.cost();
  }
  Cut best;
  for (std::size_t i = 1; i < kSlices; ++i)
  {
    before.include(slices[i - 1]);
    const double cost = before.cost() + cost_behind[i];
    if (before.count > 0 && before.count < behind.count && cost < best.cost) best = {cost, axis, i};
  }
  return best;
}

/** The best of all planes across an axis. */
Cut bestCut(const Leaves& leaves, const Bounds& centers, Eigen::Index axis)
{
  std::array<Slice, kSlices> slices;
  for (auto leaf = leaves.first; leaf != leaves.last; ++leaf)
    slices[sliceOf(leaf->box.center(), centers, axis)].include({leaf->box, 1});
  return bestCut(slices, axis);
}

/** Both parts on either side of the best plane. */
std::array<Leaves, 2> cut(const Leaves& leaves)
{
  const auto [first, last] = leaves;
  Bounds centers;
  for (auto leaf = first; leaf != last; ++leaf)
    centers.include({leaf->box.center(), leaf->box.center()});
  Cut best;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    if (!(centers.max[axis] > centers.min[axis])) continue;
    const Cut other = bestCut(leaves, centers, axis);
    if (other.cost < best.cost) best = other;
  }
  auto middle = first + (last - first) / 2;  // where all centres are the same
  if (std::isfinite(best.cost))
    middle = std::partition(
        first, last,
        [&](const Leaf& leaf)
        { return sliceOf(leaf.box.center(), centers, best.axis) < best.slice; });
  return {{{first, middle}, {middle, last}}};
}

/** Time that could be saved by cutting. */
double costOf(const Leaves& leaves)
{
  return leaves.size() < 2 ? 0.0 : Slice{leaves.box(), leaves.size()}.cost();
}
}  // namespace

Bounds Leaves::box() const
{
  Bounds all;
  for (auto leaf = first; leaf != last; ++leaf)
    all.include(leaf->box);
  return all;
}

std::vector<Leaves> Leaves::parts(std::size_t count) const
{
  std::vector<Leaves> parts{*this};
  while (parts.size() < count)
  {
    const auto largest = std::max_element(
        parts.begin(), parts.end(),
        [](const Leaves& a, const Leaves& b) { return costOf(a) < costOf(b); });
    if (largest->size() < 2) break;
    const auto [left, right] = cut(*largest);
    *largest = left;
    parts.push_back(right);
  }
  return parts;
}

std::vector<Leaves> Leaves::equalParts(std::size_t count) const
{
  std::vector<Leaves> parts;
  auto begin = first;
  for (std::size_t left = std::min(count, size()); left > 0; --left)
  {
    const auto rest = static_cast<std::size_t>(last - begin);
    const auto end = begin + static_cast<std::ptrdiff_t>((rest + left - 1) / left);
    parts.push_back({begin, end});
    begin = end;
  }
  return parts;
}

}  // namespace fastlio
