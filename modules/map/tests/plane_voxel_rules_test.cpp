// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "plane_patches.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fastlio;
using namespace fastlio::testing;

TEST(PlaneVoxel, HasNoPlaneFromTooFewPoints)
{
  Random random(7);
  PlaneRules rules;
  rules.min_points = 6.0F;
  PlaneVoxel voxel;
  addPatch(voxel, planeAcross(Vector3d::UnitX()), 5, 0.4, 0.0, random);
  voxel.fit(Vector3f::Zero(), rules, 1);
  EXPECT_FALSE(voxel.plane().valid());
  addPatch(voxel, planeAcross(Vector3d::UnitX()), 1, 0.4, 0.0, random);
  voxel.fit(Vector3f::Zero(), rules, 2);
  EXPECT_TRUE(voxel.plane().valid());
  EXPECT_EQ(voxel.plane().created_insertion, 1U);
}

// The pose errors of all scans that made it are in the plane, so it counts as made in their midst.
TEST(PlaneVoxel, IsMadeByTheScansSinceTheFirstPoint)
{
  Random random(7);
  PlaneRules rules;
  rules.min_points = 6.0F;
  PlaneVoxel voxel;
  for (std::uint32_t scan = 2; scan <= 7; ++scan)
  {
    EXPECT_FALSE(voxel.plane().valid()) << scan;
    addPatch(voxel, planeAcross(Vector3d::UnitX()), 1, 0.4, 0.0, random);
    voxel.fit(Vector3f::Zero(), rules, scan);
  }
  EXPECT_TRUE(voxel.plane().valid());
  EXPECT_EQ(voxel.plane().created_insertion, 4U);
  addPatch(voxel, planeAcross(Vector3d::UnitX()), 10, 0.4, 0.0, random);
  voxel.fit(Vector3f::Zero(), rules, 20);
  EXPECT_EQ(voxel.plane().created_insertion, 4U) << "the first plane counts";
}

TEST(PlaneVoxel, HasNoPlaneFromALine)
{
  Random random(8);
  for (int k = 0; k < 100; ++k)
  {
    const Vector3d along = random.axis(), beam = along.unitOrthogonal();
    PlaneVoxel voxel;
    for (int i = 0; i < 40; ++i)
    {
      const Vector3d scatter(random.normal(0.01), random.normal(0.01), random.normal(0.01));
      voxel.add((random.uniform(-0.4, 0.4) * along + scatter).cast<float>(), beam.cast<float>());
    }
    voxel.fit(Vector3f::Zero(), rulesWithNoise(0.02), 1);
    EXPECT_FALSE(voxel.plane().valid());
  }
}

TEST(PlaneVoxel, HasNoPlaneFromPointsWithoutExtent)
{
  // Exactly so, where differences of products leave nothing or a rounding error of either sign.
  for (const float min_points : {3.0F, 6.0F})
  {
    PlaneRules rules = rulesWithNoise(0.02);
    rules.min_points = min_points;
    for (const int count : {3, 4, 7, 100})
    {
      PlaneVoxel point, line, far_line;
      for (int i = 0; i < count; ++i)
      {
        const float t = 0.01F * float(i % 7) - 0.03F;
        point.add({0.1F, -0.2F, 0.3F}, {0.0F, 0.0F, 1.0F});
        line.add({t, t, t}, {0.0F, 0.0F, 1.0F});
        far_line.add({0.7F + t, 0.7F, -0.7F}, {0.0F, 0.0F, 1.0F});
      }
      for (PlaneVoxel* voxel : {&point, &line, &far_line})
      {
        voxel->fit(Vector3f::Zero(), rules, 1);
        EXPECT_FALSE(voxel->plane().valid()) << count;
        EXPECT_FALSE(std::isnan(voxel->plane().variance)) << count;
      }
    }
  }
}

TEST(PlaneVoxel, HasNoPlaneFromACornerOrAVolume)
{
  Random random(9);
  PlaneVoxel corner, volume;
  for (int i = 0; i < 300; ++i)
  {
    const auto a = float(random.uniform(-0.2, 0.2)), z = float(random.uniform(-0.2, 0.2));
    corner.add(i % 2 == 0 ? Vector3f(-0.2F, a, z) : Vector3f(a, -0.2F, z), {0.7F, 0.7F, 0.0F});
    const auto c = float(random.uniform(-0.2, 0.2));
    volume.add({a, z, c}, {0.7F, 0.7F, 0.0F});
  }
  corner.fit(Vector3f::Zero(), rulesWithNoise(0.02), 1);
  volume.fit(Vector3f::Zero(), rulesWithNoise(0.02), 1);
  EXPECT_FALSE(corner.plane().valid());
  EXPECT_FALSE(volume.plane().valid());
}

