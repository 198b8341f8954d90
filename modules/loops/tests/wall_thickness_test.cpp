// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/loops/wall_thickness.h>
#include <fastlio/map/voxel_plane_map.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <utility>

namespace fastlio
{
namespace
{
// Less than the noise that a map of planes expects: its variances have that as a floor.
constexpr double kNoise = 0.006;  // [m]

/** A wall at x = 4.2 m (not on an edge of voxels of the first pass, which would cut it in two) and
 * a floor at z = -1.5 m, as seen from a pose. */
Submap submapAt(const Pose& T_world_submap, unsigned seed)
{
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0.0, kNoise);
  std::uniform_real_distribution<double> uniform;
  constexpr std::size_t kScans = 10, kPoints = 4000;
  VoxelPlaneMap map(VoxelPlaneOptions{});
  const Pose T_submap_world = T_world_submap.inverse();
  for (std::size_t scan = 0; scan < kScans; ++scan)
  {
    WorldPoints points;
    for (std::size_t i = 0; i < kPoints; ++i)
    {
      const double along = -8.0 + 16.0 * uniform(engine), up = -1.5 + 4.0 * uniform(engine);
      const Vec3 p = T_submap_world * (i % 2 == 0 ? Vec3(4.2 + noise(engine), along, up)
                                                  : Vec3(2.0 * up, along, -1.5 + noise(engine)));
      points.x.push_back(static_cast<float>(p.x()));
      points.y.push_back(static_cast<float>(p.y()));
      points.z.push_back(static_cast<float>(p.z()));
    }
    map.insert(points, Vec3::Zero());
  }
  Submap submap;
  SubmapSurfaces surfaces;
  surfaces.planes = map.bestPlanes(surfaces.spreads);
  submap.surfaces = StoredSurfaces(std::make_shared<SubmapStore>(), std::move(surfaces));
  return submap;
}

/** Two passes by the same wall: where the odometry has the second, and where the graph has it. */
MappingResult twoPasses(const Vec3& odometry_error, const Vec3& corrected_error)
{
  const Pose first, second{expSO3({0.0, 0.0, 0.7}), {0.6, 1.3, 0.0}};
  MappingResult result;
  result.submaps = {submapAt(first, 1), submapAt(second, 2)};
  result.submaps[1].reference.T_world_body = {second.R, second.p + odometry_error};
  result.estimate.nodes = {first, {second.R, second.p + corrected_error}};
  Closure closure;
  closure.a = 0;
  closure.b = 1;
  closure.verdict = ClosureVerdict::Accepted;
  result.closures = {closure};
  return result;
}

/** rms distance from the middle of two layers of points. */
double layers(double apart)
{
  return std::sqrt(kNoise * kNoise + 0.25 * apart * apart);
}
}  // namespace

TEST(WallThickness, ThatOfOnePassIsTheNoiseAndNotItsFloor)
{
  const auto found = wallThickness(twoPasses(Vec3::Zero(), Vec3::Zero()));
  ASSERT_TRUE(found);
  EXPECT_GT(found->walls, 20U);
  EXPECT_NEAR(found->single, kNoise, 0.1 * kNoise);
  EXPECT_NEAR(found->ratio(), 1.0, 0.1);
}

TEST(WallThickness, ACorrectedWallIsThinAgain)
{
  const auto found = wallThickness(twoPasses({0.1, 0.0, 0.0}, Vec3::Zero()));
  ASSERT_TRUE(found && found->before);
  EXPECT_NEAR(*found->before, layers(0.1), 0.003);
  EXPECT_NEAR(found->after, kNoise, 0.1 * kNoise);
}

TEST(WallThickness, ShowsAWallThatStaysDouble)
{
  const auto found = wallThickness(twoPasses(Vec3::Zero(), {0.04, 0.0, 0.0}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->after, layers(0.04), 0.002);
  EXPECT_GT(found->ratio(), 3.0);
  // Far more than a plane's own thickness.
  EXPECT_NEAR(wallThickness(twoPasses(Vec3::Zero(), {0.4, 0.0, 0.0}))->after, layers(0.4), 0.01);
}

TEST(WallThickness, MotionAlongTheWallAndFloorsDoNotCount)
{
  const auto found = wallThickness(twoPasses(Vec3::Zero(), {0.0, 0.05, 0.2}));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->ratio(), 1.0, 0.1);
}

TEST(WallThickness, SessionsHaveNoBefore)
{
  MappingResult result = twoPasses({30.0, 0.0, 0.0}, Vec3::Zero());
  result.submaps[1].session = 1;
  const auto found = wallThickness(result);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->before);
  EXPECT_NEAR(found->ratio(), 1.0, 0.1);
}

TEST(WallThickness, OnlyOfAcceptedClosures)
{
  MappingResult result = twoPasses(Vec3::Zero(), Vec3::Zero());
  result.closures.front().verdict = ClosureVerdict::Contradicted;
  EXPECT_FALSE(wallThickness(result));
}

}  // namespace fastlio
