// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file point_forest.h Exact nearest neighbours in a points map that grows: nanoflann's k-d trees
 * by the logarithmic method (Bentley and Saxe, 1980). */
#pragma once

#include <fastlio/pointmap/incremental_points_map.h>

#include <nanoflann.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

namespace fastlio
{
/** The nearest points that a search has met so far, in the caller's storage. */
class NearestPoints
{
 public:
  /** \param enough_sqr when all are nearer than this, the search may end [m^2] */
  NearestPoints(
      Neighbor* storage, std::size_t capacity, double max_distance, float enough_sqr = 0.0F)
      : items_(storage),
        capacity_(capacity),
        // Squares that overflow are beyond any limit.
        bound_(static_cast<float>(
            std::min<double>(max_distance * max_distance, std::numeric_limits<float>::max()))),
        enough_sqr_(enough_sqr)
  {
  }

  /** Squared distance up to which points still matter [m^2]. */
  [[nodiscard]] float bound() const { return bound_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] bool full() const { return count_ == capacity_; }
  [[nodiscard]] bool areEnough() const { return full() && bound_ < enough_sqr_; }

  void offer(float distance_sqr, std::uint32_t point)
  {
    const Neighbor candidate{0.0F, 0.0F, 0.0F, distance_sqr, point};
    // False for a distance that is not a number, too.
    if (!(distance_sqr <= bound_) || (full() && !isNearer(candidate, items_[0]))) return;
    if (full()) std::pop_heap(items_, items_ + count_--, isNearer);
    items_[count_++] = candidate;
    std::push_heap(items_, items_ + count_, isNearer);
    if (full()) bound_ = items_[0].distance_sqr;
  }

  /** Sorts the points, ascending by distance, equal distances by index. */
  void sort() { std::sort_heap(items_, items_ + count_, isNearer); }

 private:
  static bool isNearer(const Neighbor& a, const Neighbor& b)
  {
    return a.distance_sqr < b.distance_sqr ||
           (a.distance_sqr == b.distance_sqr && a.point_index < b.point_index);
  }

  Neighbor* items_;  // a heap, the farthest first
  std::size_t capacity_;
  std::size_t count_ = 0;
  float bound_;
  float enough_sqr_;
};

/** Trees over consecutive ranges of a map's points. The newest points, fewer than make a tree, are
 * searched one by one; when there are enough, they and the smaller trees before them become one. A
 * point is therefore indexed anew about log2(n / kFewPoints) times, and as many trees are searched.
 * The map calls clear() after any change but growth. */
class PointForest
{
 public:
  /** \param map outlives this */
  explicit PointForest(const mrpt::maps::CPointsMap& map) : map_(map) {}

  void clear() { trees_.clear(); }

  /** Takes notice of points that were appended to the map. */
  void grow()
  {
    std::size_t first = indexed();
    if (map_.size() - first < kFewPoints || !isIndexable(first)) return;
    while (!trees_.empty() && trees_.back()->range.count <= map_.size() - first)
    {
      first = trees_.back()->range.first;
      trees_.pop_back();
    }
    trees_.push_back(std::make_unique<Tree>(Range{map_, first, map_.size() - first}));
  }

  /** Offers every point that can be among the nearest. Allocates nothing. */
  void search(const float (&query)[3], NearestPoints& nearest) const
  {
    for (const auto& tree : trees_)
    {
      if (nearest.areEnough()) return;
      TreeResults results{nearest, static_cast<std::uint32_t>(tree->range.first)};
      tree->index.findNeighbors(results, query, {});
    }
    searchOneByOne(query, indexed(), nearest);
  }

  /** The same for all points from \a first on, without an index. */
  void searchOneByOne(const float (&query)[3], std::size_t first, NearestPoints& nearest) const
  {
    const Range all{map_, 0, map_.size()};
    const Metric metric(all);
    for (auto i = static_cast<std::uint32_t>(first); i < all.count; ++i)
      nearest.offer(metric.evalMetric(query, i, 3), i);
  }

 private:
  static constexpr std::size_t kFewPoints = 64;

  /** A data set of nanoflann. */
  struct Range
  {
    const mrpt::maps::CPointsMap& map;
    std::size_t first, count;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return count; }
    [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t dimension) const
    {
      return map.kdtree_get_pt(first + i, static_cast<int>(dimension));
    }
    template <class Box>
    bool kdtree_get_bbox(Box& /*box*/) const
    {
      return false;
    }
  };
  using Metric = nanoflann::L2_Simple_Adaptor<float, Range>;

  struct Tree
  {
    explicit Tree(const Range& points) : range(points), index(3, range) {}
    Range range;
    nanoflann::KDTreeSingleIndexAdaptor<Metric, Range, 3> index;
  };

  /** A result set of nanoflann. */
  struct TreeResults
  {
    using DistanceType = float;  // newer versions ask for both
    using IndexType = std::uint32_t;
    NearestPoints& nearest;
    std::uint32_t first;  //!< the tree's first point

    /** nanoflann visits what is nearer than this. Its bounds of branches are rounded, and equal
     * distances are to be decided by index: with the margin it misses neither. */
    [[nodiscard]] float worstDist() const
    {
      return nearest.bound() * (1.0F + 1e-5F) + std::numeric_limits<float>::min();
    }
    [[nodiscard]] bool full() const { return nearest.full(); }
    [[nodiscard]] std::size_t size() const { return nearest.count(); }
    void sort() {}
    bool addPoint(DistanceType distance_sqr, IndexType i)
    {
      nearest.offer(distance_sqr, first + i);
      return !nearest.areEnough();
    }
  };

  [[nodiscard]] std::size_t indexed() const
  {
    return trees_.empty() ? 0 : trees_.back()->range.first + trees_.back()->range.count;
  }

  /** nanoflann cannot divide points that are not finite, or whose squares are not. Where there are
   * any, all points from there on are searched one by one. */
  [[nodiscard]] bool isIndexable(std::size_t first) const
  {
    for (std::size_t i = first; i < map_.size(); ++i)
    {
      float x = 0, y = 0, z = 0;
      map_.getPointFast(i, x, y, z);
      if (!CIncrementalPointsMap::isPlace(x, y, z)) return false;
    }
    return true;
  }

  const mrpt::maps::CPointsMap& map_;
  std::vector<std::unique_ptr<Tree>> trees_;
};

}  // namespace fastlio
