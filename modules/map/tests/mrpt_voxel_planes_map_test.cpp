// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The map of planes behind MRPT's interfaces: observations, removal, neighbours, likelihood, views.

#include "surface_map_test_tools.h"
#include <fastlio/map/mrpt_voxel_planes_map.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <mrpt/poses/CPose3D.h>

#include <limits>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
mrpt::obs::CObservationPointCloud cloudObservation(const Cloud& cloud)
{
  mrpt::obs::CObservationPointCloud observation;
  observation.pointcloud = mrpt::maps::CSimplePointsMap::Create();
  for (const Xyz& p : cloud.points)
    observation.pointcloud->insertPoint(p.x, p.y, p.z);
  return observation;
}

/** A floor of 8 m x 8 m at a height, in the middle of its finest voxels. */
Cloud floorAt(float height, float x0 = 0.0F)
{
  std::mt19937 rng(3);
  std::uniform_real_distribution<float> u(-4, 4);
  Cloud cloud;
  for (int i = 0; i < 4000; ++i)
    cloud.add({x0 + u(rng), u(rng), height});
  return cloud;
}

CVoxelPlanesMap roomMap(unsigned seed = 1)
{
  CVoxelPlanesMap map;
  map.insertPoints(worldPoints(roomCloud(seed, 5000)), Vec3::Zero());
  return map;
}
}  // namespace

TEST(VoxelPlanesMap, InsertsObservationsWhereTheSensorWas)
{
  auto observation = cloudObservation(floorAt(-1.0F));
  observation.sensorPose = mrpt::poses::CPose3D(0, 0, 0.5, 0.3, 0, 0);
  CVoxelPlanesMap map;
  ASSERT_TRUE(map.insertObservation(observation, mrpt::poses::CPose3D(20, 0, 3, 0, 0, 0)));
  const PlaneMatch m = matchOne(map.planes(), {20.3F, 0.4F, 2.5F});
  ASSERT_TRUE(m.valid());
  EXPECT_NEAR(std::abs(m.nz), 1.0F, 1e-3F);
  EXPECT_NEAR(residual(m, {20.3F, 0.4F, 2.5F}), 0.0F, 1e-3F);
  EXPECT_FALSE(matchOne(map.planes(), {0.3F, 0.4F, -1.0F}).valid());
}

TEST(VoxelPlanesMap, InsertsWhatMrptMakesPointsOf)
{
  mrpt::obs::CObservation2DRangeScan scan;
  scan.aperture = 3.0F;
  scan.maxRange = 50.0F;
  scan.resizeScanAndAssign(181, 10.0F, true);
  CVoxelPlanesMap map;
  ASSERT_TRUE(map.insertObservation(scan, mrpt::poses::CPose3D(0, 0, 1, 0, 0, 0)));
  EXPECT_GT(map.points().size(), 10U);
  EXPECT_NEAR(map.boundingBox().max.x, 10.0F, 0.3F);
  EXPECT_FALSE(map.insertObservation(mrpt::obs::CObservationIMU()));
}

TEST(VoxelPlanesMap, LeavesOutWhatIsNoPlace)
{
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  WorldPoints points;
  points.x = {1.0F, kNan, 1.0F, 3e30F, std::numeric_limits<float>::infinity()};
  points.y = {1.0F, 1.0F, kNan, 1.0F, 1.0F};
  points.z = {1.0F, 1.0F, 1.0F, 1.0F, 1.0F};
  CVoxelPlanesMap map;
  EXPECT_EQ(map.insertPoints(points, Vec3::Zero()), 1U);
  EXPECT_EQ(map.points().size(), 1U);
}

TEST(VoxelPlanesMap, DropsWhatIsOutsideAtOnce)
{
  CVoxelPlanesMap map;
  for (int i = 0; i < 20; ++i)
    map.insertPoints(worldPoints(floorAt(0.2F, 8.0F * float(i))), {8.0 * i, 0.0, 2.0});
  map.removeOutside({0.0, 0.0, 0.0}, 20.0);
  const auto box = map.boundingBox();
  EXPECT_LT(box.max.x, 24.0F);
  EXPECT_LT(box.min.x, -3.5F);
  ASSERT_TRUE(matchOne(map.planes(), {16.0F, 0.0F, 0.2F}).valid());
}

TEST(VoxelPlanesMap, MayFollowTheSensor)
{
  CVoxelPlanesMap map;
  map.insertionOptions.radius = 15.0;
  for (int i = 0; i < 20; ++i)
    map.insertObservation(
        cloudObservation(floorAt(-1.0F)), mrpt::poses::CPose3D(4.0 * i, 0, 0, 0, 0, 0));
  EXPECT_GT(map.boundingBox().min.x, 76.0F - 18.0F);
  EXPECT_GT(map.boundingBox().max.x, 76.0F + 3.5F);
}

