// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "surface_map_test_tools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

using namespace fastlio;
using namespace fastlio::testing;

TEST(VoxelPlaneMap, MatchesLieOnTheSurfaceWithinTheirVariance)
{
  // Floors of many blocks, each in the middle of its finest voxels: a face through the noise of a
  // wall would cut its points in two.
  VoxelPlaneMap map(halfMetre());
  const float height = 0.75F;
  map.insert(worldPoints(patch(0.0F, 0.0F, height, 8.0F, 16000)), {0.0, 0.0, height + 3.0});
  double sum = 0.0;
  const Cloud queries = patch(0.0F, 0.0F, height, 7.5F, 10000, 0.0F);
  for (const Xyz& p : queries.points)
  {
    const PlaneMatch m = matchOne(map, p);
    ASSERT_TRUE(m.valid());
    sum += residual(m, p) * residual(m, p) / double(m.variance);
  }
  // At most about 1; below, as slanted beams are less noisy across the floor than the sensor's
  // range noise, and as scatter that is there by chance counts as roughness.
  EXPECT_GT(sum / double(queries.size()), 0.1);
  EXPECT_LT(sum / double(queries.size()), 1.3);
}

TEST(VoxelPlaneMap, AveragesAWallOverTheWholeBlock)
{
  VoxelPlaneMap map(halfMetre());
  map.insert(worldPoints(patch(1.0F, 1.0F, 0.25F, 0.99F, 2000, 0.0F)), {1.0, 1.0, 3.25});
  const PlaneMatch m = matchOne(map, {0.7F, 1.3F, 0.25F});
  ASSERT_TRUE(m.valid());
  EXPECT_LT(m.shared_variance, 3.0F * 1e-4F / 2000.0F);
  EXPECT_EQ(matchOne(map, {1.7F, 0.3F, 0.25F}).plane, m.plane) << "the same plane elsewhere";
}

TEST(VoxelPlaneMap, KeepsASmallFaceApartFromItsSurroundings)
{
  // A box's top of 0.5 m on a floor: their common block has no plane, the top's own voxel has.
  VoxelPlaneMap map(halfMetre());
  map.insert(worldPoints(patch(0.25F, 0.25F, 0.75F, 0.24F, 100)), {0.3, 0.3, 3.0});
  map.insert(worldPoints(patch(1.0F, 1.0F, 0.25F, 0.99F, 2000)), {0.3, 0.3, 3.0});
  const PlaneMatch top = matchOne(map, {0.25F, 0.25F, 0.75F});
  ASSERT_TRUE(top.valid());
  EXPECT_NEAR(std::abs(top.nz), 1.0F, 1e-2F);
  EXPECT_NEAR(residual(top, {0.25F, 0.25F, 0.75F}), 0.0, 0.01);
  EXPECT_EQ(top.created_insertion, 1U);
  EXPECT_EQ(matchOne(map, {1.7F, 1.7F, 0.25F}).created_insertion, 2U);
}

TEST(VoxelPlaneMap, DoesNotFoldNegativeCoordinatesOntoPositiveOnes)
{
  VoxelPlaneMap map(halfMetre());
  map.insert(worldPoints(patch(0.25F, 0.25F, 0.2F, 0.2F, 100)), {0.0, 0.0, 3.0});
  EXPECT_TRUE(matchOne(map, {0.2F, 0.2F, 0.2F}).valid());
  EXPECT_FALSE(matchOne(map, {-0.2F, 0.2F, 0.2F}).valid());
  EXPECT_FALSE(matchOne(map, {0.2F, -0.2F, 0.2F}).valid());
  EXPECT_FALSE(matchOne(map, {0.2F, 0.2F, -0.2F}).valid());
  EXPECT_EQ(map.pointCount(), 1U);
}

TEST(VoxelPlaneMap, HasNoMatchInTheCornerOfARoom)
{
  // One voxel of each scale holds three walls; no other voxel is near.
  Cloud cloud;
  for (const Xyz& p : patch(0.24F, 0.24F, 0.0F, 0.2F, 100, 0.005F).points)
    for (const Xyz& q :
         {Xyz{p.x, p.y, 0.04F + p.z}, Xyz{0.04F + p.z, p.x, p.y}, Xyz{p.x, 0.04F + p.z, p.y}})
      cloud.add(q);
  VoxelPlaneMap map(halfMetre());
  map.insert(worldPoints(cloud), {3.0, 3.0, 3.0});
  EXPECT_FALSE(matchOne(map, {0.04F, 0.2F, 0.2F}).valid());
}

