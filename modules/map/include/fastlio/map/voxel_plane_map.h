// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file voxel_plane_map.h A map of planes at several scales: association is one lookup per scale.
 */
#pragma once

#include <fastlio/map/surface_map.h>

#include <tsl/robin_map.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace fastlio
{
/** Options of VoxelPlaneMap. */
struct VoxelPlaneOptions
{
  double voxel_size = 0.4;     //!< edge of the finest voxels [m]
  int levels = 3;              //!< scales, each twice as coarse as the one before
  double point_noise = 0.02;   //!< least standard deviation of a point across its plane [m]
  double max_thickness = 0.1;  //!< largest standard deviation across a plane [m]
  int min_points = 6;          //!< fewer points give no plane
  double min_incidence = 0.1;  //!< least cosine between normal and mean beam
};

/** Sums over the points of one voxel and the plane fitted to them. */
struct PlaneVoxel
{
  // The plane: first cache line, the only one that match() reads.
  float nx = 0, ny = 0, nz = 0, d = 0;  //!< n . p + d = 0
  float qx = 0, qy = 0, qz = 0;         //!< centroid [m]
  float variance = -1;  //!< across the plane, of one point [m^2]; negative: no plane
  float inverse_count = 0;
  std::array<float, 6> leverage{};  //!< symmetric, xx xy xz yy yz zz [1/m^2]
  float fitted_count = 0;           //!< count at the last fit
  // The sums, relative to the voxel's centre.
  float count = 0;
  std::array<float, 3> sum{};
  std::array<float, 6> products{};
  std::array<float, 3> beams{};  //!< sum of the unit vectors from the sensor to the points
  std::uint64_t key = 0;
};

/** Spreads the bits of a voxel key over the hash. */
struct VoxelKeyHash
{
  std::size_t operator()(std::uint64_t key) const
  {
    key *= 0x9E3779B97F4A7C15ULL;
    return static_cast<std::size_t>(key ^ (key >> 32U));
  }
};

/** Planes by incremental sums in cubic voxels of several sizes. */
class VoxelPlaneMap : public SurfaceMap
{
 public:
  explicit VoxelPlaneMap(const VoxelPlaneOptions& options);

  void match(
      const WorldPoints& points, std::size_t first, std::size_t last,
      std::vector<PlaneMatch>& matches) const override;
  void insert(const WorldPoints& points, const Vec3& sensor_origin) override;
  void removeOutside(const Vec3& center, double radius) override;
  [[nodiscard]] std::size_t pointCount() const override;
  [[nodiscard]] mrpt::maps::CSimplePointsMap::Ptr toPointsMap() const override;

 private:
  struct Level
  {
    float size = 0, inverse_size = 0;
    tsl::robin_map<std::uint64_t, std::uint32_t, VoxelKeyHash> index;
    std::vector<PlaneVoxel> voxels;
    std::vector<std::uint32_t> dirty;
  };

  void insertPoint(Level& level, const Eigen::Vector3f& p, const Eigen::Vector3f& beam);
  void refit(Level& level);

  VoxelPlaneOptions options_;
  std::vector<Level> levels_;
};

}  // namespace fastlio
