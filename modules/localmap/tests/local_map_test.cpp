// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/localmap/local_map.h>
#include <fastlio/map/voxel_plane_map.h>

#include <gtest/gtest.h>

#include <memory>

namespace fastlio
{
namespace
{
double finestVoxel(const LocalMap& map)
{
  return dynamic_cast<const VoxelPlaneMap&>(map.surfaces()).options().voxel_size;
}

LocalMap emptyMap(const OdometryOptions& options)
{
  return {options, std::make_shared<const Workers>(1)};
}

DeskewedScan scanOf(bool sparse_lines)
{
  DeskewedScan scan;
  scan.sparse_lines = sparse_lines;
  return scan;
}

void addScan(LocalMap& map)
{
  WorldPoints point;
  point.resize(1);
  point.x[0] = point.y[0] = point.z[0] = 1.0F;
  map.insert(
      scanOf(false), point, InsertionError{}, Pose{}, ScanPoseJacobian::Zero(), Vec3::Zero());
}

TEST(LocalMap, HasWideVoxelsWhereLinesAreSparse)
{
  const OdometryOptions options;
  LocalMap map = emptyMap(options);
  map.prepareFor(scanOf(false), options);
  EXPECT_EQ(finestVoxel(map), 0.4);
  map.prepareFor(scanOf(true), options);
  EXPECT_EQ(finestVoxel(map), 0.8);
}

TEST(LocalMap, HasTheVoxelsThatAreGiven)
{
  OdometryOptions options;
  options.map.voxel_size = 0.3;
  LocalMap map = emptyMap(options);
  map.prepareFor(scanOf(true), options);
  EXPECT_EQ(finestVoxel(map), 0.3);
}

TEST(LocalMap, KeepsItsVoxelsOnceAScanHasJoined)
{
  const OdometryOptions options;
  LocalMap map = emptyMap(options);
  addScan(map);
  map.prepareFor(scanOf(true), options);
  EXPECT_EQ(finestVoxel(map), 0.4);
  EXPECT_FALSE(map.empty());
}

// Before, such scans joined: 112 m of error in place of 2.2 m, a LiDAR that looks ahead in an
// office.
TEST(LocalMap, TakesNoScanWhoseResidualsAreThoseOfAWrongPose)
{
  LocalMap map = emptyMap({});
  while (map.isSparse())
    addScan(map);
  ScanStatistics statistics;
  statistics.points_effective = statistics.points_mapped = 540;
  statistics.usual_inlier_ratio = 0.6;
  statistics.normalized_innovation = 2.0;
  EXPECT_TRUE(map.isConsistent(statistics, 1000));
  statistics.normalized_innovation = 18.5;
  EXPECT_FALSE(map.isConsistent(statistics, 1000));
}
}  // namespace
}  // namespace fastlio
