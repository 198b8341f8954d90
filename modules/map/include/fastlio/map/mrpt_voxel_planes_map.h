// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mrpt_voxel_planes_map.h The map of planes as a metric map of MRPT. */
#pragma once

#include <fastlio/compat/mrpt_compat.h>
#include <fastlio/map/voxel_plane_map.h>
#include <fastlio/pointmap/incremental_points_map.h>

#include <mrpt/config/CLoadableOptions.h>
#include <mrpt/maps/CMetricMap.h>

#include <memory>
#include <mutex>
#include <string>

namespace fastlio
{
/** VoxelPlaneMap, the fast map of the odometry, for MRPT programs: observations go in, it is saved,
 * loaded, shown, searched and turned into points.
 *
 * As points it is the mean of the points in each of its finest voxels. They are made when first
 * asked for after a change (neighbours, likelihood, matching, conversion) and kept until the next
 * one: prepare with nn_prepare_for_3d_queries() before searching from several threads.
 *
 * Thread safety: const methods may run at the same time. */
class CVoxelPlanesMap : public mrpt::maps::CMetricMap, public NearestNeighborsInterface
{
  DEFINE_SERIALIZABLE(CVoxelPlanesMap, fastlio)

 public:
  /** Section `creationOpts` of a map definition: VoxelPlaneOptions by the names of its members. */
  struct TCreationOptions : public mrpt::config::CLoadableOptions
  {
    VoxelPlaneOptions planes;

    void loadFromConfigFile(
        const mrpt::config::CConfigFileBase& source, const std::string& section) override;
    void dumpToTextStream(std::ostream& out) const override;
  };

  /** Section `insertOpts`. */
  struct TInsertionOptions : public mrpt::config::CLoadableOptions
  {
    /** After each observation, what is farther than this from its sensor may leave the map [m]; 0:
     * never. */
    double radius = 0.0;

    void loadFromConfigFile(
        const mrpt::config::CConfigFileBase& source, const std::string& section) override;
    void dumpToTextStream(std::ostream& out) const override;
  };

  /** Section `renderOpts`: what getVisualizationInto() shows. */
  struct TRenderOptions : public mrpt::config::CLoadableOptions
  {
    bool points = true;       //!< coloured by height
    bool planes = true;       //!< a rectangle each, coloured by the direction of its normal
    float point_size = 2.0F;  //!< [pixels]

    void loadFromConfigFile(
        const mrpt::config::CConfigFileBase& source, const std::string& section) override;
    void dumpToTextStream(std::ostream& out) const override;
  };

  CVoxelPlanesMap();
  /** \exception std::invalid_argument an option is out of its range (the message names it) */
  explicit CVoxelPlanesMap(const TCreationOptions& options);
  /** A copy of the odometry's map. */
  explicit CVoxelPlanesMap(const VoxelPlaneMap& planes);
  CVoxelPlanesMap(const CVoxelPlanesMap& other);
  CVoxelPlanesMap& operator=(const CVoxelPlanesMap& other);
  ~CVoxelPlanesMap() override;

  /** The map as the odometry uses it: matching of points with planes. */
  [[nodiscard]] const VoxelPlaneMap& planes() const { return planes_; }

  /** Adds points seen from \a sensor_origin, both in the map's frame [m]; those that are not finite
   * or too far out are left out. \return number of points added */
  std::size_t insertPoints(const WorldPoints& points, const Vec3& sensor_origin);
  /** Drops everything farther than \a radius [m] from \a center, at once. */
  void removeOutside(const Vec3& center, double radius);

  /** Mean points of the finest voxels. Valid until the map changes. */
  [[nodiscard]] const CIncrementalPointsMap& points() const;

  /** Writes an archive, gzipped. \exception std::runtime_error it cannot be written */
  void saveToFile(const std::string& path) const;
  /** Reads what saveToFile() wrote; MRPT's programs read it too.
   * \exception std::runtime_error it cannot be read, or is something else; the map is as it was */
  void loadFromFile(const std::string& path);

  [[nodiscard]] bool isEmpty() const override;
  [[nodiscard]] std::string asString() const override;
  /** Points as \a prefix.ply, archive as \a prefix.metricmap. */
  void saveMetricMapRepresentationToFile(const std::string& prefix) const override;
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const override;
  [[nodiscard]] const mrpt::maps::CSimplePointsMap* getAsSimplePointsMap() const override;
  [[nodiscard]] mrpt::math::TBoundingBoxf boundingBox() const FASTLIO_NN_OVERRIDE;
  void determineMatching3D(
      const mrpt::maps::CMetricMap* other, const mrpt::poses::CPose3D& other_pose,
      mrpt::tfest::TMatchingPairList& pairs, const mrpt::maps::TMatchingParams& params,
      mrpt::maps::TMatchingExtraResults& extra) const override;
  [[nodiscard]] float compute3DMatchingRatio(
      const mrpt::maps::CMetricMap* other, const mrpt::poses::CPose3D& other_pose,
      const mrpt::maps::TMatchingRatioParams& params) const override;

  /** @name Nearest neighbours among points(), by MRPT's names; indices are those of points(). Plain
   * methods, and none in the plane, before MRPT 2.11.3.
   * @{ */
  [[nodiscard]] bool nn_has_indices_or_ids() const FASTLIO_NN_OVERRIDE { return true; }
  [[nodiscard]] std::size_t nn_index_count() const FASTLIO_NN_OVERRIDE { return points().size(); }
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
  void nn_prepare_for_2d_queries() const override;
  [[nodiscard]] bool nn_single_search(
      const mrpt::math::TPoint2Df& query, mrpt::math::TPoint2Df& result, float& out_dist_sqr,
      std::uint64_t& result_index) const override;
  void nn_multiple_search(
      const mrpt::math::TPoint2Df& query, const std::size_t count,
      std::vector<mrpt::math::TPoint2Df>& results, std::vector<float>& out_dists_sqr,
      std::vector<std::uint64_t>& result_indices) const override;
  void nn_radius_search(
      const mrpt::math::TPoint2Df& query, const float search_radius_sqr,
      std::vector<mrpt::math::TPoint2Df>& results, std::vector<float>& out_dists_sqr,
      std::vector<std::uint64_t>& result_indices, std::size_t max_points = 0) const override;
#endif
  /** @} */

  TInsertionOptions insertionOptions;
  /** Those of the points; taken over when these are made. */
  mrpt::maps::CPointsMap::TLikelihoodOptions likelihoodOptions;
  TRenderOptions renderOptions;

 protected:
  void internal_clear() override;
  bool internal_insertObservation(
      const mrpt::obs::CObservation& obs,
      const std::optional<const mrpt::poses::CPose3D>& robotPose = std::nullopt) override;
  double internal_computeObservationLikelihood(
      const mrpt::obs::CObservation& obs, const mrpt::poses::CPose3D& takenFrom) const override;
  bool internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& obs) const override;

 private:
  VoxelPlaneMap planes_;
  // A cache: made from the planes when there is none.
  mutable std::unique_ptr<CIncrementalPointsMap> points_;
  mutable std::mutex points_mutex_;

  MAP_DEFINITION_START(CVoxelPlanesMap)
  TCreationOptions creationOpts;
  TInsertionOptions insertionOpts;
  mrpt::maps::CPointsMap::TLikelihoodOptions likelihoodOpts;
  TRenderOptions renderOpts;
  MAP_DEFINITION_END(CVoxelPlanesMap)
};

}  // namespace fastlio
