// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file edge_map.h Lines from the nearest edge points of a map: the association of edge features
 * (eq. 12-14). */
#pragma once

#include <fastlio/map/surface_map.h>
#include <fastlio/pointmap/incremental_points_map.h>

#include <optional>
#include <vector>

namespace fastlio
{
/** A line of the map near a point: the residual of eq. 12 is z = [u]x (p - q). */
struct LineMatch
{
  float ux = 0, uy = 0, uz = 0;  //!< unit direction u, world frame
  float qx = 0, qy = 0, qz = 0;  //!< the line's point nearest to the query, world frame [m]
  /** Of the distance of a point on this edge from the line, along any direction across it [m^2];
   * negative: no match. */
  float variance = -1;

  [[nodiscard]] bool valid() const { return variance >= 0.0F; }
};

/** Options of an EdgeMap. */
struct EdgeMapOptions
{
  /** Points of the map are at least this far apart [m]; 0 keeps every point. */
  double min_spacing = 0.2;
  /** Standard deviation of an edge point about its edge before its neighbours are seen [m]. */
  double point_noise = 0.02;
};

/** Edge points of earlier scans, and the line through the nearest ones of a query.
 *
 * A feature is the sharpest *measured* point, up to half the beams' spacing away from the edge
 * itself, and so are the map's points. What a measurement may differ from the line is therefore
 * learnt from the map's own points: the variance is s^2 (1 + 1/n + t^2 / (n lambda)), the
 * prediction variance of a linear regression for one more point at the coordinate t along the line,
 * with s^2 = (w s_0^2 + SSR) / (w + 2 (n - 2)): point_noise s_0 as the prior, worth w = 4
 * observations, and the squared distances SSR of the n neighbours, which have 2 (n - 2) degrees of
 * freedom.
 *
 * match() is const, allocates nothing, and may run in several threads at once; the other methods
 * may not run beside it. */
class EdgeMap
{
 public:
  /** \exception std::invalid_argument an option is out of its range (the message names it) */
  explicit EdgeMap(const EdgeMapOptions& options = {});

  /** Finds the line for each of the points [first, last); writes matches[first..last).
   * \exception std::invalid_argument the range exceeds the points or the matches */
  void match(
      const WorldPoints& points, std::size_t first, std::size_t last,
      std::vector<LineMatch>& matches) const;

  /** Adds the edge points of a scan, world frame (eq. 21). */
  void insert(const WorldPoints& points);

  /** Drops what lies farther than \a radius [m] from \a center, once the centre has moved by a
   * tenth of the radius since it last did. */
  void removeOutside(const Vec3& center, double radius);

  [[nodiscard]] std::size_t pointCount() const { return map_.size(); }

 private:
  [[nodiscard]] LineMatch matchPoint(float x, float y, float z) const;

  EdgeMapOptions options_;
  CIncrementalPointsMap map_;
  std::optional<Vec3> last_removal_center_;
};

}  // namespace fastlio
