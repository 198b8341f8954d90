// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file incremental_points_map.h A points map that grows, shrinks and is searched without
 * rebuilds. */
#pragma once

#include <fastlio/compat/mrpt_compat.h>
#include <fastlio/map/neighbors.h>

#include <mrpt/config/CLoadableOptions.h>
#include <mrpt/maps/CSimplePointsMap.h>

#include <memory>
#include <mutex>
#include <vector>

namespace fastlio
{
class PointIndex;

/** An mrpt::maps::CSimplePointsMap with its own spatial index over the inherited buffers: points
 * are added one by one at a minimum spacing, dropped outside of a region, and exact nearest
 * neighbours found in constant time, all without rebuilding anything.
 *
 * The buffers stay dense (removal moves the last point into the gap), so size() is the number of
 * live points and everything inherited works on them: PLY and text files, visualisation, copies,
 * maps of maps, ICP. Indices of points are therefore valid only until the next removal.
 *
 * **Inherited ways to change points** (insertPoint(), setPoint(), clear(), assignment,
 * changeCoordinatesReference(), loading, ...) are noticed through MRPT's own mark_as_modified() and
 * the number of points. The index is then stale: ensureIndex(), or any of the non-const methods
 * below, rebuilds it once. Const queries never change anything: on a stale index they give the same
 * answers by looking at every point. So call ensureIndex() (or nn_prepare_for_3d_queries()) before
 * a loop of queries. As in every MRPT points map, the *Fast() methods do not mark the change; call
 * mark_as_modified() after them.
 *
 * Thread safety: const methods may run at the same time while the index is current.
 *
 * Inherited insertion keeps every point, as in CSimplePointsMap; insertObservation() applies the
 * minimum spacing unless insertionOptions asks to fuse or to replace. */
class CIncrementalPointsMap : public mrpt::maps::CSimplePointsMap
{
  DEFINE_SERIALIZABLE(CIncrementalPointsMap, fastlio)

 public:
  /** Section `creationOpts` of a map definition. */
  struct TCreationOptions : public mrpt::config::CLoadableOptions
  {
    double cell_size = 1.0;    //!< edge of the index cells [m]; 3 spacings search fastest
    double min_spacing = 0.0;  //!< least distance between points added by insertPoints() [m]

    void loadFromConfigFile(
        const mrpt::config::CConfigFileBase& source, const std::string& section) override;
    void dumpToTextStream(std::ostream& out) const override;
  };

  /** What insertPoints() did with the points it was given. */
  struct InsertionReport
  {
    std::size_t added = 0;
    std::size_t too_near = 0;  //!< nearer than min_spacing to a point of the map
    std::size_t refused = 0;   //!< not finite, or so far out that cells cannot be numbered
  };

  CIncrementalPointsMap();
  /** \exception std::invalid_argument cell_size or min_spacing out of range */
  explicit CIncrementalPointsMap(const TCreationOptions& options);
  ~CIncrementalPointsMap() override;
  CIncrementalPointsMap(const CIncrementalPointsMap& other);
  CIncrementalPointsMap& operator=(const CIncrementalPointsMap& other);
  /** Takes the points of any map; the creation options stay. */
  explicit CIncrementalPointsMap(const mrpt::maps::CPointsMap& other);
  CIncrementalPointsMap& operator=(const mrpt::maps::CPointsMap& other);

  [[nodiscard]] const TCreationOptions& creationOptions() const { return creation_options_; }
  /** Changes cell size and spacing; points already held are kept and indexed anew when needed.
   * \exception std::invalid_argument cell_size or min_spacing out of range */
  void setCreationOptions(const TCreationOptions& options);

  /** Adds the points that are at least min_spacing away from all earlier ones, in the given order.
   * \param x,y,z \a count coordinates each, map frame [m] */
  InsertionReport insertPoints(const float* x, const float* y, const float* z, std::size_t count);
  /** Sum of all reports since the map was made or loaded. */
  [[nodiscard]] const InsertionReport& insertionTotals() const { return totals_; }

  /** Removes every point farther than \a radius [m] from (x, y, z); points that are not finite too.
   * \return number of points removed */
  std::size_t removeOutside(double x, double y, double z, double radius);

  /** The \a k nearest points, at most \a max_distance [m] away, exactly: ascending by distance,
   * equal distances by index. Fewer when the map has fewer within that distance. \exception
   * std::invalid_argument k exceeds kMaxNeighbors */
  [[nodiscard]] NeighborSet nearest(
      float x, float y, float z, std::size_t k,
      double max_distance = std::numeric_limits<double>::infinity()) const;