TEST(PlaneVoxel, HasNoPlaneThickerThanAllowed)
{
  PlaneRules rules = rulesWithNoise(0.01);
  rules.max_thickness = 0.05F;
  for (const double noise : {0.03, 0.08})
  {
    Random random(10);
    PlaneVoxel voxel;
    addPatch(voxel, planeAcross({1, 2, 3}), 500, 0.8, noise, random);
    voxel.fit(Vector3f::Zero(), rules, 1);
    EXPECT_EQ(voxel.plane().valid(), noise < 0.05);
  }
}

TEST(PlaneVoxel, OneLaserLineAroundABendIsSeenEdgeOn)
{
  // Points of a level laser line around the corner of a pillar span a level plane, which is not
  // there. It holds the beams; the true plane of a floor does not.
  for (const double beam_height : {0.0, -0.5})
  {
    Random random(11);
    PlaneVoxel voxel;
    for (int i = 0; i < 60; ++i)
    {
      const double a = random.uniform(0.0, 0.4), z = random.normal(0.002);
      const Vector3d p = i % 2 == 0 ? Vector3d(-0.2, a - 0.2, z) : Vector3d(a - 0.2, -0.2, z);
      const Vector3d beam = Vector3d(0.7, 0.7, beam_height).normalized();
      voxel.add(p.cast<float>(), beam.cast<float>());
    }
    voxel.fit(Vector3f::Zero(), rulesWithNoise(0.005), 1);
    EXPECT_EQ(voxel.plane().valid(), beam_height != 0.0);
  }
}

TEST(PlaneVoxel, LosesItsPlaneWhenItTurnsOutToBeNone)
{
  Random random(12);
  PlaneVoxel voxel;
  addPatch(voxel, planeAcross(Vector3d::UnitZ()), 50, 0.4, 0.005, random);
  voxel.fit(Vector3f::Zero(), rulesWithNoise(0.01), 4);
  ASSERT_TRUE(voxel.plane().valid());
  addPatch(voxel, planeAcross(Vector3d::UnitX()), 50, 0.4, 0.005, random);
  voxel.fit(Vector3f::Zero(), rulesWithNoise(0.01), 5);
  EXPECT_FALSE(voxel.plane().valid());
}

TEST(PlaneVoxel, ClaimsARefitOncePerGrowth)
{
  Random random(13);
  PlaneVoxel voxel;
  const TruePlane plane = planeAcross(Vector3d::UnitZ());
  addPatch(voxel, plane, 100, 0.4, 0.01, random);
  EXPECT_TRUE(voxel.claimRefit());
  EXPECT_FALSE(voxel.claimRefit()) << "it is claimed already";
  voxel.fit(Vector3f::Zero(), rulesWithNoise(0.01), 1);
  addPatch(voxel, plane, 5, 0.4, 0.01, random);
  EXPECT_FALSE(voxel.claimRefit()) << "5 % more points change little";
  addPatch(voxel, plane, 10, 0.4, 0.01, random);
  EXPECT_TRUE(voxel.claimRefit());
  voxel.fit(Vector3f::Zero(), rulesWithNoise(0.01), 2);
  EXPECT_EQ(voxel.plane().created_insertion, 1U) << "created by the first fit";
}

TEST(PlaneVoxel, ForgetsOldPointsSlowly)
{
  Random random(14);
  PlaneVoxel voxel;
  const auto learn = [&](double height, int points)
  {
    for (int i = 0; i < points; i += 100)
    {
      addPatch(voxel, planeAcross(Vector3d::UnitZ(), height), 100, 0.4, 0.01, random);
      voxel.fit(Vector3f::Zero(), rulesWithNoise(0.01), 1);
    }
    return distanceTo(voxel.plane(), Vector3d::Zero()) / double(voxel.plane().nz);
  };
  EXPECT_NEAR(learn(0.0, 50000), 0.0, 1e-3);
  EXPECT_LE(voxel.count(), 4200.0F);
  EXPECT_GT(1.0F / voxel.plane().inverse_count, 2000.0F);
  EXPECT_NEAR(learn(0.05, 50000), -0.05, 1e-3);
}
