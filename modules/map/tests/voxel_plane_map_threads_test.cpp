// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Insertion by several threads makes the same map, to the bit and to the number of each plane.

#include "surface_map_test_tools.h"
#include <fastlio/map/voxel_plane_map.h>

#include <gtest/gtest.h>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
/** A walk with removal behind it, so that blocks and voxels are used again. */
void walk(VoxelPlaneMap& map)
{
  for (unsigned i = 0; i < 30; ++i)
  {
    WorldPoints points = worldPoints(roomCloud(i, 1000 + 37 * i));
    for (float& x : points.x)
      x += float(i);
    map.insert(points, {double(i), 0.0, 0.0});
    map.removeOutside({double(i), 0.0, 0.0}, 8.0);
  }
}

std::vector<PlaneMatch> matchesOf(const VoxelPlaneMap& map, const WorldPoints& points)
{
  std::vector<PlaneMatch> matches(points.size());
  map.match(points, Vec3::Zero(), 0, points.size(), matches);
  return matches;
}

bool sameBits(const PlaneMatch& a, const PlaneMatch& b)
{
  return a.nx == b.nx && a.ny == b.ny && a.nz == b.nz && a.d == b.d && a.variance == b.variance &&
         a.shared_variance == b.shared_variance && a.plane == b.plane &&
         a.created_insertion == b.created_insertion;
}
}  // namespace

TEST(VoxelPlaneMap, IsTheSameWhoeverInsertsIt)
{
  VoxelPlaneMap serial(VoxelPlaneOptions{});
  walk(serial);
  WorldPoints queries = worldPoints(roomCloud(99, 5000));
  for (float& x : queries.x)
    x += 29.0F;
  const auto expected = matchesOf(serial, queries);
  std::size_t valid = 0;
  for (const PlaneMatch& m : expected)
    valid += m.valid() ? 1 : 0;
  ASSERT_GT(valid, 1000U);
  for (const int threads : {2, 3, 5})
  {
    VoxelPlaneMap map(VoxelPlaneOptions{}, std::make_shared<const Workers>(threads));
    walk(map);
    EXPECT_EQ(map.pointCount(), serial.pointCount());
    const auto matches = matchesOf(map, queries);
    for (std::size_t i = 0; i < matches.size(); ++i)
      ASSERT_TRUE(sameBits(matches[i], expected[i])) << threads << " threads, point " << i;
  }
}

// A copy is for another run, on another thread: loops of the same workers may not run at once.
TEST(VoxelPlaneMap, ACopyHasWorkersOfItsOwn)
{
  const auto workers = std::make_shared<const Workers>(2),
             others = std::make_shared<const Workers>(2);
  VoxelPlaneMap map(VoxelPlaneOptions{}, workers);
  walk(map);
  VoxelPlaneMap copy(map);
  EXPECT_EQ(workers.use_count(), 2);
  VoxelPlaneMap assigned(VoxelPlaneOptions{}, others);
  assigned = map;
  EXPECT_EQ(workers.use_count(), 2);
  EXPECT_EQ(others.use_count(), 2);
  const VoxelPlaneMap shared(map, others);
  EXPECT_EQ(others.use_count(), 3);
  walk(copy);
  walk(assigned);
  EXPECT_EQ(copy.pointCount(), assigned.pointCount());
}
