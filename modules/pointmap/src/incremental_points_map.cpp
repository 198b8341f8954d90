// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_forest.h"
#include <fastlio/pointmap/incremental_points_map.h>

#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
double checkedSpacing(double min_spacing)
{
  if (min_spacing >= 0.0 && std::isfinite(min_spacing)) return min_spacing;
  throw std::invalid_argument(
      "CIncrementalPointsMap: min_spacing must be zero or a positive length in metres, but is " +
      std::to_string(min_spacing));
}
}  // namespace

CIncrementalPointsMap::CIncrementalPointsMap(double min_spacing)
    : min_spacing_(checkedSpacing(min_spacing)), forest_(std::make_unique<PointForest>(*this))
{
}

CIncrementalPointsMap::~CIncrementalPointsMap() = default;

CIncrementalPointsMap::CIncrementalPointsMap(const CIncrementalPointsMap& other)
    : CIncrementalPointsMap(other.min_spacing_)
{
  *this = other;
}

CIncrementalPointsMap::CIncrementalPointsMap(const mrpt::maps::CPointsMap& other)
    : CIncrementalPointsMap()
{
  *this = other;
  rebuildIndex();
}

CIncrementalPointsMap& CIncrementalPointsMap::operator=(const CIncrementalPointsMap& other)
{
  if (this == &other) return *this;
  mrpt::maps::CSimplePointsMap::operator=(other);
  min_spacing_ = other.min_spacing_;
  genericMapParams = other.genericMapParams;
  insertionOptions = other.insertionOptions;
  likelihoodOptions = other.likelihoodOptions;
  renderOptions = other.renderOptions;
  rebuildIndex();
  return *this;
}

// ---- Keeping the index right ----

bool CIncrementalPointsMap::indexIsCurrent() const
{
  return m_largestDistanceFromOriginIsUpdated && m_largestDistanceFromOrigin == mark_ &&
         indexed_size_ == size();
}

/** Leaves a mark in the one of MRPT's caches that a last digit does not matter to:
 * mark_as_modified() from wherever empties the cache, and when it is filled again, the mark is
 * gone. */
void CIncrementalPointsMap::rememberPoints()
{
  mark_as_modified();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  mark_ = m_largestDistanceFromOrigin = std::nextafter(getLargestDistanceFromOrigin(), kInfinity);
  indexed_size_ = size();
}

void CIncrementalPointsMap::rebuildIndex()
{
  forest_->clear();
  forest_->grow();
  rememberPoints();
}

void CIncrementalPointsMap::ensureIndex()
{
  if (!indexIsCurrent()) rebuildIndex();
}

void CIncrementalPointsMap::internal_clear()
{
  mrpt::maps::CSimplePointsMap::internal_clear();
  rebuildIndex();
}

// ---- Growing and shrinking ----

std::size_t CIncrementalPointsMap::insertPoints(
    const float* x, const float* y, const float* z, std::size_t count)
{
  ensureIndex();
  const std::size_t before = size();
  const auto spacing_sqr = static_cast<float>(min_spacing_ * min_spacing_);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!isPlace(x[i], y[i], z[i])) continue;
    if (spacing_sqr > 0.0F)
    {
      Neighbor neighbor;
      NearestPoints nearest(&neighbor, 1, min_spacing_, spacing_sqr);
      forest_->search({x[i], y[i], z[i]}, nearest);
      if (nearest.areEnough()) continue;
    }
    insertPointFast(x[i], y[i], z[i]);
    forest_->grow();
  }
  if (size() != before) rememberPoints();
  return size() - before;
}

bool CIncrementalPointsMap::internal_insertObservation(
    const mrpt::obs::CObservation& obs, const std::optional<const mrpt::poses::CPose3D>& robotPose)
{
  ensureIndex();
  const std::size_t before = size();
  if (!mrpt::maps::CSimplePointsMap::internal_insertObservation(obs, robotPose)) return false;
  const bool appended =
      insertionOptions.addToExistingPointsMap && !insertionOptions.fuseWithExisting;
  if (!appended || size() < before) return true;
  // Take back what was appended and let it in at the map's spacing.
  const auto tail = static_cast<std::ptrdiff_t>(before);
  const std::vector<float> x(m_x.begin() + tail, m_x.end());
  const std::vector<float> y(m_y.begin() + tail, m_y.end());
  const std::vector<float> z(m_z.begin() + tail, m_z.end());
  resize(before);
  rememberPoints();
  insertPoints(x.data(), y.data(), z.data(), x.size());
  return true;
}

std::size_t CIncrementalPointsMap::removeOutside(double x, double y, double z, double radius)
{
  if (!(radius >= 0.0))
    throw std::invalid_argument(
        "CIncrementalPointsMap::removeOutside: the radius must not be negative, but is " +
        std::to_string(radius));
  const std::size_t before = size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < before; ++i)
  {
    const double dx = m_x[i] - x, dy = m_y[i] - y, dz = m_z[i] - z;
    if (dx * dx + dy * dy + dz * dz <= radius * radius)
      setPointFast(kept++, m_x[i], m_y[i], m_z[i]);
  }
  if (kept == before) return 0;
  resize(kept);
  rebuildIndex();
  return before - kept;
}

// ---- Searching ----

std::size_t CIncrementalPointsMap::nearest(
    float x, float y, float z, std::size_t k, double max_distance, Neighbor* neighbors) const
{
  const bool is_finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
  if (k == 0 || !is_finite || !(max_distance >= 0.0)) return 0;
  NearestPoints nearest(neighbors, k, max_distance);
  if (indexIsCurrent())
    forest_->search({x, y, z}, nearest);
  else
    forest_->searchOneByOne({x, y, z}, 0, nearest);
  nearest.sort();
  for (std::size_t i = 0; i < nearest.count(); ++i)
    getPointFast(neighbors[i].point_index, neighbors[i].x, neighbors[i].y, neighbors[i].z);
  return nearest.count();
}

NeighborSet CIncrementalPointsMap::nearest(
    float x, float y, float z, std::size_t k, double max_distance) const
{
  if (k > kMaxNeighbors)
    throw std::invalid_argument(
        "CIncrementalPointsMap::nearest: at most " + std::to_string(kMaxNeighbors) +
        " neighbours can be asked for, not " + std::to_string(k) +
        "; give storage of your own for more");
  NeighborSet set;
  set.count = nearest(x, y, z, k, max_distance, set.items.data());
  return set;
}

}  // namespace fastlio
