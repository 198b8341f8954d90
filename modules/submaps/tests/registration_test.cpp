// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/map/voxel_plane_map.h>
#include <fastlio/submaps/place_recognition.h>
#include <fastlio/submaps/registration.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fastlio
{
namespace
{
/** Points of a yard with walls at odd places, floor and some boxes, in another frame. */
std::vector<VoxelPlane> yard(const Pose& T_frame_yard, unsigned seed, double shift = 0.0)
{
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise(0.0, 0.005);
  std::uniform_real_distribution<double> uniform;
  WorldPoints points;
  const auto add = [&](const Vec3& in_yard)
  {
    const Vec3 p = T_frame_yard * (in_yard + Vec3(noise(engine), noise(engine), noise(engine)));
    points.x.push_back(static_cast<float>(p.x()));
    points.y.push_back(static_cast<float>(p.y()));
    points.z.push_back(static_cast<float>(p.z()));
  };
  const auto wall = [&](double x0, double y0, double x1, double y1, double height)
  {
    const double length = std::hypot(x1 - x0, y1 - y0);
    for (int i = 0; i < static_cast<int>(60 * length); ++i)
    {
      const double s = uniform(engine);
      add({x0 + s * (x1 - x0) + shift, y0 + s * (y1 - y0), -1.5 + height * uniform(engine)});
    }
  };
  for (int i = 0; i < 40000; ++i)
    add({-20.0 + 40.0 * uniform(engine), -15.0 + 30.0 * uniform(engine), -1.5});
  wall(-18, 14, 6, 14, 5);
  wall(6, 14, 6, 9, 5);
  wall(6, 9, 19, 7, 5);
  wall(19, 7, 17, -13, 4);
  wall(17, -13, -4, -13, 4);
  wall(-15, -9, -18, 14, 4);
  wall(-6, 3, -3, 3, 2);
  wall(-3, 3, -3, 5.5, 2);
  wall(8, -4, 11, -6, 2.5);
  wall(11, -6, 12, -3, 2.5);
  // As scans: planes are fitted anew as points join.
  constexpr std::size_t kScans = 20;
  VoxelPlaneMap map(VoxelPlaneOptions{});
  for (std::size_t scan = 0; scan < kScans; ++scan)
  {
    WorldPoints part;
    for (std::size_t i = scan; i < points.size(); i += kScans)
    {
      part.x.push_back(points.x[i]);
      part.y.push_back(points.y[i]);
      part.z.push_back(points.z[i]);
    }
    map.insert(part, T_frame_yard * Vec3(0, 0, 0));
  }
  return map.bestPlanes();
}

RelativePose predictedAt(const Pose& T, double position_std, double attitude_std)
{
  RelativePose predicted;
  predicted.T_a_b = T;
  predicted.covariance.diagonal().head<3>().setConstant(attitude_std * attitude_std);
  predicted.covariance.diagonal().tail<3>().setConstant(position_std * position_std);
  return predicted;
}

const Pose kTruth{expSO3({0.01, -0.02, 1.9}), {3.0, -2.0, 0.1}};  // T_target_source

Pose besideTruth(const Vec3& way, double heading)
{
  return {kTruth.R * expSO3({0.0, 0.0, heading}), kTruth.p + way};
}
}  // namespace

TEST(SubmapRegistration, FindsThePoseFromAnyHeading)
{
  const SubmapRegistration target(yard({}, 1));
  const auto source = yard(kTruth.inverse(), 2);
  const Pose guess = besideTruth({0.9, -0.7, 0.3}, 0.05);
  const Registration found = target.search(source, predictedAt(guess, 0.6, 0.05), Vec3::UnitZ());
  ASSERT_TRUE(found.converged);
  EXPECT_LT((found.motion.T_a_b.p - kTruth.p).norm(), 0.01);
  EXPECT_LT(logSO3(kTruth.R.transpose() * found.motion.T_a_b.R).norm(), 0.001);
  EXPECT_GT(found.evidence.overlap, 0.8);
  EXPECT_GT(found.evidence.inlier_ratio, 0.6);
  EXPECT_GT(found.evidence.margin, 25.0);
}

TEST(SubmapRegistration, DoesNotDependOnTheThreads)
{
  const auto planes = yard({}, 1), source = yard(kTruth.inverse(), 2);
  const RelativePose predicted = predictedAt(kTruth, 1.5, 0.1);
  const Registration one = SubmapRegistration(planes).search(source, predicted, Vec3::UnitZ());
  const Registration three = SubmapRegistration(planes, std::make_shared<const Workers>(3))
                                 .search(source, predicted, Vec3::UnitZ());
  EXPECT_EQ(one.motion.T_a_b.p, three.motion.T_a_b.p);
  EXPECT_EQ(one.motion.covariance, three.motion.covariance);
  EXPECT_EQ(one.evidence.margin, three.evidence.margin);
}

/** Who is lost in all directions shall not wait for minutes. What is likely is searched
 * nevertheless. */
TEST(SubmapRegistration, TriesNoMoreThanSomeThousandPlaces)
{
  const SubmapRegistration target(yard({}, 1));
  const auto source = yard(kTruth.inverse(), 2);
  const Pose guess = besideTruth({3.0, -2.5, 0.8}, 0.15);
  const Registration found = target.search(source, predictedAt(guess, 20.0, 0.5), Vec3::UnitZ());
  EXPECT_GT(found.evidence.starts, 2000U);
  EXPECT_LE(found.evidence.starts, 3000U);
  ASSERT_TRUE(found.converged);
  EXPECT_LT((found.motion.T_a_b.p - kTruth.p).norm(), 0.01);
}

TEST(SubmapRegistration, KeepsItsPlanesWhenThoseGivenChange)
{
  auto planes = yard({}, 1);
  const auto source = yard(kTruth.inverse(), 2);
  const RelativePose predicted = predictedAt(kTruth, 0.6, 0.05);
  const SubmapRegistration target(planes);
  const Registration before = target.search(source, predicted, Vec3::UnitZ());
  for (VoxelPlane& plane : planes)
  {
    plane.variance = 100.0F;
    plane.leverage.fill(100.0F);
  }
  const Registration after = target.search(source, predicted, Vec3::UnitZ());
  EXPECT_EQ(before.motion.T_a_b.p, after.motion.T_a_b.p);
  EXPECT_EQ(before.motion.covariance, after.motion.covariance);
  EXPECT_EQ(before.evidence.cost, after.evidence.cost);
}

TEST(SubmapRegistration, AnotherPlaceDoesNotFit)
{
  const SubmapRegistration target(yard({}, 1));
  // The same yard, seen from a place that the prediction excludes.
  const auto source = yard(Pose{expSO3({0, 0, 0.7}), {14.0, 9.0, 0.0}}, 2);
  const Registration found = target.search(source, predictedAt({}, 0.2, 0.02), Vec3::UnitZ());
  EXPECT_LT(found.evidence.score, 0.6);
}

/** A wall that is seen from its other side is another surface, 0.3 m away or not. */
TEST(SubmapRegistration, TheOtherSideOfASurfaceIsAnotherOne)
{
  const auto source = yard({}, 2);
  std::vector<VoxelPlane> from_behind = yard({}, 1);
  for (VoxelPlane& plane : from_behind)
  {
    plane.nx = -plane.nx;
    plane.ny = -plane.ny;
    plane.nz = -plane.nz;
  }
  const RelativePose predicted = predictedAt({}, 0.05, 0.01);
  EXPECT_GT(
      SubmapRegistration(yard({}, 1)).search(source, predicted, Vec3::UnitZ()).evidence.overlap,
      0.9);
  EXPECT_LT(
      SubmapRegistration(from_behind).search(source, predicted, Vec3::UnitZ()).evidence.overlap,
      0.1);
}

TEST(SubmapRegistration, OfNothingDoesNotConverge)
{
  const SubmapRegistration target(yard({}, 1)), nothing({});
  EXPECT_FALSE(target.search({}, predictedAt({}, 0.2, 0.02), Vec3::UnitZ()).converged);
  EXPECT_FALSE(nothing.search(yard({}, 1), predictedAt({}, 0.2, 0.02), Vec3::UnitZ()).converged);
}

/** A floor leaves heading and place on it open: the covariance says so. */
TEST(SubmapRegistration, ReportsTheDirectionsThatTheSurfacesLeaveOpen)
{
  std::vector<VoxelPlane> floor = yard({}, 1);
  floor.erase(
      std::remove_if(
          floor.begin(), floor.end(),
          [](const VoxelPlane& plane) { return std::abs(plane.nz) < 0.9995F; }),
      floor.end());
  const Registration found =
      SubmapRegistration(floor).search(floor, predictedAt({}, 0.05, 0.01), Vec3::UnitZ());
  ASSERT_TRUE(found.converged);
  EXPECT_GT(std::sqrt(found.motion.covariance(3, 3)), 1.0);
  EXPECT_LT(std::sqrt(found.motion.covariance(5, 5)), 0.03);
}

std::vector<VoxelPlane> wallsOfYard(const Pose& T_submap_world, unsigned seed)
{
  std::vector<VoxelPlane> walls = yard(T_submap_world, seed);
  walls.erase(
      std::remove_if(
          walls.begin(), walls.end(),
          [](const VoxelPlane& plane) { return std::abs(plane.nz) > 0.3F; }),
      walls.end());
  return walls;
}

/** Along a direction that is held, the prediction decides, and the surfaces do elsewhere. */
TEST(SubmapRegistration, AlignsAcrossADirectionThatIsHeld)
{
  const SubmapRegistration target(wallsOfYard({}, 1));
  const auto source = wallsOfYard(kTruth.inverse(), 2);
  const RelativePose predicted = predictedAt(besideTruth({0.2, -0.1, 0.6}, 0.01), 0.5, 0.03);
  const Registration found = target.search(source, predicted, Vec3::UnitZ());
  const Registration held =
      target.alignedAcross(Vec3::UnitZ(), source, found, predicted, Vec3::UnitZ());
  ASSERT_TRUE(held.converged);
  const Vec3 off = held.motion.T_a_b.p - kTruth.p;
  EXPECT_NEAR(off.z(), 0.6, 0.01);
  EXPECT_LT(off.head<2>().norm(), 0.02);
  EXPECT_GT(held.evidence.upright_score, 0.8);
  EXPECT_EQ(held.evidence.starts, found.evidence.starts);
  EXPECT_EQ(held.evidence.margin_across, found.evidence.margin_across);
}

/** Walls tell no height, whatever the noise of their normals seems to say. */
TEST(SubmapRegistration, CountsThePlanesThatTellADirection)
{
  const auto all = yard({}, 1), walls = wallsOfYard({}, 1);
  const RelativePose predicted = predictedAt({}, 0.05, 0.01);
  const auto acrossOf = [&](const std::vector<VoxelPlane>& planes)
  { return SubmapRegistration(planes).search(planes, predicted, Vec3::UnitZ()).evidence; };
  const RegistrationEvidence with_floor = acrossOf(all), without = acrossOf(walls);
  EXPECT_NEAR(
      with_floor.planes_across.sum(), with_floor.score * static_cast<double>(all.size()), 1.0);
  EXPECT_GT(with_floor.planes_across[0], 50.0);
  EXPECT_GT(without.planes_across[1], 50.0);
  EXPECT_LT(without.planes_across[0], 0.02 * without.planes_across[1]);
}

TEST(SubmapRegistration, MedianDistanceIsThatOfTheShift)
{
  const SubmapRegistration target(yard({}, 1));
  EXPECT_LT(target.medianDistance(yard({}, 2), {}), 0.01);
  EXPECT_NEAR(target.medianDistance(yard({}, 2), {Mat3::Identity(), {0, 0, 0.2}}), 0.1, 0.11);
}

TEST(PlaceIndex, FindsAPlaceAtAnyHeading)
{
  const Mat3 level = Mat3::Identity();
  PlaceIndex index(1.0);
  // Other places: parts of the yard seen from far away, mirrored.
  for (const double side : {1.0, -1.0})
    index.add(yard({expSO3({0, 0, side}), {25.0 * side, -18.0, 0.0}}, 3), level);
  index.add(yard({}, 1), level);
  for (const double heading : {0.0, 0.8, 2.0, -2.4})
  {
    const Pose T_place_query{expSO3({0, 0, heading}), {4.0, -3.0, 0.0}};
    const auto found = index.find(yard(T_place_query.inverse(), 2), level, 1);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].place, 2U);
    EXPECT_GT(found[0].similarity, 0.5);
    EXPECT_LT((found[0].T_place_query.p - T_place_query.p).norm(), 1.6);
    EXPECT_LT(logSO3(T_place_query.R.transpose() * found[0].T_place_query.R).norm(), 0.1);
  }
}

TEST(PlaceIndex, LevelsTheQuery)
{
  const Mat3 R_world_submap = expSO3({0, 0, 2.2}) * expSO3({0.3, -0.2, 0.0});
  const Mat3 level = levelingRotation(R_world_submap);
  // The z axis of the world in the submap comes to z; the heading is zero.
  EXPECT_LT((level * (R_world_submap.transpose() * Vec3::UnitZ()) - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_NEAR(level(1, 0), 0.0, 1e-12);
}

}  // namespace fastlio
