// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file knn_surface_map.h Planes from the nearest map points: the association of the paper
 * (eq. 12-14) with exact neighbours. */
#pragma once

#include <fastlio/map/surface_map.h>
#include <fastlio/pointmap/incremental_points_map.h>

#include <optional>

namespace fastlio
{
/** Options of a KnnSurfaceMap. */
struct KnnSurfaceMapOptions
{
  /** Points of the map are at least this far apart [m]; 0 keeps every point. */
  double min_spacing = 0.4;
  /** Standard deviation of a map point about its surface before its neighbours are seen [m]. */
  double point_noise = 0.02;
};

/** SurfaceMap over a CIncrementalPointsMap: plane through the nearest points of each query.
 *
 * A match is valid when kNeighbors points lie within kMaxNeighborDistance, are not on a line, and
 * all lie within kMaxPlaneDistance of their plane. Its variance is planeOffsetVariance() with the
 * point variance s^2 = (w s_0^2 + SSR) / (w + n - 3): point_noise s_0 as the prior, worth w = 4
 * observations, and the squared residuals SSR of the n neighbours, which have n - 3 degrees of
 * freedom. With five neighbours the residuals alone would now and then claim a perfect plane.
 *
 * match() is const, allocates nothing, and may run in several threads
 * at once; the other methods may not run beside it. */
class KnnSurfaceMap : public SurfaceMap
{
 public:
  static constexpr std::size_t kNeighbors = 5;  //!< that make a plane (paper)
  /** The farthest neighbour may be this far from the point: the square root of 5 [m]. */
  static constexpr double kMaxNeighborDistance = 2.23606797749979;
  /** A neighbour farther from the plane than this makes it no plane [m]. */
  static constexpr double kMaxPlaneDistance = 0.1;

  /** \exception std::invalid_argument an option is out of its range (the message names it) */
  explicit KnnSurfaceMap(const KnnSurfaceMapOptions& options = {});

  /** \exception std::invalid_argument the range exceeds the points or the matches */
  void match(
      const WorldPoints& points, const Vec3& sensor_origin, std::size_t first, std::size_t last,
      std::vector<PlaneMatch>& matches) const override;
  /** The origin is not needed: neighbours, not sides, make the planes. */
  void insert(const WorldPoints& points, const Vec3& sensor_origin) override;
  /** Acts once the centre has moved by a tenth of the radius since it last did. */
  void removeOutside(const Vec3& center, double radius) override;
  [[nodiscard]] std::size_t pointCount() const override { return map_.size(); }
  [[nodiscard]] mrpt::maps::CSimplePointsMap::Ptr toPointsMap() const override;

  [[nodiscard]] const CIncrementalPointsMap& pointsMap() const { return map_; }
  [[nodiscard]] const KnnSurfaceMapOptions& options() const { return options_; }

 private:
  [[nodiscard]] PlaneMatch matchPoint(float x, float y, float z) const;

  KnnSurfaceMapOptions options_;
  CIncrementalPointsMap map_;
  std::optional<Vec3> last_removal_center_;
};

}  // namespace fastlio
