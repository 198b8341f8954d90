// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_plane_map.h A map of planes at three scales: association is one hash lookup. */
#pragma once

#include <fastlio/map/plane_voxel.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/parallel/workers.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace mrpt::serialization
{
class CArchive;
}  // namespace mrpt::serialization

namespace fastlio
{
/** Options of VoxelPlaneMap. */
struct VoxelPlaneOptions
{
  double voxel_size = 0.4;  //!< edge of the finest voxels [m]; the others are 2 and 4 times as wide
  PlaneRules rules;
};

/** Planes by incremental sums in cubic voxels of three sizes.
 *
 * Space is cut into blocks of 4 x 4 x 4 finest voxels; a hash finds the block, the block knows its
 * voxels: 64 of the finest size, 8 of twice that, 1 of four times. A point joins one voxel of each
 * size; a query takes, of up to three planes at the point, the one whose offset there is known
 * best: a wall is averaged over the whole block, a small face over its own voxel.
 *
 * removeOutside() looks at a part of the blocks per call, so that no call stands out; storage of
 * dropped blocks is used again. */
class VoxelPlaneMap : public SurfaceMap
{
 public:
  /** removeOutside() has looked at every block after so many calls. */
  static constexpr std::size_t kCallsPerSweep = 16;

  /** \param workers who share insertions; the map does not depend on them
   * \exception std::invalid_argument an option is out of its range (the message names it) */
  explicit VoxelPlaneMap(
      const VoxelPlaneOptions& options,
      std::shared_ptr<const Workers> workers = std::make_shared<const Workers>(1));

  ~VoxelPlaneMap() override;
  /** A copy has workers of its own: both maps may insert at the same time. */
  VoxelPlaneMap(
      const VoxelPlaneMap& other,
      std::shared_ptr<const Workers> workers = std::make_shared<const Workers>(1));
  VoxelPlaneMap& operator=(const VoxelPlaneMap& other);

  void match(
      const WorldPoints& points, const Vec3& sensor_origin, std::size_t first, std::size_t last,
      std::vector<PlaneMatch>& matches) const override;
  void rematch(
      const WorldPoints& before, const WorldPoints& points, const Vec3& sensor_origin,
      std::size_t first, std::size_t last, std::vector<PlaneMatch>& matches) const override;
  void insert(const WorldPoints& points, const Vec3& sensor_origin) override;
  void insertFrom(const WorldPoints& points, const Pose& T_world_sensor) override;
  void removeOutside(const Vec3& center, double radius) override;
  [[nodiscard]] std::uint32_t insertionCount() const override;
  [[nodiscard]] bool knowsSharedErrors() const override { return true; }
  /** Number of finest voxels with points. */
  [[nodiscard]] std::size_t pointCount() const override;
  /** The mean point of each finest voxel. */
  [[nodiscard]] std::shared_ptr<mrpt::maps::CSimplePointsMap> toPointsMap() const override;

  /** The options that it was made with. */
  [[nodiscard]] const VoxelPlaneOptions& options() const;
  /** Planes that are the best known ones at their own centroid: each surface once, at the scale
   * that fits it. Normals point to the side that a surface was seen from. */
  [[nodiscard]] std::vector<VoxelPlane> bestPlanes() const;
  /** The same.
   * \param spreads of each plane, rms distance of its points across it, as measured [m]: unlike
   * VoxelPlane::variance it has no floor */
  [[nodiscard]] std::vector<VoxelPlane> bestPlanes(std::vector<float>& spreads) const;
  /** Whether a point can be inserted: finite, and in numbered space. */
  [[nodiscard]] bool accepts(float x, float y, float z) const;

  /** Forgets everything; the options stay. */
  void clear();

  /** Writes and reads all voxels: a map that is read goes on as the one that was written. The
   * options come from the archive too. \exception std::exception corrupt or truncated content; the
   * map is then as it was
   * \param counts_views the archive knows which points are of new views; those of version 0.1 take
   * all points for such */
  void writeTo(mrpt::serialization::CArchive& out) const;
  void readFrom(mrpt::serialization::CArchive& in, bool counts_views = true);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fastlio
