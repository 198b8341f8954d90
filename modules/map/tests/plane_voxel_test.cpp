// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "plane_patches.h"
#include <fastlio/map/plane_fit.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace fastlio;
using namespace fastlio::testing;

TEST(PlaneVoxel, RecoversAnExactPlane)
{
  Random random(1);
  for (int k = 0; k < 200; ++k)
  {
    const Vector3d center(random.uniform(-90, 90), random.uniform(-90, 90), random.uniform(-9, 9));
    const TruePlane plane = planeAcross(random.axis(), random.uniform(-0.2, 0.2));
    PlaneVoxel voxel;
    addPatch(voxel, plane, 50, 0.4, 0.0, random);
    voxel.fit(center.cast<float>(), rulesWithNoise(0.02), 3);
    ASSERT_TRUE(voxel.plane().valid());
    const Vector3d n(voxel.plane().nx, voxel.plane().ny, voxel.plane().nz);
    EXPECT_NEAR(n.norm(), 1.0, 1e-6);
    EXPECT_NEAR(std::abs(n.dot(plane.n)), 1.0, 1e-6);
    EXPECT_NEAR(distanceTo(voxel.plane(), center + plane.at(0.1, -0.2)), 0.0, 1e-4);
    EXPECT_EQ(voxel.plane().created_insertion, 3U);
  }
}

TEST(PlaneVoxel, ErrorsAreWhatOffsetVariancePredicts)
{
  // Normalised squared errors at points of the voxel: mean (n-3)/(n-5) of Student's distribution,
  // and few beyond three standard deviations.
  constexpr int kDraws = 6000, kPoints = 40;
  constexpr double kNoise = 0.02;
  Random random(2);
  double sum = 0.0;
  int beyond = 0;
  for (int k = 0; k < kDraws; ++k)
  {
    const TruePlane plane = planeAcross(random.axis(), random.uniform(-0.2, 0.2));
    PlaneVoxel voxel;
    addPatch(voxel, plane, kPoints, 0.4, kNoise, random);
    voxel.fit(Vector3f::Zero(), rulesWithNoise(1e-4), 1);
    ASSERT_TRUE(voxel.plane().valid());
    const Vector3d p = plane.at(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4));
    const double error = distanceTo(voxel.plane(), p);
    const Vector3f q = p.cast<float>();
    const double squared =
        error * error / double(voxel.plane().offsetVariance(q.x(), q.y(), q.z()));
    sum += squared;
    beyond += squared > 9.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kDraws, (kPoints - 3.0) / (kPoints - 5.0), 0.1);
  EXPECT_LT(beyond, 0.01 * kDraws);
}

TEST(PlaneVoxel, EstimatesTheScatterAcross)
{
  Random random(3);
  double sum = 0.0;
  for (int k = 0; k < 500; ++k)
  {
    PlaneVoxel voxel;
    addPatch(voxel, planeAcross(random.axis()), 20, 1.0, 0.03, random);
    voxel.fit(Vector3f::Zero(), rulesWithNoise(1e-4), 1);
    ASSERT_TRUE(voxel.plane().valid());
    sum += double(voxel.plane().variance);
  }
  EXPECT_NEAR(sum / 500, 0.03 * 0.03, 0.05 * 0.03 * 0.03);
}

TEST(PlaneVoxel, TrustsNoPlaneBeyondTheSensorsNoise)
{
  Random random(4);
  PlaneVoxel voxel;
  addPatch(voxel, planeAcross(Vector3d::UnitZ()), 10, 0.4, 0.0, random);
  voxel.fit(Vector3f::Zero(), rulesWithNoise(0.02), 1);
  ASSERT_TRUE(voxel.plane().valid());
  EXPECT_FLOAT_EQ(voxel.plane().variance, 0.02F * 0.02F);
  EXPECT_NEAR(voxel.plane().inverse_count, 0.1F, 1e-7F);
}

TEST(PlaneVoxel, IsSurestAtItsCentroidAndLessTheFartherAway)
{
  Random random(5);
  PlaneVoxel voxel;
  addPatch(voxel, planeAcross(Vector3d::UnitZ()), 30, 0.2, 0.01, random);
  voxel.fit({1.0F, 2.0F, 3.0F}, rulesWithNoise(0.01), 1);
  const VoxelPlane& plane = voxel.plane();
  ASSERT_TRUE(plane.valid());
  float previous = plane.variance * plane.inverse_count;
  EXPECT_FLOAT_EQ(plane.offsetVariance(plane.qx, plane.qy, plane.qz), previous);
  for (const float away : {0.1F, 0.3F, 1.0F, 3.0F})
  {
    const float variance = plane.offsetVariance(plane.qx + away, plane.qy - away, plane.qz);
    EXPECT_GT(variance, previous);
    previous = variance;
  }
}

TEST(PlaneVoxel, LosesLittleFarFromTheOrigin)
{
  Random random(6);
  const Vector3d center(4000.25, -3000.75, 120.5);
  const TruePlane plane = planeAcross({1.0, 1.0, 0.3});
  PlaneVoxel voxel;
  addPatch(voxel, plane, 200, 0.4, 0.0, random);
  voxel.fit(center.cast<float>(), rulesWithNoise(0.02), 1);
  ASSERT_TRUE(voxel.plane().valid());
  EXPECT_NEAR(distanceTo(voxel.plane(), center + plane.at(0.3, 0.3)), 0.0, 1e-3);
}

TEST(PlaneVoxel, LeverageIsTheInverseOfTheScatterWithinThePlane)
{
  // Against an eigenvalue decomposition of the points themselves.
  Random random(15);
  for (int k = 0; k < 100; ++k)
  {
    const TruePlane plane = planeAcross(random.axis(), random.uniform(-0.2, 0.2));
    const double length = random.uniform(0.2, 0.8), width = random.uniform(0.2, 0.8);
    PlaneVoxel voxel;
    std::vector<Vector3d> points;
    for (int i = 0; i < 60; ++i)
    {
      const Vector3d p = plane.at(random.uniform(-length, length), random.uniform(-width, width)) +
                         random.normal(0.01) * plane.n;
      points.push_back(p);
      voxel.add(p.cast<float>(), plane.n.cast<float>());
    }
    const auto expected = fitPlane(momentsOf(points.data(), points.size()));
    voxel.fit(Vector3f::Zero(), rulesWithNoise(1e-4), 1);
    const VoxelPlane& fitted = voxel.plane();
    ASSERT_TRUE(expected.has_value() && fitted.valid());
    EXPECT_NEAR(double(fitted.variance), expected->eigenvalues[0] * 60 / 57, 1e-7);
    EXPECT_NEAR(std::abs(expected->normal.dot(Vector3d(fitted.nx, fitted.ny, fitted.nz))), 1, 1e-6);
    const Vector3d p = plane.at(random.uniform(-1, 1), random.uniform(-1, 1));
    const double variance = planeOffsetVariance(*expected, p, expected->eigenvalues[0] * 60 / 57);
    const Vector3f q = p.cast<float>();
    EXPECT_NEAR(
        double(fitted.offsetVariance(q.x(), q.y(), q.z())), variance, 1e-3 * variance + 1e-9);
  }
}
