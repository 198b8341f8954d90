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

/** A direction of the scan pose, and what a twist of the map is along it. */
struct ShownDirection
{
  Vector6 along;  //!< in the scan pose's coordinates; zero when the update left it alone
  Vector6 moved;  //!< the twist of the map that moves the scan along it
  Vector6 seen;   //!< component of a twist along it: seen . moved = 1, 0 with the other directions'
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
    if (i < constraints.unconstrained) directions[static_cast<std::size_t>(i)].along.setZero();
  }
  return directions;
}

/** Sets the weights of each insertion to the fractions of a scan's weight on the planes that it
 * created: of all that the points say, and of what they say about each direction. A direction that
 * no plane shows has the weights of all. \param found from findInsertions() */
template <typename Insertion>
void weighInsertions(
    const std::vector<PlaneGroup>& groups, const std::vector<std::size_t>& found,
    const std::array<ShownDirection, 6>& directions, std::vector<Insertion>& insertions)
{
  for (Insertion& insertion : insertions)
    insertion.weights = {};
  Eigen::Matrix<double, 6, 6> along;
  for (int i = 0; i < 6; ++i)
    along.row(i) = directions[static_cast<std::size_t>(i)].along;
  InsertionWeights total;
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    const PlaneGroup& group = groups[i];
    const Eigen::Matrix<double, 6, 1> shown = (along * group.g).cwiseAbs2() / group.weight;
    total.all += group.weight;
    total.shown += shown;
    if (found[i] >= insertions.size()) continue;
    insertions[found[i]].weights.all += group.weight;
    insertions[found[i]].weights.shown += shown;
  }
  if (!(total.all > 0.0)) return;
  for (Insertion& insertion : insertions)
  {
    InsertionWeights& weights = insertion.weights;
    if (weights.all == 0.0) continue;  // most of them: long out of sight
    weights.all /= total.all;
    for (int i = 0; i < 6; ++i)
      weights.shown[i] = total.shown[i] > 0.0 ? weights.shown[i] / total.shown[i] : weights.all;
  }
}

}  // namespace fastlio
