// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_index.h"
#include <fastlio/map/incremental_points_map.h>

#include <functional>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
std::unique_ptr<PointIndex> makeIndex(const CIncrementalPointsMap::TCreationOptions& options)
{
  if (!(options.cell_size > 0.0) || !std::isfinite(options.cell_size))
  {
    throw std::invalid_argument(
        "CIncrementalPointsMap: cell_size must be a positive length in metres, but is " +
        std::to_string(options.cell_size));
  }
  if (!(options.min_spacing >= 0.0) || !std::isfinite(options.min_spacing))
  {
    throw std::invalid_argument(
        "CIncrementalPointsMap: min_spacing must be zero or a positive length in metres, but is " +
        std::to_string(options.min_spacing));
  }
  return std::make_unique<PointIndex>(options.cell_size);
}

/** Written out with values, as MRPT's points are packed and must not be referred to where they are
 * not aligned by chance. */
void extend(mrpt::math::TBoundingBoxf& box, const Point3& p)
{
  box.min = {
      std::min<float>(box.min.x, p.x), std::min<float>(box.min.y, p.y),
      std::min<float>(box.min.z, p.z)};
  box.max = {
      std::max<float>(box.max.x, p.x), std::max<float>(box.max.y, p.y),
      std::max<float>(box.max.z, p.z)};
}
}  // namespace

CIncrementalPointsMap::CIncrementalPointsMap() : CIncrementalPointsMap(TCreationOptions{}) {}

CIncrementalPointsMap::CIncrementalPointsMap(const TCreationOptions& options)
    : creation_options_(options), index_(makeIndex(options))
{
}

CIncrementalPointsMap::~CIncrementalPointsMap() = default;

CIncrementalPointsMap::CIncrementalPointsMap(const CIncrementalPointsMap& other)
    : CIncrementalPointsMap(other.creation_options_)
{
  *this = other;
}

CIncrementalPointsMap::CIncrementalPointsMap(const mrpt::maps::CPointsMap& other)
    : CIncrementalPointsMap()
{
  *this = other;
}

CIncrementalPointsMap& CIncrementalPointsMap::operator=(const CIncrementalPointsMap& other)
{
  if (this == &other) return *this;
  *this = static_cast<const mrpt::maps::CPointsMap&>(other);
  setCreationOptions(other.creation_options_);
  totals_ = other.totals_;
  genericMapParams = other.genericMapParams;
  insertionOptions = other.insertionOptions;
  likelihoodOptions = other.likelihoodOptions;
  renderOptions = other.renderOptions;
  return *this;
}

CIncrementalPointsMap& CIncrementalPointsMap::operator=(const mrpt::maps::CPointsMap& other)
{
  mrpt::maps::CSimplePointsMap::operator=(other);
  mark_as_modified();
  return *this;
}

void CIncrementalPointsMap::setCreationOptions(const TCreationOptions& options)
{
  index_ = makeIndex(options);
  creation_options_ = options;
  sync_.valid = false;
}

// ---- Keeping the index right ----

void CIncrementalPointsMap::mark_as_modified() const
{
  sync_.valid = false;
  mrpt::maps::CSimplePointsMap::mark_as_modified();
}

bool CIncrementalPointsMap::indexIsCurrent() const
{
  return sync_.valid && sync_.size == size() && m_boundingBoxIsUpdated &&
         m_largestDistanceFromOriginIsUpdated &&
         sync_.largest_distance == m_largestDistanceFromOrigin &&
         sync_.box.min == m_boundingBox.min && sync_.box.max == m_boundingBox.max;
}

void CIncrementalPointsMap::rememberSync() const
{
  // Fill the inherited caches: mark_as_modified(), from whoever, empties them.
  sync_.box = boundingBox();
  sync_.largest_distance = getLargestDistanceFromOrigin();
  sync_.size = size();
  sync_.valid = true;
}

void CIncrementalPointsMap::rebuildIndex() const
{
  auto rebuilt = std::make_unique<PointIndex>(creation_options_.cell_size);
  for (std::size_t i = 0; i < size(); ++i)
  {
    const Point3 p{m_x[i], m_y[i], m_z[i]};
    if (rebuilt->grid().contains(p)) rebuilt->add(static_cast<std::uint32_t>(i), p);
  }
  index_ = std::move(rebuilt);
  rememberSync();
}

void CIncrementalPointsMap::ensureIndex()
{
  if (!indexIsCurrent()) rebuildIndex();
}

