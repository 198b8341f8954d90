// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file insertion_weights.h Which scans created the planes in view. */
#pragma once

#include <fastlio/matching/plane_groups.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
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

/** Sets the weight of each insertion to the fraction of a scan's weight on the planes that it
 * created. \param insertions ascending by scan; older ones may have been dropped
 * \param weight_of weight of a group of points */
template <typename Insertion, typename WeightOf>
void weighInsertions(
    const std::vector<PlaneGroup>& groups, std::vector<Insertion>& insertions,
    const WeightOf& weight_of)
{
  for (Insertion& insertion : insertions)
    insertion.weight = 0.0;
  double total = 0.0;
  auto next = insertions.begin();
  std::uint32_t looked_up = 0;  // no insertion has that number
  for (const PlaneGroup& group : groups)
  {
    const double weight = weight_of(group);
    total += weight;
    // Neighbours in a scan mostly lie on planes of the same insertion.
    if (group.created_insertion != looked_up)
    {
      looked_up = group.created_insertion;
      next = std::upper_bound(
          insertions.begin(), insertions.end(), looked_up,
          [](std::uint32_t scan, const Insertion& insertion) { return scan < insertion.scan; });
    }
    if (next != insertions.begin()) std::prev(next)->weight += weight;
  }
  if (!(total > 0.0)) return;
  for (Insertion& insertion : insertions)
    insertion.weight /= total;
}

/** By all that the points say. */
template <typename Insertion>
void weighInsertions(const std::vector<PlaneGroup>& groups, std::vector<Insertion>& insertions)
{
  weighInsertions(groups, insertions, [](const PlaneGroup& group) { return group.weight; });
}

}  // namespace fastlio