// Found by fuzzing: a scan whose deskewing overflowed.
TEST(VoxelPlaneMap, HasNoMatchForWhatLiesNowhere)
{
  VoxelPlaneMap map(halfMetre());
  map.insert(worldPoints(patch(0.0F, 0.0F, 0.2F, 3.0F, 4000)), {0.0, 0.0, 3.0});
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Xyz near{0.1F, 0.1F, 0.2F};
  for (const float nowhere : {kNaN, kInfinity, -kInfinity, 1e30F, 1e12F})
  {
    const auto matches =
        matchAll(map, worldPoints({near, {nowhere, 0.1F, 0.2F}, {0.1F, nowhere, 0.2F}, near}));
    EXPECT_TRUE(matches[0].valid() && matches[3].valid()) << nowhere;
    EXPECT_FALSE(matches[1].valid() || matches[2].valid()) << nowhere;
  }
}

TEST(VoxelPlaneMap, DoesNotTakeWhatLiesNowhere)
{
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  VoxelPlaneMap map(halfMetre());
  map.insert(worldPoints(patch(0.0F, 0.0F, 0.2F, 3.0F, 4000)), {0.0, 0.0, 3.0});
  const std::size_t before = map.pointCount();
  map.insert(
      worldPoints({{kNaN, 0.1F, 0.2F}, {0.1F, 1e30F, 0.2F}, {0.1F, 0.1F, -kNaN}}), {0.0, 0.0, 3.0});
  EXPECT_EQ(map.pointCount(), before);
}

TEST(VoxelPlaneMap, WritesOnlyTheRangeThatIsAskedFor)
{
  VoxelPlaneMap map(halfMetre());
  const WorldPoints points = worldPoints(patch(0.0F, 0.0F, 0.2F, 3.0F, 4000));
  map.insert(points, {0.0, 0.0, 3.0});
  std::vector<PlaneMatch> matches(points.size(), PlaneMatch{0, 0, 0, 99.0F, -1, 0, 0, 0});
  map.match(points, {0.0, 0.0, 3.0}, 1000, 3000, matches);
  for (std::size_t i = 0; i < matches.size(); ++i)
    EXPECT_EQ(matches[i].d == 99.0F, i < 1000 || i >= 3000) << i;
}

TEST(VoxelPlaneMap, SeveralThreadsFindWhatOneFinds)
{
  VoxelPlaneMap map(halfMetre());
  const WorldPoints points = worldPoints(roomCloud(4, 40000));
  map.insert(points, Vec3::Zero());
  const auto expected = matchAll(map, points, Vec3::Zero());
  std::vector<PlaneMatch> found(points.size());
  std::thread first([&] { map.match(points, Vec3::Zero(), 0, 17001, found); });
  map.match(points, Vec3::Zero(), 17001, points.size(), found);
  first.join();
  for (std::size_t i = 0; i < found.size(); ++i)
    ASSERT_TRUE(found[i].plane == expected[i].plane && found[i].variance == expected[i].variance);
}

TEST(VoxelPlaneMap, ForgetsWhatIsFarAndKeepsWhatIsNear)
{
  VoxelPlaneMap map(halfMetre());
  map.insert(worldPoints(patch(0.5F, 0.5F, 0.2F, 0.4F, 500)), {0.0, 0.0, 3.0});
  map.insert(worldPoints(patch(50.5F, 0.5F, 0.2F, 0.4F, 500)), {50.0, 0.0, 3.0});
  const std::size_t both = map.pointCount();
  for (int call = 0; call < 40; ++call)  // each call looks at a part of the map
    map.removeOutside({50.0, 0.0, 0.0}, 20.0);
  EXPECT_EQ(map.pointCount(), both / 2);
  EXPECT_FALSE(matchOne(map, {0.5F, 0.5F, 0.2F}).valid());
  EXPECT_TRUE(matchOne(map, {50.5F, 0.5F, 0.2F}).valid());
  EXPECT_EQ(map.toPointsMap()->size(), map.pointCount());
  // A place that comes into view again starts anew.
  map.insert(worldPoints(patch(0.5F, 0.5F, 0.3F, 0.4F, 500)), {0.0, 0.0, 3.0});
  const PlaneMatch again = matchOne(map, {0.5F, 0.5F, 0.3F});
  ASSERT_TRUE(again.valid());
  EXPECT_NEAR(residual(again, {0.5F, 0.5F, 0.3F}), 0.0, 5e-3);
  EXPECT_EQ(again.created_insertion, 3U);
}

