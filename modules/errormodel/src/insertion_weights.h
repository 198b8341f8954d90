// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file insertion_weights.h Which scans created the planes in view. */
#pragma once

#include <fastlio/errormodel/map_error.h>
#include <fastlio/errormodel/twist.h>
#include <fastlio/matching/plane_groups.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** So many insertions are remembered; beyond it every second one is dropped, as what is remembered
 * changes slowly. */
inline constexpr std::size_t kMaxInsertions = 256;

template <typename Insertion>
void keepEverySecond(std::vector<Insertion>& insertions)
{
  for (std::size_t i = 0; 2 * i < insertions.size(); ++i)
    insertions[i] = insertions[2 * i];
  insertions.resize((insertions.size() + 1) / 2);
}

/** Index of the insertion with that number, or of the one that stands for it since it was dropped;
 * their number where it is not known. \param insertions ascending by scan */
template <typename Insertion>
std::size_t indexOfInsertion(const std::vector<Insertion>& insertions, std::uint32_t number)
{
  const auto next = std::upper_bound(
      insertions.begin(), insertions.end(), number,
      [](std::uint32_t scan, const Insertion& insertion) { return scan < insertion.scan; });
  return next == insertions.begin() ? insertions.size()
                                    : static_cast<std::size_t>(next - insertions.begin()) - 1;
}

/** Finds the insertion that created the planes of each group of points. \param insertions ascending
 * by scan; older ones may have been dropped \param found receives an index for each group, or the
 * number of insertions where it is not known */
template <typename Insertion>
void findInsertions(
    const std::vector<PlaneGroup>& groups, const std::vector<Insertion>& insertions,
    std::vector<std::size_t>& found)
{
  found.reserve(groups.capacity());  // for scans with more of them, too
  found.clear();
  std::uint32_t looked_up = 0;  // no insertion has that number
  std::size_t index = insertions.size();
  for (const PlaneGroup& group : groups)
  {
    // Neighbours in a scan mostly lie on planes of the same insertion.
    if (group.created_insertion != looked_up || found.empty())
    {
      looked_up = group.created_insertion;
      index = indexOfInsertion(insertions, looked_up);
    }
    found.push_back(index);
  }
}

/** Sets the weight of each insertion to the fraction of a scan's weight on the planes that it
 * created. \param found from findInsertions() \param weight_of weight of a group of points
 * \return false when no group has a weight: the insertions have none then */
template <typename Insertion, typename WeightOf>
bool weighInsertions(
    const std::vector<PlaneGroup>& groups, const std::vector<std::size_t>& found,
    std::vector<Insertion>& insertions, const WeightOf& weight_of)
{
  for (Insertion& insertion : insertions)
    insertion.weight = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    const double weight = weight_of(groups[i]);
    total += weight;
    if (found[i] < insertions.size()) insertions[found[i]].weight += weight;
  }
  if (!(total > 0.0)) return false;
  for (Insertion& insertion : insertions)
    insertion.weight /= total;
  return true;
}

/** Weight of a group by all that its points say. */
inline double weightOf(const PlaneGroup& group)
{
  return group.weight;
}

/** A direction of the scan pose, and what a twist of the map is along it. */
struct ShownDirection
{
  Vector6 along;  //!< in the scan pose's coordinates
  Vector6 moved;  //!< the twist of the map that moves the scan along it
  Vector6 seen;   //!< component of a twist along it: seen . moved = 1, 0 with the other directions'

  /** Weight of a group by what its points say about the direction. */
  [[nodiscard]] double operator()(const PlaneGroup& group) const
  {
    return std::pow(group.g.dot(along), 2) / group.weight;
  }
};

/** The directions of an update's constraints. */
inline std::array<ShownDirection, 6> shownDirections(const LinearizedUpdate& update)
{
  const ScanConstraints& constraints = update.constraints;
  const Matrix6 L = twistJacobian(update.T_world_scan);
  const Matrix6 L_inverse = twistJacobianInverse(update.T_world_scan);
  std::array<ShownDirection, 6> directions;
  for (int i = 0; i < 6; ++i)
  {
    Vector6 along = constraints.directions.col(i), measured = along;
    along.head<3>() /= constraints.lever_arm;
    measured.head<3>() *= constraints.lever_arm;
    directions[static_cast<std::size_t>(i)] = {along, L * along, L_inverse.transpose() * measured};
  }
  return directions;
}

}  // namespace fastlio
