// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The incremental map behind MRPT's interfaces: what changes points by inheritance, what inserts
// observations, and what searches neighbours by MRPT's names.

#include "map_test_tools.h"
#include <fastlio/map/incremental_points_map.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPose3D.h>

#include <functional>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
using Map = CIncrementalPointsMap;
using Base = mrpt::maps::CPointsMap;

/** A way to change points that the incremental map does not provide itself. */
struct InheritedChange
{
  const char* name;
  std::function<void(Map&)> apply;
};

std::vector<InheritedChange> inheritedChanges()
{
  const auto other = std::make_shared<mrpt::maps::CSimplePointsMap>();
  for (int i = 0; i < 200; ++i)
    other->insertPoint(0.1F * float(i), 3.0F, -1.0F);
  const mrpt::poses::CPose3D pose(1, 2, 3, 0.4, 0.5, 0.6);

  return {
      {"insertPoint", [](Map& m) { m.insertPoint(0.1F, 0.2F, 0.3F); }},
      {"insertPointFast", [](Map& m) { m.insertPointFast(0.1F, 0.2F, 0.3F); }},
      {"setPoint", [](Map& m) { m.setPoint(7, 0.1F, 0.2F, 0.3F); }},
      {"setPoint by base", [](Map& m) { static_cast<Base&>(m).setPoint(7, 0.1F, 0.2F, 0.3F); }},
      {"setPointFast + mark",
       [](Map& m)
       {
         m.setPointFast(7, 0, 0, 0);
         m.mark_as_modified();
       }},
      {"setPointFast + mark by base",
       [](Map& m)
       {
         m.setPointFast(7, 0, 0, 0);
         static_cast<Base&>(m).mark_as_modified();
       }},
      {"resize", [](Map& m) { m.resize(100); }},
      {"resize larger", [](Map& m) { m.resize(5000); }},
      {"setSize", [](Map& m) { m.setSize(10); }},
      {"clear", [](Map& m) { m.clear(); }},
      {"change frame", [=](Map& m) { m.changeCoordinatesReference(pose); }},
      {"change frame, then read the caches",
       [=](Map& m)
       {
         static_cast<Base&>(m).changeCoordinatesReference(pose);
         (void)m.boundingBox();
         (void)m.getLargestDistanceFromOrigin();
       }},
      {"copy in frame", [=](Map& m) { m.changeCoordinatesReference(*other, pose); }},
      {"insertAnotherMap", [=](Map& m) { m.insertAnotherMap(other.get(), pose); }},
      {"assign a points map", [=](Map& m) { m = *other; }},
      {"assign by base", [=](Map& m) { static_cast<Base&>(m) = *other; }},
      {"fuseWith",
       [=](Map& m)
       {
         auto copy = *other;
         m.fuseWith(&copy, 0.5F);
       }},
      {"setAllPoints",
       [](Map& m)
       {
         const std::vector<float> v{1, 2, 3};
         m.setAllPoints(v, v, v);
       }},
  };
}
}  // namespace

TEST(IncrementalPointsMap, NoticesEveryInheritedWayToChangePoints)
{
  for (const auto& [name, change] : inheritedChanges())
  {
    Map map(options(0.8, 0.0));
    insertAll(map, randomCloud(12, 1000, 3.0F));
    ASSERT_TRUE(map.indexIsCurrent());
    change(map);
    SCOPED_TRACE(name);
    expectExactQueries(map, 13, 4.0F);  // whether the index is stale or not
    map.ensureIndex();
    ASSERT_TRUE(map.indexIsCurrent());
    expectExactQueries(map, 14, 4.0F);
    change(map);
    insertAll(map, randomCloud(15, 100, 3.0F));
    ASSERT_TRUE(map.indexIsCurrent());
    expectExactQueries(map, 16, 4.0F);
    change(map);
    map.removeOutside(0, 0, 0, 2.0);
    expectExactQueries(map, 17, 4.0F);
  }
}

