// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file incremental_points_map.h A points map of MRPT that grows, shrinks and finds exact nearest
 * neighbours. */
#pragma once

#include <fastlio/compat/mrpt_compat.h>

#include <mrpt/config/CLoadableOptions.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

namespace fastlio
{
class PointForest;

/** A map point found by a query. */
struct Neighbor
{
  float x = 0, y = 0, z = 0;      //!< the point, map frame [m]
  float distance_sqr = 0;         //!< squared distance to the query [m^2]
  std::uint32_t point_index = 0;  //!< index of the point in the map's buffers
};

/** Most neighbours that a NeighborSet can hold. */
constexpr std::size_t kMaxNeighbors = 16;

/** Neighbours in ascending order of (distance, point_index), without heap storage. */
struct NeighborSet
{
  std::array<Neighbor, kMaxNeighbors> items;
  std::size_t count = 0;

  [[nodiscard]] std::size_t size() const { return count; }
  [[nodiscard]] bool empty() const { return count == 0; }
  [[nodiscard]] const Neighbor& operator[](std::size_t i) const { return items[i]; }
  [[nodiscard]] const Neighbor* begin() const { return items.data(); }
  [[nodiscard]] const Neighbor* end() const { return items.data() + count; }
};

/** An mrpt::maps::CSimplePointsMap with an index that grows with it: points are added at a minimum
 * spacing, dropped outside of a region, and exact nearest neighbours found in logarithmic time.
 *
 * The buffers stay dense and in the order of insertion; everything inherited works on them: PLY and
 * text files, visualisation, copies, maps of maps, ICP.
 *
 * **Inherited ways to change points** (insertPoint(), setPoint(), changeCoordinatesReference(),
 * loading, ...) make the index stale; MRPT's mark_as_modified() and the number of points show
 * it. On a stale index nearest() gives the same answers by looking at every point; ensureIndex(),
 * or any of the non-const methods below, rebuilds it. As in every MRPT points map, the *Fast()
 * methods do not mark the change; call mark_as_modified() after them.
 *
 * nearest() may run in several threads at the same time. */
class CIncrementalPointsMap : public mrpt::maps::CSimplePointsMap
{
  DEFINE_SERIALIZABLE(CIncrementalPointsMap, fastlio)

 public:
  /** Section `creationOpts` of a map definition. */
  struct TCreationOptions : public mrpt::config::CLoadableOptions
  {
    double min_spacing = 0.0;  //!< least distance between points [m]; 0 keeps every point

    void loadFromConfigFile(
        const mrpt::config::CConfigFileBase& source, const std::string& section) override;
    void dumpToTextStream(std::ostream& out) const override;
  };

  /** \param min_spacing least distance between points that insertPoints() and insertObservation()
   * add [m]; 0 keeps every point
   * \exception std::invalid_argument it is negative or not finite */
  explicit CIncrementalPointsMap(double min_spacing = 0.0);
  ~CIncrementalPointsMap() override;
  CIncrementalPointsMap(const CIncrementalPointsMap& other);
  CIncrementalPointsMap& operator=(const CIncrementalPointsMap& other);
  /** Takes the points of any map; the spacing stays. */
  explicit CIncrementalPointsMap(const mrpt::maps::CPointsMap& other);
  using mrpt::maps::CSimplePointsMap::operator=;

  [[nodiscard]] double minSpacing() const { return min_spacing_; }

  /** Whether insertPoints() takes such a point: finite, at most 10000 km from the origin. */
  [[nodiscard]] static bool isPlace(float x, float y, float z)
  {
    constexpr float kFarthest = 1e7F;  // [m]
    return std::abs(x) <= kFarthest && std::abs(y) <= kFarthest && std::abs(z) <= kFarthest;
  }

  /** Adds, in the given order, the points that are at least minSpacing() away from all earlier
   * ones. \param x,y,z \a count coordinates each, map frame [m] \return number of points added */
  std::size_t insertPoints(const float* x, const float* y, const float* z, std::size_t count);

  /** Removes every point farther than \a radius [m] from (x, y, z); points that are not finite too.
   * \return number of points removed */
  std::size_t removeOutside(double x, double y, double z, double radius);

  /** The \a k nearest points, at most \a max_distance [m] away, exactly: ascending by distance,
   * equal distances by index. Fewer when the map has fewer within that distance. Allocates nothing.
   * \exception std::invalid_argument k exceeds kMaxNeighbors */
  [[nodiscard]] NeighborSet nearest(
      float x, float y, float z, std::size_t k,
      double max_distance = std::numeric_limits<double>::infinity()) const;
  /** The same for any \a k, into \a neighbors, which has room for so many.
   * \return how many were found */
  std::size_t nearest(
      float x, float y, float z, std::size_t k, double max_distance, Neighbor* neighbors) const;

  /** Rebuilds the index if it is stale. */
  void ensureIndex();
  /** Whether nearest() uses the index (true) or looks at every point. */
  [[nodiscard]] bool indexIsCurrent() const;

 protected:
  void internal_clear() override;
  bool internal_insertObservation(
      const mrpt::obs::CObservation& obs,
      const std::optional<const mrpt::poses::CPose3D>& robotPose = std::nullopt) override;

 private:
  void rebuildIndex();
  void rememberPoints();

  double min_spacing_ = 0.0;
  std::unique_ptr<PointForest> forest_;
  // The state that the index was made for: any marked change differs.
  std::size_t indexed_size_ = 0;
  float mark_ = 0.0F;

  MAP_DEFINITION_START(CIncrementalPointsMap)
  TCreationOptions creationOpts;
  mrpt::maps::CPointsMap::TInsertionOptions insertionOpts;
  mrpt::maps::CPointsMap::TLikelihoodOptions likelihoodOpts;
  mrpt::maps::CPointsMap::TRenderOptions renderOpts;
  MAP_DEFINITION_END(CIncrementalPointsMap)
};

}  // namespace fastlio
