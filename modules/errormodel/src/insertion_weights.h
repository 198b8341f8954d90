// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file insertion_weights.h Which scans created the planes in view. */
#pragma once

#include <fastlio/errormodel/map_error.h>
#include <fastlio/errormodel/twist.h>
#include <fastlio/matching/plane_groups.h>

#include <algorithm>
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

/** The directions of an update's constraints, and what a twist of the map is along them. */
struct ShownDirections
{
  using Square = Eigen::Matrix<double, 6, 6>;
  Square along;  //!< rows, in the scan pose's coordinates; zero where the update left one alone
  Square moved;  //!< columns: the twist of the map that moves the scan along a direction
  Square seen;   //!< rows: the component of a twist along a direction; seen * moved = I
};

inline ShownDirections shownDirections(const LinearizedUpdate& update)
{
  const ScanConstraints& constraints = update.constraints;
  ShownDirections::Square along = constraints.directions, measured = along;
  along.topRows<3>() /= constraints.lever_arm;
  measured.topRows<3>() *= constraints.lever_arm;
  ShownDirections directions;
  directions.moved = twistJacobian(update.T_world_scan) * along;
  directions.seen = measured.transpose() * twistJacobianInverse(update.T_world_scan);
  along.leftCols(constraints.unconstrained).setZero();
  directions.along = along.transpose();
  return directions;
}

/** Sets the weights of each insertion to the fractions of a scan's weight on the planes that it
 * created: of all that the points say, and of what they say about each direction. A direction that
 * no plane shows has the weights of all. \param insertions ascending by scan; older ones may have
 * been dropped */
template <typename Insertion>
void weighInsertions(
    const std::vector<PlaneGroup>& groups, const ShownDirections& directions,
    std::vector<Insertion>& insertions)
{
  for (Insertion& insertion : insertions)
    insertion.weights = {};
  InsertionWeights total;
  std::uint32_t looked_up = 0;  // no insertion has that number
  std::size_t index = insertions.size();
  for (const PlaneGroup& group : groups)
  {
    const Eigen::Matrix<double, 6, 1> shown =
        (directions.along * group.g).cwiseAbs2() / group.weight;
    total.all += group.weight;
    total.shown += shown;
    // Neighbours in a scan mostly lie on planes of the same insertion.
    if (group.created_insertion != looked_up)
    {
      looked_up = group.created_insertion;
      index = indexOfInsertion(insertions, looked_up);
    }
    if (index == insertions.size()) continue;
    insertions[index].weights.all += group.weight;
    insertions[index].weights.shown += shown;
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

/** Mean over the insertions, by their weights about each direction, of what is linear in a twist:
 * six rows. */
template <typename Insertion, typename Quantity>
Quantity meanByDirection(
    const ShownDirections& directions, const std::vector<Insertion>& insertions,
    Quantity Insertion::*quantity)
{
  using Scalar = typename Quantity::Scalar;
  using Square = Eigen::Matrix<Scalar, 6, 6>;
  using Rows = Eigen::Matrix<Scalar, 6, Quantity::ColsAtCompileTime>;
  const Square seen = directions.seen.cast<Scalar>(), moved = directions.moved.cast<Scalar>();
  Rows components = Rows::Zero();
  for (const Insertion& insertion : insertions)
    if (insertion.weights.all > 0.0)
      components += insertion.weights.shown.template cast<Scalar>().asDiagonal() *
                    (seen * insertion.*quantity);
  return moved * components;
}

}  // namespace fastlio