TEST(VoxelPlanesMap, NeighborsAreExactAndFollowChanges)
{
  CVoxelPlanesMap map = roomMap();
  std::vector<mrpt::math::TPoint3Df> points;
  std::vector<float> distances;
  std::vector<std::uint64_t> indices;
  for (int round = 0; round < 3; ++round)
  {
    EXPECT_EQ(map.nn_index_count(), map.planes().pointCount());
    for (const Xyz& q : randomCloud(23, 30, 6.0F).points)
    {
      map.nn_multiple_search({q.x, q.y, q.z}, 20, points, distances, indices);
      ASSERT_TRUE(sameColumns(
          map.points(), points, distances, indices, bruteForce(map.points(), q, 20, 1e9)));
      map.nn_radius_search({q.x, q.y, q.z}, 4.0F, points, distances, indices);
      ASSERT_TRUE(sameColumns(
          map.points(), points, distances, indices, bruteForce(map.points(), q, 9999, 2.0)));
      map.nn_radius_search({q.x, q.y, q.z}, 4.0F, points, distances, indices, 7);
      ASSERT_TRUE(sameColumns(
          map.points(), points, distances, indices, bruteForce(map.points(), q, 7, 2.0)));
      map.nn_multiple_search({q.x, q.y, q.z}, 0, points, distances, indices);
      ASSERT_TRUE(points.empty() && distances.empty() && indices.empty());
      mrpt::math::TPoint3Df single;
      float distance = 0;
      std::uint64_t index = 0;
      ASSERT_TRUE(map.nn_single_search({q.x, q.y, q.z}, single, distance, index));
      ASSERT_EQ(index, bruteForce(map.points(), q, 1, 1e9)[0].point_index);
    }
    map.insertPoints(worldPoints(randomCloud(unsigned(round), 500, 5.0F)), Vec3::Zero());
  }
  map.clear();
  EXPECT_TRUE(map.isEmpty());
  EXPECT_EQ(map.nn_index_count(), 0U);
}

#if FASTLIO_MRPT_HAS_NN_INTERFACE
TEST(VoxelPlanesMap, PlanarNeighborsIgnoreHeight)
{
  CVoxelPlanesMap map;
  map.insertPoints(worldPoints(Cloud{{0, 0, 50}, {1, 0, 0}, {3, 0, -7}}), Vec3::Zero());
  map.nn_prepare_for_2d_queries();
  mrpt::math::TPoint2Df single;
  float distance = 0;
  std::uint64_t index = 0;
  ASSERT_TRUE(map.nn_single_search(mrpt::math::TPoint2Df(0.1F, 0), single, distance, index));
  EXPECT_NEAR(single.x, 0.0F, 1e-6F);
  EXPECT_NEAR(distance, 0.01F, 1e-5F);
}
#endif

TEST(VoxelPlanesMap, TheTruePoseIsTheLikeliest)
{
  const CVoxelPlanesMap map = roomMap();
  const auto observation = cloudObservation(roomCloud(2, 2000));
  ASSERT_TRUE(map.canComputeObservationLikelihood(observation));
  const auto likelihood = [&](double x)
  { return map.computeObservationLikelihood(observation, mrpt::poses::CPose3D(x, 0, 0, 0, 0, 0)); };
  EXPECT_GT(likelihood(0.0), likelihood(0.5));
  EXPECT_GT(likelihood(0.0), likelihood(-0.5));
  mrpt::maps::TMatchingRatioParams params;
  params.maxDistForCorr = 0.3F;
  const CVoxelPlanesMap same = roomMap(4);
  const float near = map.compute3DMatchingRatio(&same.points(), {}, params);
  const float far =
      map.compute3DMatchingRatio(&same.points(), mrpt::poses::CPose3D(50, 0, 0, 0, 0, 0), params);
  EXPECT_GT(near, 0.3F);
  EXPECT_LT(far, 0.1F * near);
}

TEST(VoxelPlanesMap, ViewHoldsPointsAndRectanglesOnTheSurface)
{
  CVoxelPlanesMap map;
  map.insertPoints(worldPoints(floorAt(0.2F)), {0.0, 0.0, 3.0});
  mrpt::opengl::CSetOfObjects scene;
  map.getVisualizationInto(scene);
  const auto points = scene.getByClass<mrpt::opengl::CPointCloud>();
  ASSERT_TRUE(points);
  EXPECT_EQ(points->size(), map.points().size());
  const auto planes = scene.getByClass<mrpt::opengl::CSetOfTriangles>();
  ASSERT_TRUE(planes);
  EXPECT_EQ(planes->getTrianglesCount(), 2 * map.planes().bestPlanes().size());
  const auto box = planes->getBoundingBox();
  EXPECT_NEAR(box.min.z, 0.2, 1e-3);
  EXPECT_NEAR(box.max.z, 0.2, 1e-3);
  // Blocks of 1.6 m: the rectangles cover the floor and not much more.
  EXPECT_NEAR(box.max.x, 4.0, 0.3);
  EXPECT_NEAR(box.min.y, -4.0, 0.3);

  map.renderOptions.planes = false;
  mrpt::opengl::CSetOfObjects without_planes;
  map.getVisualizationInto(without_planes);
  EXPECT_FALSE(without_planes.getByClass<mrpt::opengl::CSetOfTriangles>());
}
