// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_index.h"
#include <fastlio/map/incremental_points_map.h>

#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
/** What a stale index is replaced with in const queries. */
template <class Collector>
void searchEveryPoint(const CIncrementalPointsMap& map, const Point3& query, Collector& collector)
{
  const auto& x = map.getPointsBufferRef_x();
  const auto& y = map.getPointsBufferRef_y();
  const auto& z = map.getPointsBufferRef_z();
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    const float d = squaredDistance({x[i], y[i], z[i]}, query);
    if (d <= collector.bound())
    {
      collector.offer({x[i], y[i], z[i], d, static_cast<std::uint32_t>(i)});
    }
  }
}

/** Fills \a storage with the nearest points within \a max_distance; returns how many.
 *
 * Few points near the query make a wide search expensive, so an unlimited search starts small and
 * widens until it is satisfied: what is found within the radius is final. */
std::size_t searchNearest(
    const PointIndex& index, const Point3& query, Neighbor* storage, std::size_t k,
    double max_distance)
{
  constexpr double kFirstRadius = 4.0, kGrowth = 4.0;  // in cells, per round
  const double cell = index.grid().cellSize();
  for (double radius = kFirstRadius * cell;; radius *= kGrowth)
  {
    const bool last_round = radius >= max_distance || radius >= kCellLimit * cell;
    NearestCollector nearest(storage, k, squaredRadius(last_round ? max_distance : radius));
    index.search(query, nearest);
    if (nearest.full() || last_round) return nearest.count();
  }
}

/** Results in the three columns that MRPT's interface wants. */
void unpack(
    const std::vector<Neighbor>& neighbors, std::vector<mrpt::math::TPoint3Df>& points,
    std::vector<float>& distances_sqr, std::vector<std::uint64_t>& indices)
{
  points.clear();
  distances_sqr.clear();
  indices.clear();
  for (const Neighbor& n : neighbors)
  {
    points.emplace_back(n.x, n.y, n.z);
    distances_sqr.push_back(n.distance_sqr);
    indices.push_back(n.point_index);
  }
}
}  // namespace

NeighborSet CIncrementalPointsMap::nearest(
    float x, float y, float z, std::size_t k, double max_distance) const
{
  if (k > kMaxNeighbors)
  {
    throw std::invalid_argument(
        "CIncrementalPointsMap::nearest: at most " + std::to_string(kMaxNeighbors) +
        " neighbours can be asked for, not " + std::to_string(k) + "; use nn_multiple_search()");
  }
  NeighborSet set;
  const Point3 query{x, y, z};
  if (!isFinite(query) || !(max_distance >= 0.0)) return set;
  if (indexIsCurrent())
  {
    set.count = searchNearest(*index_, query, set.items.data(), k, max_distance);
    return set;
  }
  NearestCollector nearest(set.items.data(), k, squaredRadius(max_distance));
  searchEveryPoint(*this, query, nearest);
  set.count = nearest.count();
  return set;
}

bool CIncrementalPointsMap::nn_single_search(
    const mrpt::math::TPoint3Df& query, mrpt::math::TPoint3Df& result, float& out_dist_sqr,
    std::uint64_t& result_index) const
{
  const NeighborSet found = nearest(query.x, query.y, query.z, 1);
  if (found.empty()) return false;
  result = {found[0].x, found[0].y, found[0].z};
  out_dist_sqr = found[0].distance_sqr;
  result_index = found[0].point_index;
  return true;
}

void CIncrementalPointsMap::nn_multiple_search(
    const mrpt::math::TPoint3Df& query, const std::size_t count,
    std::vector<mrpt::math::TPoint3Df>& results, std::vector<float>& out_dists_sqr,
    std::vector<std::uint64_t>& result_indices) const
{
  const Point3 q{query.x, query.y, query.z};
  std::vector<Neighbor> found(fastlio::isFinite(q) ? std::min(count, size()) : 0);
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  if (indexIsCurrent())
  {
    found.resize(searchNearest(*index_, q, found.data(), found.size(), kUnlimited));
  }
  else
  {
    NearestCollector nearest(found.data(), found.size(), squaredRadius(kUnlimited));
    searchEveryPoint(*this, q, nearest);
    found.resize(nearest.count());
  }
  unpack(found, results, out_dists_sqr, result_indices);
}

void CIncrementalPointsMap::nn_radius_search(
    const mrpt::math::TPoint3Df& query, const float search_radius_sqr,
    std::vector<mrpt::math::TPoint3Df>& results, std::vector<float>& out_dists_sqr,
    std::vector<std::uint64_t>& result_indices, std::size_t max_points) const
{
  const Point3 q{query.x, query.y, query.z};
  RadiusCollector within(
      fastlio::isFinite(q) ? std::min(search_radius_sqr, std::numeric_limits<float>::max())
                           : -1.0F);
  if (indexIsCurrent())
    index_->search(q, within);
  else
    searchEveryPoint(*this, q, within);
  std::vector<Neighbor> found = std::move(within).sorted();
  if (max_points != 0 && found.size() > max_points) found.resize(max_points);
  unpack(found, results, out_dists_sqr, result_indices);
}

#if !FASTLIO_MRPT_HAS_NN_INTERFACE
void CIncrementalPointsMap::nn_prepare_for_2d_queries() const
{
  const_cast<CIncrementalPointsMap*>(this)->kdTreeEnsureIndexBuilt2D();
}

bool CIncrementalPointsMap::nn_single_search(
    const mrpt::math::TPoint2Df& query, mrpt::math::TPoint2Df& result, float& out_dist_sqr,
    std::uint64_t& result_index) const
{
  if (size() == 0) return false;
  result_index = kdTreeClosestPoint2D(query.x, query.y, result.x, result.y, out_dist_sqr);
  return true;
}

void CIncrementalPointsMap::nn_multiple_search(
    const mrpt::math::TPoint2Df& query, const std::size_t count,
    std::vector<mrpt::math::TPoint2Df>& results, std::vector<float>& out_dists_sqr,
    std::vector<std::uint64_t>& result_indices) const
{
  std::vector<std::size_t> indices;
  out_dists_sqr.clear();
  // The kd-tree leaves garbage in the surplus places when asked for more points than there are.
  const std::size_t n = std::min(count, size());
  if (n != 0) kdTreeNClosestPoint2DIdx(query.x, query.y, n, indices, out_dists_sqr);
  results.clear();
  for (const std::size_t i : indices)
    results.emplace_back(m_x[i], m_y[i]);
  result_indices.assign(indices.begin(), indices.end());
}

void CIncrementalPointsMap::nn_radius_search(
    const mrpt::math::TPoint2Df& query, const float search_radius_sqr,
    std::vector<mrpt::math::TPoint2Df>& results, std::vector<float>& out_dists_sqr,
    std::vector<std::uint64_t>& result_indices, std::size_t max_points) const
{
  std::vector<nanoflann::ResultItem<std::size_t, float>> found;
  kdTreeRadiusSearch2D(query.x, query.y, search_radius_sqr, found);
  if (max_points != 0 && found.size() > max_points) found.resize(max_points);
  results.clear();
  out_dists_sqr.clear();
  result_indices.clear();
  for (const auto& [index, distance_sqr] : found)
  {
    results.emplace_back(m_x[index], m_y[index]);
    out_dists_sqr.push_back(distance_sqr);
    result_indices.push_back(index);
  }
}
#endif

}  // namespace fastlio
