// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// match() must not touch the heap, and a map that moves along must not grow: this program counts
// every allocation.

#include "allocation_counter.h"
#include "surface_map_test_tools.h"
#include <fastlio/map/knn_surface_map.h>
#include <fastlio/map/voxel_plane_map.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
void expectMatchAllocatesNothing(SurfaceMap& map)
{
  const WorldPoints points = worldPoints(roomCloud(1, 20000));
  std::size_t before = allocationCount();
  map.insert(points, Vec3::Zero());
  ASSERT_GT(allocationCount(), before) << "the counter does not count";
  std::vector<PlaneMatch> matches(points.size());
  before = allocationCount();
  map.match(points, Vec3::Zero(), 0, points.size(), matches);
  EXPECT_EQ(allocationCount(), before);
}

/** Ground and two walls 10 m around a vehicle that has come to x. */
WorldPoints street(double x, unsigned seed)
{
  std::mt19937 rng(seed);
  std::uniform_real_distribution<float> u(-1, 1);
  Cloud cloud;
  for (int i = 0; i < 3000; ++i)
  {
    const float along = float(x) + 20 * u(rng), side = u(rng) > 0 ? 10.0F : -10.0F;
    if (i % 2 == 0)
      cloud.add({along, 10 * u(rng), -1.5F});
    else
      cloud.add({along, side, 3 * u(rng)});
  }
  return worldPoints(cloud);
}

void expectNoMoreMemoryAfterALongDrive(SurfaceMap& map)
{
  std::size_t bytes_in_first_km = 0, points_in_first_km = 0;
  for (int i = 0; i < 3000; ++i)  // metres
  {
    const Vec3 position(i, 0.0, 0.0);
    map.insert(street(i, static_cast<unsigned>(i)), position);
    map.removeOutside(position, 40.0);
    if (i >= 1000)
    {
      EXPECT_LE(map.pointCount(), 1.1 * double(points_in_first_km)) << i;
      EXPECT_LE(double(allocatedBytes()), 1.05 * double(bytes_in_first_km)) << i;
      continue;
    }
    bytes_in_first_km = std::max(bytes_in_first_km, allocatedBytes());
    points_in_first_km = std::max(points_in_first_km, map.pointCount());
  }
  EXPECT_GT(points_in_first_km, 10000U);
}
}  // namespace

TEST(KnnSurfaceMap, MatchAllocatesNothing)
{
  KnnSurfaceMap map;
  expectMatchAllocatesNothing(map);
}

TEST(VoxelPlaneMap, MatchAllocatesNothing)
{
  VoxelPlaneMap map{VoxelPlaneOptions{}};
  expectMatchAllocatesNothing(map);
}

TEST(KnnSurfaceMap, HoldsNoMoreMemoryAfterALongDrive)
{
  KnnSurfaceMapOptions options;
  options.min_spacing = 0.2;
  KnnSurfaceMap map(options);
  expectNoMoreMemoryAfterALongDrive(map);
}

TEST(VoxelPlaneMap, HoldsNoMoreMemoryAfterALongDrive)
{
  VoxelPlaneMap map{VoxelPlaneOptions{}};
  expectNoMoreMemoryAfterALongDrive(map);
}
