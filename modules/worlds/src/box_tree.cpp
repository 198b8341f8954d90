// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "leaves.h"
#include "traced_bundle.h"
#include <fastlio/worlds/box_tree.h>

namespace fastlio
{
namespace
{
constexpr std::size_t kFreeLevels = 16;    // that are cut wherever little time is lost
constexpr std::size_t kHalvedLevels = 16;  // below: enough for 4^16 bodies
constexpr std::size_t kMostVisits = 3 * (kFreeLevels + kHalvedLevels) + 1;  // three more a level
}  // namespace

BoxTree::BoxTree(const std::vector<Primitive>& bodies)
{
  std::vector<Leaf> leaves;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    leaves.push_back({boundsOf(bodies[i]), static_cast<std::uint32_t>(i)});
  if (!leaves.empty()) build({leaves.begin(), leaves.end()}, 0);
}

std::uint32_t BoxTree::build(const Leaves& leaves, std::size_t level)
{
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  const std::vector<Leaves> parts =
      level < kFreeLevels ? leaves.parts(FourBoxes::kCount) : leaves.equalParts(FourBoxes::kCount);
  Node node;
  for (std::size_t slot = 0; slot < parts.size(); ++slot)
  {
    const Leaves& part = parts[slot];
    node.boxes.set(slot, part.box());
    node.is_body[slot] = part.size() == 1;
    node.inside[slot] = node.is_body[slot] ? part.first->body : build(part, level + 1);
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
  std::array<Visit, kMostVisits> stack;
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
