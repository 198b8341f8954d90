// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/messages/transform_tree.h>

#include <array>

namespace fastlio
{
namespace
{
constexpr std::size_t kLongestChain = 100;  // loops end here
constexpr std::array<const char*, 3> kVehicleFrames{"base_link", "base_footprint", "base"};

bool isSame(const Pose& a, const Pose& b)
{
  return (a.R - b.R).norm() < 1e-9 && (a.p - b.p).norm() < 1e-9;
}
}  // namespace

void TransformTree::add(const RosTransform& transform, bool fixed)
{
  if (edges_.size() >= kMostFrames && edges_.count(transform.child) == 0) return;
  Edge& edge = edges_[transform.child];
  const bool differs = edge.seen > 0 && (edge.parent != transform.parent ||
                                         !isSame(edge.T_parent_child, transform.T_parent_child));
  if (!fixed && edge.fixed) return;
  if (!fixed && differs) edge.moved = true;
  edge.parent = transform.parent;
  edge.T_parent_child = transform.T_parent_child;
  edge.fixed = fixed;
  ++edge.seen;
}

const TransformTree::Edge* TransformTree::edgeOf(const std::string& child) const
{
  constexpr std::size_t kRepetitions = 3;  // before a transform of tf counts as fixed
  const auto found = edges_.find(child);
  if (found == edges_.end()) return nullptr;
  const Edge& edge = found->second;
  return edge.fixed || (!edge.moved && edge.seen >= kRepetitions) ? &edge : nullptr;
}

TransformTree::Top TransformTree::climb(const std::string& frame, const std::string& until) const
{
  Top top{frame, Pose{}};
  for (std::size_t i = 0; i < kLongestChain && top.frame != until; ++i)
  {
    const Edge* edge = edgeOf(top.frame);
    if (edge == nullptr) break;
    top = {edge->parent, edge->T_parent_child * top.T_top_frame};
  }
  return top;
}

std::optional<std::string> TransformTree::vehicleFrameOf(
    const std::vector<std::string>& frames) const
{
  for (const char* vehicle : kVehicleFrames)
    for (const std::string& frame : frames)
      if (climb(frame, vehicle).frame == vehicle) return vehicle;
  for (const std::string& frame : frames)
    if (auto top = topOf(frame)) return top;
  return std::nullopt;
}

std::optional<std::string> TransformTree::topOf(const std::string& frame) const
{
  const Top top = climb(frame, "");
  if (top.frame == frame)
  {
    // A parent of others is the top of its own tree.
    for (const auto& [child, edge] : edges_)
      if (edge.parent == frame && edgeOf(child) != nullptr) return frame;
    return std::nullopt;
  }
  return top.frame;
}

bool TransformTree::isFixedToVehicle(const std::string& frame) const
{
  std::string at = frame;
  for (std::size_t i = 0; i < kLongestChain && at != kVehicleFrames[0]; ++i)
  {
    const auto found = edges_.find(at);
    if (found == edges_.end() || !found->second.fixed) return false;
    at = found->second.parent;
  }
  return at == kVehicleFrames[0];
}

std::optional<Pose> TransformTree::poseOf(
    const std::string& frame, const std::string& vehicle) const
{
  const Top top = climb(frame, vehicle);
  if (top.frame == vehicle) return top.T_top_frame;
  // The vehicle's frame may stand below the top of the tree: base_footprint above base_link.
  const Top of_vehicle = climb(vehicle, top.frame);
  if (of_vehicle.frame != top.frame) return std::nullopt;
  return of_vehicle.T_top_frame.inverse() * top.T_top_frame;
}

}  // namespace fastlio