TEST(IncrementalPointsMap, ConstQueriesLeaveAStaleIndexAlone)
{
  CIncrementalPointsMap map(options(0.8, 0.0));
  insertAll(map, randomCloud(18, 500, 3.0F));
  map.insertPoint(0.0F, 0.0F, 0.0F);
  const CIncrementalPointsMap& constant = map;
  EXPECT_EQ(constant.nearest(0, 0, 0, 1)[0].point_index, 500U);
  EXPECT_FALSE(map.indexIsCurrent());
  constant.nn_prepare_for_3d_queries();
  EXPECT_TRUE(map.indexIsCurrent());
}

TEST(IncrementalPointsMap, InsertedObservationsKeepTheSpacing)
{
  CIncrementalPointsMap map(options(1.0, 0.5));
  insertAll(map, Cloud{{5, 5, 5}});
  mrpt::obs::CObservationPointCloud observation;
  observation.pointcloud = mrpt::maps::CSimplePointsMap::Create();
  for (int i = 0; i < 100; ++i)
    observation.pointcloud->insertPoint(0.1F * float(i), 0, 0);
  ASSERT_TRUE(map.insertObservation(observation));
  EXPECT_EQ(map.size(), 21U);
  EXPECT_TRUE(map.indexIsCurrent());
  expectExactQueries(map, 21, 6.0F);
}

TEST(IncrementalPointsMap, MrptNeighborMethodsAgreeWithBruteForce)
{
  CIncrementalPointsMap map(options(0.7, 0.0));
  insertAll(map, randomCloud(22, 2000, 4.0F));
  EXPECT_TRUE(map.nn_has_indices_or_ids());
  EXPECT_EQ(map.nn_index_count(), map.size());
  std::vector<mrpt::math::TPoint3Df> points;
  std::vector<float> distances;
  std::vector<std::uint64_t> indices;
  for (const Xyz& q : randomCloud(23, 50, 5.0F).points)
  {
    mrpt::math::TPoint3Df single;
    float single_sqr = 0;
    std::uint64_t single_index = 0;
    ASSERT_TRUE(map.nn_single_search({q.x, q.y, q.z}, single, single_sqr, single_index));
    map.nn_multiple_search({q.x, q.y, q.z}, 100, points, distances, indices);
    ASSERT_TRUE(sameColumns(map, points, distances, indices, bruteForce(map, q, 100, 1e9)));
    EXPECT_EQ(single_index, indices[0]);
    EXPECT_EQ(single_sqr, distances[0]);
    map.nn_radius_search({q.x, q.y, q.z}, 4.0F, points, distances, indices);
    ASSERT_TRUE(sameColumns(map, points, distances, indices, bruteForce(map, q, 5000, 2.0)));
    map.nn_radius_search({q.x, q.y, q.z}, 4.0F, points, distances, indices, 7);
    ASSERT_LE(points.size(), 7U);
  }
  map.nn_multiple_search({0, 0, 0}, 5000, points, distances, indices);
  EXPECT_EQ(points.size(), map.size());
}

TEST(IncrementalPointsMap, PlanarNeighborMethodsIgnoreHeight)
{
  CIncrementalPointsMap map(options(0.7, 0.0));
  insertAll(map, Cloud{{0, 0, 50}, {1, 0, 0}, {3, 0, -7}});
  map.nn_prepare_for_2d_queries();
  mrpt::math::TPoint2Df single;
  float single_sqr = 0;
  std::uint64_t index = 9;
  ASSERT_TRUE(map.nn_single_search(mrpt::math::TPoint2Df(0.1F, 0), single, single_sqr, index));
  EXPECT_EQ(index, 0U);
  std::vector<mrpt::math::TPoint2Df> points;
  std::vector<float> distances;
  std::vector<std::uint64_t> indices;
  map.nn_multiple_search(mrpt::math::TPoint2Df(0.1F, 0), 2, points, distances, indices);
  EXPECT_EQ(indices, (std::vector<std::uint64_t>{0, 1}));
  map.nn_radius_search(mrpt::math::TPoint2Df(3, 0), 0.25F, points, distances, indices, 0);
  EXPECT_EQ(indices, (std::vector<std::uint64_t>{2}));
  // 3D queries do not depend on which kd-tree was built last.
  EXPECT_EQ(map.nearest(0, 0, 0, 1)[0].point_index, 1U);
}
