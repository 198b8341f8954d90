// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// A sensor that stands repeats its beams: what it says of a plane counts for less.

#include "map_class_tools.h"
#include "plane_patches.h"
#include "surface_map_test_tools.h"
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/map/voxel_plane_map.h>

#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include <cstring>
#include <functional>
#include <string>

using namespace fastlio;
using namespace fastlio::testing;
using mrpt::serialization::archiveFrom;

namespace
{
const Xyz kOnTheFloor{0.1F, 0.2F, 0.25F};

WorldPoints floorSeenOnce()
{
  return worldPoints(patch(0.0F, 0.0F, kOnTheFloor.z, 2.0F, 2000));
}

/** Variance of a plane's offset after ten scans. \param pose of the sensor for each of them */
float varianceAfterTen(const std::function<Pose(int)>& pose)
{
  VoxelPlaneMap map(halfMetre());
  for (int scan = 0; scan < 10; ++scan)
    map.insertFrom(floorSeenOnce(), pose(scan));
  return matchOne(map, kOnTheFloor).variance;
}

Pose standing(int /*scan*/)
{
  return {Mat3::Identity(), Vec3(0.0, 0.0, 2.0)};
}

/** The archive as version 0.1 wrote it, without the counts that know views. */
std::string asOfVersion0(const std::string& archive)
{
  constexpr std::size_t kHeader = 32, kBlock = 9, kVoxel = 125, kTellingCount = 69;
  std::uint32_t blocks = 0;
  std::memcpy(&blocks, archive.data() + kHeader - sizeof(blocks), sizeof(blocks));
  std::string old = archive.substr(0, kHeader);
  std::size_t at = kHeader;
  for (std::uint32_t block = 0; block < blocks; ++block)
  {
    const auto voxels = static_cast<std::uint8_t>(archive[at + kBlock - 1]);
    old += archive.substr(at, kBlock);
    at += kBlock;
    for (std::uint8_t voxel = 0; voxel < voxels; ++voxel, at += kVoxel)
      old += archive.substr(at, kTellingCount) +
             archive.substr(
                 at + kTellingCount + sizeof(float), kVoxel - kTellingCount - sizeof(float));
  }
  EXPECT_EQ(at, archive.size());
  return old;
}
}  // namespace

TEST(MapViews, RepeatedPointsCountLess)
{
  Random random(1);
  PlaneVoxel voxel;
  const TruePlane plane = planeAcross(Vector3d::UnitZ());
  addPatch(voxel, plane, 50, 0.4, 0.01, random);
  for (int i = 0; i < 500; ++i)
  {
    const Vector3d p = plane.at(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4));
    voxel.add(p.cast<float>(), Vector3f::UnitZ(), false);
  }
  voxel.fit(Vector3f::Zero(), rulesWithNoise(0.01), 1);
  EXPECT_EQ(voxel.count(), 550.0F);
  EXPECT_NEAR(voxel.plane().inverse_count, 1.0F / (50.0F + 0.3F * 500.0F), 1e-6F);
}

TEST(MapViews, AVoxelThatOnlyRepeatedViewsHaveSeenIsLessKnown)
{
  Random random(2);
  PlaneVoxel voxel;
  for (int i = 0; i < 100; ++i)
    voxel.add(
        Vector3f(float(random.uniform(-0.4, 0.4)), float(random.uniform(-0.4, 0.4)), 0.0F),
        Vector3f::UnitZ(), false);
  voxel.fit(Vector3f::Zero(), rulesWithNoise(0.01), 1);
  ASSERT_TRUE(voxel.plane().valid());
  EXPECT_NEAR(voxel.plane().inverse_count, 1.0F / 30.0F, 1e-6F);
}

TEST(MapViews, StandingAddsLessThanMovingAndTurning)
{
  const float stands = varianceAfterTen(standing);
  const auto trembles = [](int scan)
  {
    const double sign = scan % 2 == 0 ? 1.0 : -1.0;
    return Pose{expSO3(Vec3(5e-4 * sign, 0.0, 0.0)), Vec3(0.0, 0.0, 2.0 + 0.004 * sign)};
  };
  EXPECT_NEAR(varianceAfterTen(trembles) / stands, 1.0, 1e-3) << "as poses at rest do";
  const auto moves = [](int scan) { return Pose{Mat3::Identity(), Vec3(0.1 * scan, 0.0, 2.0)}; };
  EXPECT_LT(varianceAfterTen(moves), 0.6F * stands);
  const auto turns = [](int scan) {
    return Pose{expSO3(Vec3(0.0, 0.0, 0.05 * scan)), Vec3(0.0, 0.0, 2.0)};
  };
  EXPECT_LT(varianceAfterTen(turns), 0.6F * stands);
  const auto creeps = [](int scan) { return Pose{Mat3::Identity(), Vec3(0.008 * scan, 0.0, 2.0)}; };
  EXPECT_LT(varianceAfterTen(creeps), 0.9F * stands) << "small steps add up";
}

TEST(MapViews, WhoSaysNothingOfItsAttitudeHasANewViewEachTime)
{
  VoxelPlaneMap map(halfMetre());
  for (int scan = 0; scan < 10; ++scan)
    map.insert(floorSeenOnce(), Vec3(0.0, 0.0, 2.0));
  EXPECT_LT(matchOne(map, kOnTheFloor).variance, 0.6F * varianceAfterTen(standing));
}

TEST(MapViews, AnArchiveGoesOnAsTheMapThatWasWritten)
{
  VoxelPlaneMap written(halfMetre()), read(halfMetre());
  for (int scan = 0; scan < 10; ++scan)
    written.insertFrom(floorSeenOnce(), standing(scan));
  mrpt::io::CMemoryStream stream;
  auto archive = archiveFrom(stream);
  written.writeTo(archive);
  stream.Seek(0);
  read.readFrom(archive);
  const WorldPoints more = worldPoints(patch(0.0F, 0.0F, kOnTheFloor.z, 2.0F, 9000));
  for (VoxelPlaneMap* map : {&written, &read})
    map->insert(more, Vec3(1.0, 0.0, 2.0));
  EXPECT_EQ(matchOne(read, kOnTheFloor).variance, matchOne(written, kOnTheFloor).variance);
}

TEST(MapViews, ArchivesOfVersion01AreRead)
{
  VoxelPlaneMap written(halfMetre()), read(halfMetre());
  for (int scan = 0; scan < 3; ++scan)
    written.insert(floorSeenOnce(), Vec3(0.0, 0.0, 2.0));
  mrpt::io::CMemoryStream stream;
  auto archive = archiveFrom(stream);
  written.writeTo(archive);
  const std::string old = asOfVersion0(
      {static_cast<const char*>(stream.getRawBufferData()),
       static_cast<std::size_t>(stream.getTotalBytesCount())});
  mrpt::io::CMemoryStream old_stream(old.data(), old.size());
  auto old_archive = archiveFrom(old_stream);
  read.readFrom(old_archive, false);
  EXPECT_EQ(read.pointCount(), written.pointCount());
  EXPECT_EQ(matchOne(read, kOnTheFloor).variance, matchOne(written, kOnTheFloor).variance);
}
