// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file height_field.h Uneven ground: heights over a regular grid, two triangles per cell. */
#pragma once

#include <fastlio/worlds/primitive.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace fastlio
{
/** Heights at the nodes of a square grid; each cell is split along its diagonal from (0,0) to
 * (1,1). */
class HeightField
{
 public:
  struct Extent
  {
    double min_x, min_y;  //!< corner [m]
    double cell;          //!< edge of a cell [m]
    int cells_x, cells_y;
  };

  /** Samples the function at the nodes. \exception std::invalid_argument no cells, or a height that
   * is not finite */
  HeightField(
      const Extent& extent, const std::function<double(double x, double y)>& height,
      double reflectivity);

  /** Height of the surface; the nearest border's outside of the extent. */
  [[nodiscard]] double height(double x, double y) const;

  [[nodiscard]] std::optional<RayHit> cast(const Ray& ray, double max_range) const;

 private:
  [[nodiscard]] std::size_t nodeIndex(int i, int j) const;
  [[nodiscard]] double node(int i, int j) const;
  [[nodiscard]] double top(int i, int j) const;
  [[nodiscard]] std::optional<RayHit> castCell(
      const Ray& ray, int i, int j, double max_range) const;

  Extent extent_;
  double reflectivity_;
  std::vector<float> heights_;  // of the nodes
  std::vector<float> tops_;     // of the cells: the highest of their nodes
  double lowest_ = 0.0, highest_ = 0.0;
};

}  // namespace fastlio
