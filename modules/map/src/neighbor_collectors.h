// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file neighbor_collectors.h What a search keeps of the points it meets.
 *
 * A collector has bound(), the largest squared distance that still interests it, and offer(), which
 * is called only with points within it. */
#pragma once

#include <fastlio/map/neighbors.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace fastlio
{
/** Order of neighbours: by distance, then by index, so that results do not depend on the search. */
[[nodiscard]] inline bool nearerThan(const Neighbor& a, const Neighbor& b)
{
  return a.distance_sqr < b.distance_sqr ||
         (a.distance_sqr == b.distance_sqr && a.point_index < b.point_index);
}

/** Squared search radius [m^2]; an unlimited one stays finite, so that infinite distances, which
 * mark unused places, are beyond it. */
[[nodiscard]] inline float squaredRadius(double radius)
{
  constexpr double kMax = std::numeric_limits<float>::max();
  return static_cast<float>(std::min(radius * radius, kMax));
}

/** Keeps the nearest points in caller's storage, sorted. */
class NearestCollector
{
 public:
  NearestCollector(Neighbor* storage, std::size_t capacity, float radius_sqr)
      : items_(storage), capacity_(capacity), bound_(capacity > 0 ? radius_sqr : -1.0F)
  {
  }

  [[nodiscard]] float bound() const { return bound_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] bool full() const { return count_ == capacity_; }

  void offer(const Neighbor& candidate)
  {
    if (full() && !nearerThan(candidate, items_[count_ - 1])) return;
    std::size_t i = full() ? count_ - 1 : count_++;
    for (; i > 0 && nearerThan(candidate, items_[i - 1]); --i)
      items_[i] = items_[i - 1];
    items_[i] = candidate;
    if (full()) bound_ = items_[count_ - 1].distance_sqr;
  }

 private:
  Neighbor* items_;
  std::size_t capacity_;
  std::size_t count_ = 0;
  float bound_;
};

/** Keeps every point within the radius, unsorted. */
class RadiusCollector
{
 public:
  explicit RadiusCollector(float radius_sqr) : bound_(radius_sqr) {}

  [[nodiscard]] float bound() const { return bound_; }
  void offer(const Neighbor& candidate) { items_.push_back(candidate); }

  /** The points in ascending order. */
  [[nodiscard]] std::vector<Neighbor> sorted() &&
  {
    std::sort(items_.begin(), items_.end(), nearerThan);
    return std::move(items_);
  }

 private:
  std::vector<Neighbor> items_;
  float bound_;
};

/** Only wants to know whether a point lies nearer than the radius; the first one ends the search.
 */
class NearerThanCollector
{
 public:
  explicit NearerThanCollector(float radius_sqr) : bound_(std::nextafter(radius_sqr, 0.0F)) {}

  [[nodiscard]] float bound() const { return bound_; }
  [[nodiscard]] bool found() const { return bound_ < 0; }
  void offer(const Neighbor&) { bound_ = -1.0F; }

 private:
  float bound_;
};

}  // namespace fastlio
