// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The incremental map behind MRPT's interfaces: what changes points by inheritance, and what
// inserts observations.

#include "map_test_tools.h"
#include <fastlio/pointmap/incremental_points_map.h>

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
      {"move a point inside, then read the caches",
       [](Map& m)
       {
         m.setPoint(7, 0.1F, 0.2F, 0.3F);
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
    Map map;
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
  CIncrementalPointsMap map;
  insertAll(map, randomCloud(18, 500, 3.0F));
  map.insertPoint(0.0F, 0.0F, 0.0F);
  const CIncrementalPointsMap& constant = map;
  EXPECT_EQ(constant.nearest(0, 0, 0, 1)[0].point_index, 500U);
  EXPECT_FALSE(map.indexIsCurrent());
  EXPECT_EQ(constant.nearest(0, 0, 0, 1)[0].point_index, 500U);
  map.ensureIndex();
  EXPECT_TRUE(map.indexIsCurrent());
}

TEST(IncrementalPointsMap, InsertedObservationsKeepTheSpacing)
{
  CIncrementalPointsMap map(0.5);
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
