// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/localmap/saved_map.h>
#include <fastlio/map/voxel_plane_map.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace fastlio
{
namespace
{
void add(WorldPoints& points, double x, double y, double z)
{
  points.x.push_back(static_cast<float>(x));
  points.y.push_back(static_cast<float>(y));
  points.z.push_back(static_cast<float>(z));
}

/** A floor of 1.6 m by 1.6 m, as large as the widest voxel, 5 cm above that voxel's bottom. */
WorldPoints floorPoints()
{
  WorldPoints points;
  for (int i = 0; i < 16; ++i)
    for (int k = 0; k < 16; ++k)
      add(points, 0.05 + 0.1 * i, 0.05 + 0.1 * k, 0.05);
  return points;
}

const Vec3 kAbove(0.7, 0.9, 2.0), kBelow(0.7, 0.9, -2.0);

/** The plane that a map gives for a point; invalid: none. */
PlaneMatch planeAt(
    const VoxelPlaneMap& map, double x, double y, double z, const Vec3& sensor_origin = kAbove)
{
  WorldPoints point;
  add(point, x, y, z);
  std::vector<PlaneMatch> matches(1);
  map.match(point, sensor_origin, 0, 1, matches);
  return matches[0];
}

TEST(InsertSavedPoints, MakesThePlaneOfAFloor)
{
  VoxelPlaneMap map{VoxelPlaneOptions{}};
  insertSavedPoints(floorPoints(), map);
  const PlaneMatch floor = planeAt(map, 0.7, 0.9, 0.06);
  ASSERT_TRUE(floor.valid());
  EXPECT_NEAR(floor.nz, 1.0, 1e-6);
}

// Points do not tell that they are a floor, and not a ceiling.
TEST(InsertSavedPoints, MakesBothSidesOfASurface)
{
  VoxelPlaneMap map{VoxelPlaneOptions{}};
  insertSavedPoints(floorPoints(), map);
  const PlaneMatch ceiling = planeAt(map, 0.7, 0.9, 0.06, kBelow);
  ASSERT_TRUE(ceiling.valid());
  EXPECT_NEAR(ceiling.nz, -1.0, 1e-6);
}

// The bush begins above the voxels of 0.8 m that hold the floor.
TEST(InsertSavedPoints, TakesNoFloorForTheBushAboveIt)
{
  WorldPoints points = floorPoints();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(0.1, 1.5), up(0.85, 1.55);
  for (int i = 0; i < 120; ++i)
    add(points, across(random), across(random), up(random));
  VoxelPlaneMap map{VoxelPlaneOptions{}};
  insertSavedPoints(points, map);
  EXPECT_TRUE(planeAt(map, 0.7, 0.9, 0.06).valid());
  int floors = 0;
  for (std::size_t i = 256; i < points.size(); ++i)
  {
    const PlaneMatch plane = planeAt(
        map, static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
        static_cast<double>(points.z[i]));
    if (plane.valid() && std::abs(plane.nz) > 0.9F && std::abs(plane.d) < 0.2F) ++floors;
  }
  EXPECT_EQ(floors, 0);
}
}  // namespace
}  // namespace fastlio
