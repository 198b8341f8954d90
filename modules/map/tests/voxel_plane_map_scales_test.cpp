// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Blocks, slots and hashing against plain voxel grids of the three sizes.

#include "surface_map_test_tools.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
/** Voxels of one scale, found by sorting all points into cells. */
class BruteForceScale
{
 public:
  BruteForceScale(const Cloud& cloud, float size, const PlaneRules& rules) : size_(size)
  {
    for (const Xyz& p : cloud.points)
    {
      const Eigen::Vector3f point(p.x, p.y, p.z);
      cells_[cellOf(p)].add(point - centerOf(p), point.normalized());
    }
    for (auto& [cell, voxel] : cells_)
    {
      const auto [x, y, z] = cell;
      const Eigen::Vector3f corner{float(x), float(y), float(z)};
      voxel.fit(size * (corner + Eigen::Vector3f::Constant(0.5F)), rules, 1);
    }
  }

  [[nodiscard]] VoxelPlane planeAt(const Xyz& p) const
  {
    const auto it = cells_.find(cellOf(p));
    return it == cells_.end() ? VoxelPlane{} : it->second.plane();
  }
  [[nodiscard]] std::size_t count() const { return cells_.size(); }

 private:
  using Cell = std::tuple<int, int, int>;
  [[nodiscard]] Cell cellOf(const Xyz& p) const
  {
    const auto axis = [this](float v) { return int(std::floor(double(v) / double(size_))); };
    return {axis(p.x), axis(p.y), axis(p.z)};
  }
  [[nodiscard]] Eigen::Vector3f centerOf(const Xyz& p) const
  {
    const auto [x, y, z] = cellOf(p);
    return size_ *
           (Eigen::Vector3f(float(x), float(y), float(z)) + Eigen::Vector3f::Constant(0.5F));
  }

  float size_;
  std::map<Cell, PlaneVoxel> cells_;
};

struct Expected
{
  VoxelPlane plane;
  float variance = -1;
};

/** The plane of three scales with the least variance at the point. */
Expected bestOf(const std::vector<BruteForceScale>& scales, const Xyz& p)
{
  Expected best;
  for (const BruteForceScale& scale : scales)
  {
    const VoxelPlane plane = scale.planeAt(p);
    if (!plane.valid()) continue;
    const float variance = plane.offsetVariance(p.x, p.y, p.z) + plane.roughness;
    if (best.variance < 0 || variance < best.variance) best = {plane, variance};
  }
  return best;
}
}  // namespace

TEST(VoxelPlaneMap, EqualsThreeVoxelGridsAndTakesTheBestScale)
{
  // A room around the origin: both signs of all coordinates, walls, edges and corners.
  const VoxelPlaneOptions options = halfMetre();
  const Cloud cloud = roomCloud(1, 60000);
  VoxelPlaneMap map(options);
  map.insert(worldPoints(cloud), Vec3::Zero());
  std::vector<BruteForceScale> scales;
  for (const float factor : {1.0F, 2.0F, 4.0F})
    scales.emplace_back(cloud, factor * kSize, options.rules);
  EXPECT_EQ(map.pointCount(), scales.front().count());

  const Cloud queries = roomCloud(2, 5000);
  const auto matches = matchAll(map, worldPoints(queries), Vec3::Zero());
  std::size_t valid = 0;
  for (std::size_t i = 0; i < queries.size(); ++i)
  {
    const Expected best = bestOf(scales, queries.points[i]);
    ASSERT_EQ(matches[i].valid(), best.variance >= 0) << i;
    if (!matches[i].valid()) continue;
    ++valid;
    // A difference of larger numbers, which fused multiply-adds round differently.
    EXPECT_NEAR(matches[i].variance, best.variance, 1e-10F);
    EXPECT_FLOAT_EQ(matches[i].nx, best.plane.nx);
    EXPECT_FLOAT_EQ(matches[i].ny, best.plane.ny);
    EXPECT_FLOAT_EQ(matches[i].nz, best.plane.nz);
    EXPECT_FLOAT_EQ(matches[i].d, best.plane.offset());
    EXPECT_LE(matches[i].shared_variance, matches[i].variance + 1e-9F);
  }
  EXPECT_GT(valid, queries.size() * 8 / 10);
}

TEST(VoxelPlaneMap, PointsOnAFaceBelongToTheVoxelAbove)
{
  // Rounding towards zero would give those around the origin one voxel, and whole negative numbers
  // rounded down by one too many would shift theirs.
  for (const float inside : {0.0F, 0.01F, 0.49F})
  {
    VoxelPlaneMap map(halfMetre());
    Cloud cloud;
    for (int i = -5; i <= 5; ++i)
      cloud.add({kSize * float(i), kSize * float(-i), kSize * float(i) + inside * kSize});
    map.insert(worldPoints(cloud), {0.0, 0.0, 3.0});
    EXPECT_EQ(map.pointCount(), 11U);
    for (const Xyz& p : cloud.points)
      map.insert(worldPoints({{p.x + 0.5F * kSize, p.y + 0.5F * kSize, p.z}}), {0.0, 0.0, 3.0});
    EXPECT_EQ(map.pointCount(), 11U) << "the middles of the same voxels";
  }
}
