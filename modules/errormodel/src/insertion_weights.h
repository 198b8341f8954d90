// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file insertion_weights.h Which scans created the planes in view. */
#pragma once

#include <fastlio/errormodel/considered_errors.h>
#include <fastlio/matching/plane_groups.h>

#include <Eigen/LU>

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

/** Sets the weights of each insertion to what the points on its planes say: W_i = sum of g g^T / w
 * over its planes, which takes a plane's points as one. A direction that no plane shows like this,
 * a turn about the only one, counts as all that the points say.
 * \param insertions ascending by scan; older ones may have been dropped
 * \return (sum of W_i)^-1: the error of the scan pose by the map is the mean of those of the
 * insertions with these weights */
template <typename Insertion>
Matrix6 weighInsertions(const GroupedMeasurements& scan, std::vector<Insertion>& insertions)
{
  using Square = Eigen::Matrix<double, 6, 6>;
  // The part of such a direction's weight, against those that the planes show.
  constexpr double kNotShown = 1e-3;
  constexpr double kFloor = 1e-12;  // keeps the sum regular where nothing shows a direction at all
  for (Insertion& insertion : insertions)
    if (insertion.weights.all > 0.0) insertion.weights = {};  // few of them: most are out of sight
  InsertionWeights of_unknown;
  double all = 0.0;
  std::uint32_t looked_up = 0;  // no scan's insertion: a given map has it, without errors
  InsertionWeights* weights = &of_unknown;
  for (const PlaneGroup& group : scan.groups)
  {
    // Neighbours in a scan mostly lie on planes of the same insertion.
    if (group.created_insertion != looked_up)
    {
      looked_up = group.created_insertion;
      const std::size_t index = indexOfInsertion(insertions, looked_up);
      weights = index == insertions.size() ? &of_unknown : &insertions[index].weights;
    }
    all += group.weight;
    weights->all += group.weight;
    weights->shown += (1.0 / group.weight) * group.g * group.g.transpose();
  }
  Square sum = of_unknown.shown + kNotShown * scan.information;
  for (Insertion& insertion : insertions)
  {
    InsertionWeights& of = insertion.weights;
    if (of.all == 0.0) continue;
    of.all /= all;
    sum += of.shown;
    of.shown += kNotShown * of.all * scan.information;
  }
  sum.diagonal().array() += kFloor * sum.trace();
  return sum.inverse();
}

}  // namespace fastlio