void CIncrementalPointsMap::nn_prepare_for_3d_queries() const
{
  const std::lock_guard<std::mutex> lock(rebuild_mutex_);
  if (!indexIsCurrent()) rebuildIndex();
}

void CIncrementalPointsMap::growSync(std::size_t first_new)
{
  if (first_new == size()) return;
  const bool was_empty = first_new == 0;
  mark_as_modified();
  if (was_empty) return rememberSync();
  double farthest_sqr = static_cast<double>(sync_.largest_distance) * sync_.largest_distance;
  for (std::size_t i = first_new; i < size(); ++i)
  {
    extend(sync_.box, {m_x[i], m_y[i], m_z[i]});
    farthest_sqr = std::max<double>(farthest_sqr, squaredDistance({m_x[i], m_y[i], m_z[i]}, {}));
  }
  sync_.largest_distance = static_cast<float>(std::sqrt(farthest_sqr));
  sync_.size = size();
  sync_.valid = true;
  m_boundingBox = sync_.box;
  m_boundingBoxIsUpdated = true;
  m_largestDistanceFromOrigin = sync_.largest_distance;
  m_largestDistanceFromOriginIsUpdated = true;
}

void CIncrementalPointsMap::internal_clear()
{
  mrpt::maps::CSimplePointsMap::internal_clear();
  index_ = std::make_unique<PointIndex>(creation_options_.cell_size);
  rememberSync();
}

// ---- Growing and shrinking ----

CIncrementalPointsMap::InsertionReport CIncrementalPointsMap::insertPoints(
    const float* x, const float* y, const float* z, std::size_t count)
{
  ensureIndex();
  InsertionReport report;
  const std::size_t before = size();
  const float spacing_sqr = squaredRadius(creation_options_.min_spacing);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Point3 p{x[i], y[i], z[i]};
    NearerThanCollector too_near(spacing_sqr);
    if (!index_->grid().contains(p))
    {
      ++report.refused;
      continue;
    }
    if (spacing_sqr > 0.0F) index_->search(p, too_near);
    if (too_near.found())
    {
      ++report.too_near;
      continue;
    }
    index_->add(static_cast<std::uint32_t>(size()), p);
    insertPointFast(p.x, p.y, p.z);
    ++report.added;
  }
  growSync(before);
  totals_.added += report.added;
  totals_.too_near += report.too_near;
  totals_.refused += report.refused;
  return report;
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
  rememberSync();
  insertPoints(x.data(), y.data(), z.data(), x.size());
  return true;
}

void CIncrementalPointsMap::removePoint(std::uint32_t index)
{
  const auto last = static_cast<std::uint32_t>(size() - 1);
  if (index_->holds(index)) index_->remove(index);
  if (index != last)
  {
    setPointFast(index, m_x[last], m_y[last], m_z[last]);
    if (index_->holds(last)) index_->rename(last, index);
  }
  m_x.pop_back();
  m_y.pop_back();
  m_z.pop_back();
}

std::size_t CIncrementalPointsMap::removeOutside(double x, double y, double z, double radius)
{
  if (!(radius >= 0.0))
  {
    throw std::invalid_argument(
        "CIncrementalPointsMap::removeOutside: the radius must not be negative, but is " +
        std::to_string(radius));
  }
  ensureIndex();
  std::vector<std::uint32_t> outside = index_->pointsOutside(x, y, z, radius);
  if (index_->size() != size())
  {
    for (std::uint32_t i = 0; i < size(); ++i)
    {
      if (!index_->holds(i)) outside.push_back(i);
    }
  }
  if (outside.empty()) return 0;
  // From the back, so that the point moved into a gap is never one that has to go.
  std::sort(outside.begin(), outside.end(), std::greater<>());
  for (const std::uint32_t i : outside)
    removePoint(i);
  mark_as_modified();
  rememberSync();
  return outside.size();
}

std::size_t CIncrementalPointsMap::memoryBytes() const
{
  const std::size_t coordinates = m_x.capacity() + m_y.capacity() + m_z.capacity();
  return sizeof(*this) + coordinates * sizeof(float) + index_->memoryBytes();
}

std::string CIncrementalPointsMap::asString() const
{
  return "fastlio::CIncrementalPointsMap with " + std::to_string(size()) +
         " points, bounding box: " + boundingBox().asString();
}

}  // namespace fastlio