TEST(VoxelPlaneMap, EmptyMapAnswersAndForgetsNothing)
{
  VoxelPlaneMap map(halfMetre());
  map.removeOutside(Vec3::Zero(), 1.0);
  map.insert({}, Vec3::Zero());
  EXPECT_EQ(map.pointCount(), 0U);
  EXPECT_FALSE(matchOne(map, {0.0F, 0.0F, 0.0F}).valid());
  EXPECT_EQ(map.toPointsMap()->size(), 0U);
}

TEST(VoxelPlaneMap, ExportsTheMeanPointOfEachFinestVoxel)
{
  VoxelPlaneMap map(halfMetre());
  map.insert(
      worldPoints({{0.1F, 0.1F, 0.1F}, {0.3F, 0.2F, 0.1F}, {-0.1F, 0.1F, 0.1F}}), Vec3::Zero());
  const auto points = map.toPointsMap();
  ASSERT_EQ(points->size(), 2U);
  const std::size_t first = pointOf(*points, 0).x > 0 ? 0 : 1;
  EXPECT_LT(distance(pointOf(*points, first), {0.2F, 0.15F, 0.1F}), 1e-6);
  EXPECT_LT(distance(pointOf(*points, 1 - first), {-0.1F, 0.1F, 0.1F}), 1e-6);
}

TEST(VoxelPlaneMap, RefusesUnusableOptionsByName)
{
  const auto refusal = [](auto change) -> std::string
  {
    VoxelPlaneOptions o;
    change(o);
    try
    {
      VoxelPlaneMap map(o);
    }
    catch (const std::invalid_argument& e)
    {
      return e.what();
    }
    return {};
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {0.0, -0.4, kNaN})
  {
    EXPECT_NE(
        refusal([&](auto& o) { o.voxel_size = value; }).find("voxel_size"), std::string::npos);
    EXPECT_NE(
        refusal([&](auto& o) { o.rules.point_noise = float(value); }).find("point_noise"),
        std::string::npos);
    EXPECT_NE(
        refusal([&](auto& o) { o.rules.max_thickness = float(value); }).find("max_thickness"),
        std::string::npos);
  }
  EXPECT_EQ(refusal([](auto&) {}), "");
}

TEST(VoxelPlaneMap, LooksUpAgainWhatHasLeftItsVoxel)
{
  // Two floors, one above the other: points move from one to the other, within a voxel, and to
  // where nothing is.
  VoxelPlaneMap map(halfMetre());
  map.insert(worldPoints(patch(0.0F, 0.0F, 0.25F, 8.0F, 16000)), {0.0, 0.0, 3.25});
  map.insert(worldPoints(patch(0.0F, 0.0F, 2.75F, 8.0F, 16000)), {0.0, 0.0, 5.75});
  std::mt19937 rng(9);
  std::uniform_real_distribution<float> u(-9.0F, 9.0F), small(-0.05F, 0.05F);
  WorldPoints before, after;
  constexpr std::size_t kPoints = 1000;
  before.resize(kPoints);
  after.resize(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i)
  {
    before.x[i] = u(rng), before.y[i] = u(rng), before.z[i] = i % 2 == 0 ? 0.25F : 2.75F;
    after.x[i] = before.x[i] + small(rng), after.y[i] = before.y[i] + small(rng);
    after.z[i] = i % 5 == 0 ? 2.75F : before.z[i] + small(rng);
  }
  before.x[7] = after.y[8] = std::numeric_limits<float>::quiet_NaN();
  after.z[9] = 1e30F;
  std::vector<PlaneMatch> old(kPoints), anew(kPoints);
  map.match(before, kHighAbove, 0, kPoints, old);
  map.match(after, kHighAbove, 0, kPoints, anew);
  std::vector<PlaneMatch> again = old;
  map.rematch(before, after, kHighAbove, 0, kPoints, again);

  const auto cell = [](float x) { return std::floor(x / 0.5F); };
  std::size_t kept = 0, changed = 0;
  for (std::size_t i = 0; i < kPoints; ++i)
  {
    const bool stays = cell(before.x[i]) == cell(after.x[i]) &&
                       cell(before.y[i]) == cell(after.y[i]) &&
                       cell(before.z[i]) == cell(after.z[i]);
    const PlaneMatch& expected = stays ? old[i] : anew[i];
    EXPECT_EQ(again[i].plane, expected.plane) << i;
    EXPECT_EQ(again[i].variance, expected.variance) << i;
    kept += stays ? 1U : 0U;
    changed += !stays && old[i].plane != anew[i].plane ? 1U : 0U;
  }
  EXPECT_GT(kept, kPoints / 2);
  EXPECT_GT(changed, kPoints / 20);
}