  /** Makes the index current; cheap when it already is. */
  void ensureIndex();
  /** Whether queries use the index (true) or fall back to looking at every point. */
  [[nodiscard]] bool indexIsCurrent() const;
  /** Marks a change, as the inherited method does. */
  void mark_as_modified() const;

  /** Bytes held by the points and the index. */
  [[nodiscard]] std::size_t memoryBytes() const;

  /** @name Nearest neighbours by MRPT's names (mrpt::maps::NearestNeighborsCapable, MRPT >= 2.11.3;
   * plain methods of the same signature before). The 2D searches use MRPT's kd-tree.
   * @{ */
  [[nodiscard]] bool nn_has_indices_or_ids() const FASTLIO_NN_OVERRIDE { return true; }
  [[nodiscard]] std::size_t nn_index_count() const FASTLIO_NN_OVERRIDE { return size(); }
  /** Rebuilds a stale index; to be called before queries from several threads. */
  void nn_prepare_for_3d_queries() const FASTLIO_NN_OVERRIDE;
  [[nodiscard]] bool nn_single_search(
      const mrpt::math::TPoint3Df& query, mrpt::math::TPoint3Df& result, float& out_dist_sqr,
      std::uint64_t& result_index) const FASTLIO_NN_OVERRIDE;
  void nn_multiple_search(
      const mrpt::math::TPoint3Df& query, const std::size_t count,
      std::vector<mrpt::math::TPoint3Df>& results, std::vector<float>& out_dists_sqr,
      std::vector<std::uint64_t>& result_indices) const FASTLIO_NN_OVERRIDE;
  void nn_radius_search(
      const mrpt::math::TPoint3Df& query, const float search_radius_sqr,
      std::vector<mrpt::math::TPoint3Df>& results, std::vector<float>& out_dists_sqr,
      std::vector<std::uint64_t>& result_indices,
      std::size_t max_points = 0) const FASTLIO_NN_OVERRIDE;
#if FASTLIO_MRPT_HAS_NN_INTERFACE
  using mrpt::maps::CPointsMap::nn_multiple_search;
  using mrpt::maps::CPointsMap::nn_radius_search;
  using mrpt::maps::CPointsMap::nn_single_search;
#else
  void nn_prepare_for_2d_queries() const;
  [[nodiscard]] bool nn_single_search(
      const mrpt::math::TPoint2Df& query, mrpt::math::TPoint2Df& result, float& out_dist_sqr,
      std::uint64_t& result_index) const;
  void nn_multiple_search(
      const mrpt::math::TPoint2Df& query, const std::size_t count,
      std::vector<mrpt::math::TPoint2Df>& results, std::vector<float>& out_dists_sqr,
      std::vector<std::uint64_t>& result_indices) const;
  void nn_radius_search(
      const mrpt::math::TPoint2Df& query, const float search_radius_sqr,
      std::vector<mrpt::math::TPoint2Df>& results, std::vector<float>& out_dists_sqr,
      std::vector<std::uint64_t>& result_indices, std::size_t max_points) const;
#endif
  /** @} */

  [[nodiscard]] std::string asString() const override;

 protected:
  void internal_clear() override;
  bool internal_insertObservation(
      const mrpt::obs::CObservation& obs,
      const std::optional<const mrpt::poses::CPose3D>& robotPose = std::nullopt) override;

 private:
  /** What the inherited caches said when the index was last right: any marked change differs. */
  struct SyncPoint
  {
    mrpt::math::TBoundingBoxf box;  // packed: aligned only because it comes first
    float largest_distance = 0;
    std::size_t size = 0;
    bool valid = false;
  };

  void rebuildIndex() const;
  void rememberSync() const;
  void growSync(std::size_t first_new);
  void removePoint(std::uint32_t index);

  TCreationOptions creation_options_;
  InsertionReport totals_;
  // A cache: rebuilt from the points at any time, also by nn_prepare_for_3d_queries() const.
  mutable std::unique_ptr<PointIndex> index_;
  mutable SyncPoint sync_;
  mutable std::mutex rebuild_mutex_;

  MAP_DEFINITION_START(CIncrementalPointsMap)
  TCreationOptions creationOpts;
  mrpt::maps::CPointsMap::TInsertionOptions insertionOpts;
  mrpt::maps::CPointsMap::TLikelihoodOptions likelihoodOpts;
  mrpt::maps::CPointsMap::TRenderOptions renderOpts;
  MAP_DEFINITION_END(CIncrementalPointsMap)
};

}  // namespace fastlio
