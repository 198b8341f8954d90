// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Surfaces that are seen from both sides: a door leaf, a partition, a post.

#include "surface_map_test_tools.h"
#include <fastlio/map/voxel_plane_map.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

using namespace fastlio;
using namespace fastlio::testing;

namespace
{
constexpr float kThickness = 0.04F;  // of the leaf [m]
constexpr float kFront = 0.2F;       // where its front is [m]
const Vec3 kBefore(-3.0, 0.4, 0.4), kBehind(3.5, 0.4, 0.4);

/** Points of a face of the leaf, which is 0.8 m wide and high, as \a sensor sees it. */
WorldPoints face(float x, const Vec3& sensor, unsigned seed = 1)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(0.0, 0.8);
  std::normal_distribution<double> noise(0.0, 0.01);
  WorldPoints points;
  for (int i = 0; i < 400; ++i)
  {
    const Vec3 p(double(x), along(random), along(random));
    points.add(p + noise(random) * (p - sensor).normalized());
  }
  return points;
}

/** Points of a patch of 0.4 m across an axis (0: x, 1: y), in the finest voxel at the origin. */
WorldPoints patchAcross(int axis, float at, const Vec3& sensor)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(0.01, 0.39);
  std::normal_distribution<double> noise(0.0, 0.002);
  WorldPoints points;
  for (int i = 0; i < 200; ++i)
  {
    Vec3 p(along(random), along(random), along(random));
    p[axis] = double(at);
    points.add(p + noise(random) * (p - sensor).normalized());
  }
  return points;
}

/** The map of a sensor that has passed the leaf. */
VoxelPlaneMap mapOfBothSides()
{
  VoxelPlaneMap map{VoxelPlaneOptions{}};
  map.insert(face(kFront, kBefore), kBefore);
  map.insert(face(kFront + kThickness, kBehind, 2), kBehind);
  return map;
}

PlaneMatch seenFrom(const VoxelPlaneMap& map, const Vec3& sensor)
{
  return matchOne(map, {kFront + kThickness / 2, 0.35F, 0.45F}, sensor);
}

/** Where a match has the surface [m]. */
double placeOf(const PlaneMatch& match)
{
  return -double(match.d) / double(match.nx);
}
}  // namespace

TEST(SurfaceSides, ALeafHasTwo)
{
  const VoxelPlaneMap map = mapOfBothSides();
  const PlaneMatch front = seenFrom(map, kBefore), back = seenFrom(map, kBehind);
  ASSERT_TRUE(front.valid() && back.valid());
  EXPECT_NE(front.plane, back.plane);
  EXPECT_LT(front.nx, -0.99F);
  EXPECT_GT(back.nx, 0.99F);
  EXPECT_NEAR(placeOf(front), double(kFront), 0.004);
  EXPECT_NEAR(placeOf(back), double(kFront + kThickness), 0.004);
}

TEST(SurfaceSides, FromBehindASurfaceIsNotTheOneThatIsMapped)
{
  VoxelPlaneMap map{VoxelPlaneOptions{}};
  map.insert(face(kFront, kBefore), kBefore);
  EXPECT_TRUE(seenFrom(map, kBefore).valid());
  EXPECT_FALSE(seenFrom(map, kBehind).valid());
}

// What is seen along a plane may be of either side: its normal is known to a few degrees only.
TEST(SurfaceSides, BeamsAlongAPlaneMeetIt)
{
  VoxelPlaneMap map{VoxelPlaneOptions{}};
  map.insert(face(kFront, kBefore), kBefore);
  EXPECT_TRUE(seenFrom(map, {0.3, -5.0, 0.4}).valid());
}

// All in one finest voxel: two surfaces that have their backs to the sensor, and what it sees
// there.
TEST(SurfaceSides, AThirdSurfaceSpoilsNeither)
{
  VoxelPlaneMap map{VoxelPlaneOptions{}};
  map.insert(patchAcross(0, 0.2F, kBefore), kBefore);
  const Vec3 right(3.0, -4.0, 0.2), left(3.0, 5.0, 0.2);
  map.insert(patchAcross(1, 0.3F, right), right);
  const Xyz front{0.2F, 0.1F, 0.2F}, side{0.3F, 0.3F, 0.2F}, third{0.1F, 0.1F, 0.2F};
  const PlaneMatch of_front = matchOne(map, front, kBefore), of_side = matchOne(map, side, right);
  ASSERT_TRUE(of_front.valid() && of_side.valid());
  map.insert(patchAcross(1, 0.1F, left), left);
  EXPECT_FALSE(matchOne(map, third, left).valid());
  EXPECT_EQ(matchOne(map, front, kBefore).d, of_front.d);
  EXPECT_EQ(matchOne(map, side, right).d, of_side.d);
}

TEST(SurfaceSides, AreBothAmongTheBestPlanes)
{
  int front = 0, back = 0;
  for (const VoxelPlane& plane : mapOfBothSides().bestPlanes())
  {
    front += plane.nx < -0.99F ? 1 : 0;
    back += plane.nx > 0.99F ? 1 : 0;
  }
  EXPECT_GT(front, 0);
  EXPECT_EQ(front, back);
}

TEST(SurfaceSides, AreForgottenTogether)
{
  VoxelPlaneMap map = mapOfBothSides();
  EXPECT_GT(map.pointCount(), 0U);
  for (std::size_t i = 0; i < VoxelPlaneMap::kCallsPerSweep; ++i)
    map.removeOutside({100.0, 0.0, 0.0}, 10.0);
  EXPECT_EQ(map.pointCount(), 0U);
}

TEST(SurfaceSides, TheFacesOfAPostDoNotMix)
{
  VoxelPlaneMap map{VoxelPlaneOptions{}};
  for (unsigned i = 0; i < 10; ++i)
  {
    const Vec3 before(-3.0 + 0.2 * i, 0.4, 0.4), behind(1.2 + 0.2 * i, 0.4, 0.4);
    map.insert(face(kFront, before, i), before);
    map.insert(face(kFront + 0.06F, behind, 10 + i), behind);
  }
  const PlaneMatch front = seenFrom(map, kBefore);
  ASSERT_TRUE(front.valid());
  EXPECT_NEAR(placeOf(front), double(kFront), 0.002);
}
