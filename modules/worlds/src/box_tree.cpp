// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "traced_bundle.h"
#include <fastlio/worlds/box_tree.h>

#include <algorithm>

namespace fastlio
{
namespace
{
/** Bodies that lie side by side. */
struct Range
{
  std::size_t first, last;

  [[nodiscard]] std::size_t size() const { return last - first; }
};

Bounds boundsOf(const std::vector<Primitive>& bodies, const Range& range)
{
  Bounds all;
  for (std::size_t i = range.first; i < range.last; ++i)
    all.include(fastlio::boundsOf(bodies[i]));
  return all;
}

/** Both halves, on either side of the median along the axis on which the bodies differ most. */
std::array<Range, 2> halved(std::vector<Primitive>& bodies, const Range& range)
{
  const auto at = [&](std::size_t i) { return bodies.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t middle = range.first + range.size() / 2;
  if (range.size() > 2)
  {
    Bounds centers;
    for (std::size_t i = range.first; i < range.last; ++i)
    {
      const Vec3 center = fastlio::boundsOf(bodies[i]).center();
      centers.include({center, center});
    }
    int axis = 0;
    (centers.max - centers.min).maxCoeff(&axis);
    std::nth_element(
        at(range.first), at(middle), at(range.last),
        [axis](const Primitive& a, const Primitive& b)
        { return fastlio::boundsOf(a).center()[axis] < fastlio::boundsOf(b).center()[axis]; });
  }
  return {{{range.first, middle}, {middle, range.last}}};
}

/** At most \a count parts; the largest is halved next. */
std::vector<Range> partsOf(std::vector<Primitive>& bodies, const Range& range, std::size_t count)
{
  std::vector<Range> parts{range};
  while (parts.size() < count)
  {
    const auto largest = std::max_element(
        parts.begin(), parts.end(),
        [](const Range& a, const Range& b) { return a.size() < b.size(); });
    if (largest->size() < 2) break;
    const auto [left, right] = halved(bodies, *largest);
    *largest = left;
    parts.push_back(right);
  }
  return parts;
}
}  // namespace

BoxTree::BoxTree(std::vector<Primitive>& bodies)
{
  if (!bodies.empty()) build(bodies, 0, bodies.size());
}

std::uint32_t BoxTree::build(std::vector<Primitive>& bodies, std::size_t first, std::size_t last)
{
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  const std::vector<Range> parts = partsOf(bodies, {first, last}, FourBoxes::kCount);
  Node node;
  for (std::size_t slot = 0; slot < parts.size(); ++slot)
  {
    const auto [from, to] = parts[slot];
    node.boxes.set(slot, boundsOf(bodies, parts[slot]));
    node.is_body[slot] = to - from == 1;
    node.inside[slot] =
        node.is_body[slot] ? static_cast<std::uint32_t>(from) : build(bodies, from, to);
  }
  nodes_[index] = node;
  return static_cast<std::uint32_t>(index);
}

void BoxTree::cast(const std::vector<Primitive>& bodies, TracedBundle& rays) const
{
  if (nodes_.empty()) return;
  struct Visit
  {
    double enter;
    std::uint32_t number;
    bool is_body;
  };
  std::array<Visit, 64> stack;  // three more on each level: enough for any number of bodies
  std::size_t depth = 0;
  stack[depth++] = {0.0, 0, false};
  while (depth > 0)
  {
    const Visit at = stack[--depth];
    if (at.enter > rays.reach()) continue;
    if (at.is_body)
    {
      rays.meet(bodies[at.number], at.number);
      continue;
    }
    const Node& node = nodes_[at.number];
    const auto [enter, leave] = rays.through(node.boxes);
    const std::size_t below = depth;
    for (std::size_t slot = 0; slot < FourBoxes::kCount; ++slot)
    {
      const auto i = static_cast<Eigen::Index>(slot);
      if (!(enter[i] <= leave[i])) continue;
      // The nearest on top: what it stops need not be looked for in the others.
      std::size_t place = depth++;
      for (; place > below && stack[place - 1].enter < enter[i]; --place)
        stack[place] = stack[place - 1];
      stack[place] = {enter[i], node.inside[slot], node.is_body[slot]};
    }
  }
}

}  // namespace fastlio
