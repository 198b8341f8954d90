// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "short_simulation.h"
#include "surface_distance.h"
#include <fastlio/math/angles.h>
#include <fastlio/simulation/vlp16.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace fastlio
{
namespace
{
LidarSettings lidarOf(LidarKind kind, double rate)
{
  LidarSettings settings;
  settings.kind = kind;
  settings.rate = rate;
  return settings;
}

class EveryLidar : public ::testing::TestWithParam<LidarKind>
{
};

TEST_P(EveryLidar, SweepsFollowEachOtherAtTheRate)
{
  for (const double rate : {5.0, 10.0, 20.0, 50.0, 100.0})
  {
    const auto model = makeLidarModel(lidarOf(GetParam(), rate), 1'000'000);
    for (std::size_t i = 0; i < 7; ++i)
    {
      const Sweep sweep = model->sweep(i);
      ASSERT_FALSE(sweep.shots.empty());
      EXPECT_EQ(sweep.stamp_ns, model->stampOf(i));
      EXPECT_EQ(sweep.shots.front().offset_ns, 0);
      for (std::size_t k = 1; k < sweep.shots.size(); ++k)
        ASSERT_GE(sweep.shots[k].offset_ns, sweep.shots[k - 1].offset_ns);
      EXPECT_LT(sweep.stamp_ns + sweep.shots.back().offset_ns, model->stampOf(i + 1));
      // Raw packets are whole: a VLP-16 sweep begins up to one packet late.
      EXPECT_NEAR(
          static_cast<double>(sweep.stamp_ns - 1'000'000), 1e9 * static_cast<double>(i) / rate,
          static_cast<double>(vlp16::kPacketNs));
    }
  }
}

TEST_P(EveryLidar, DirectionsAreUnitVectors)
{
  const Sweep sweep = makeLidarModel(lidarOf(GetParam(), 10.0), 0)->sweep(3);
  for (const auto& shot : sweep.shots)
    ASSERT_NEAR(shot.direction.norm(), 1.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, EveryLidar,
    ::testing::Values(LidarKind::Vlp16, LidarKind::Os64, LidarKind::Livox, LidarKind::Vlp32c));

TEST(Vlp16, FiresAsTheManualSays)
{
  const auto model = makeLidarModel(lidarOf(LidarKind::Vlp16, 10.0), 0);
  std::set<std::size_t> packets;
  for (std::size_t i = 0; i < 40; ++i)
  {
    const Sweep sweep = model->sweep(i);
    ASSERT_EQ(sweep.shots.size() % 384, 0U);
    packets.insert(sweep.shots.size() / 384);
    const double first = std::atan2(-sweep.shots[0].direction.y(), sweep.shots[0].direction.x());
    EXPECT_GE(first, -1e-9);  // a sweep begins after the encoder's zero, by one packet at most
    EXPECT_LT(first, kTwoPi * 10.0 * 1.327104e-3);
  }
  EXPECT_EQ(packets, (std::set<std::size_t>{75, 76}));  // 100 ms / 1.327104 ms = 75.35
  const Sweep sweep = model->sweep(2);
  for (const std::size_t k : {0U, 1U, 15U, 16U, 37U, 383U, 384U, 1000U})
    EXPECT_EQ(sweep.shots[k].offset_ns, static_cast<std::int32_t>(k / 16 * 55296 + k % 16 * 2304));
  EXPECT_NEAR(std::asin(sweep.shots[0].direction.z()), -15.0 * kTwoPi / 360.0, 1e-12);
  EXPECT_NEAR(std::asin(sweep.shots[3].direction.z()), 3.0 * kTwoPi / 360.0, 1e-12);
  EXPECT_EQ(sweep.shots[0].ring, 0);
  EXPECT_EQ(sweep.shots[3].ring, 9);
}

TEST(Os64, CoversTheCircleAndItsFieldOfView)
{
  const Sweep sweep = makeLidarModel(lidarOf(LidarKind::Os64, 10.0), 0)->sweep(0);
  ASSERT_EQ(sweep.shots.size(), 64U * 1024U);
  EXPECT_NEAR(std::asin(sweep.shots[0].direction.z()), -0.3925, 1e-12);
  EXPECT_NEAR(std::asin(sweep.shots[63].direction.z()), 0.3925, 1e-12);
  const Shot& quarter = sweep.shots[std::size_t{256} * 64];
  EXPECT_EQ(quarter.offset_ns, 25'000'000);
  EXPECT_LT(quarter.direction.y(), -0.9);  // clockwise: to the right
}

TEST(Os64, LooksUpOrDownByItsElevation)
{
  LidarSettings settings = lidarOf(LidarKind::Os64, 10.0);
  settings.elevation = -0.2;
  const Sweep sweep = makeLidarModel(settings, 0)->sweep(0);
  EXPECT_NEAR(std::asin(sweep.shots[0].direction.z()), -0.5925, 1e-12);
  EXPECT_NEAR(std::asin(sweep.shots[63].direction.z()), 0.1925, 1e-12);
}

TEST(Vlp32c, HasMostLinesNearTheHorizon)
{
  const LidarSettings settings = lidarOf(LidarKind::Vlp32c, 10.0);
  const Sweep sweep = makeLidarModel(settings, 0)->sweep(0);
  const std::size_t lines = lineCount(settings);
  ASSERT_EQ(lines, 32U);
  ASSERT_EQ(sweep.shots.size(), 1808U * lines);  // 100 ms / 55.296 us
  const auto elevation = [&](std::size_t line)
  { return std::asin(sweep.shots[line].direction.z()) * kDegPerRad; };
  EXPECT_NEAR(elevation(0), -25.0, 1e-9);
  EXPECT_NEAR(elevation(31), 15.0, 1e-9);
  std::size_t near_horizon = 0;
  for (std::size_t line = 0; line < lines; ++line)
  {
    EXPECT_EQ(sweep.shots[line].ring, line);
    EXPECT_GE(elevation(line), elevation(line == 0 ? 0 : line - 1));
    near_horizon += std::abs(elevation(line)) <= 4.0 ? 1 : 0;
  }
  EXPECT_EQ(near_horizon, 20U);
}

TEST(Livox, NeverShootsTheSamePatternTwice)
{
  const auto model = makeLidarModel(lidarOf(LidarKind::Livox, 10.0), 0);
  const Sweep one = model->sweep(4), other = model->sweep(5);
  ASSERT_EQ(one.shots.size(), other.shots.size());
  std::size_t same = 0;
  for (std::size_t i = 0; i < one.shots.size(); ++i)
  {
    same += (one.shots[i].direction - other.shots[i].direction).norm() < 1e-3 ? 1 : 0;
    EXPECT_GT(one.shots[i].direction.x(), std::cos(38.0 * kTwoPi / 360.0));
  }
  EXPECT_LT(same, one.shots.size() / 50);
}

TEST(LidarModel, RejectsWhatCannotFire)
{
  EXPECT_THROW((void)makeLidarModel(lidarOf(LidarKind::Vlp16, 0.0), 0), std::invalid_argument);
  EXPECT_THROW((void)makeLidarModel(lidarOf(LidarKind::Vlp16, 1000.0), 0), std::invalid_argument);
  LidarSettings none = lidarOf(LidarKind::Os64, 10.0);
  none.lines = 0;
  EXPECT_THROW((void)makeLidarModel(none, 0), std::invalid_argument);
}

class EveryWorld : public ::testing::TestWithParam<std::string_view>
{
};

TEST_P(EveryWorld, PointsAtTheTruePoseOfTheirTimeLieOnSurfaces)
{
  const SimulationSettings settings =
      testing::withoutErrors(testing::shortSettings(GetParam(), 6.5, 16));
  const Simulation simulation(settings);
  ASSERT_GT(simulation.scanCount(), 50U);
  double worst = 0.0;
  std::size_t points = 0;
  for (std::size_t i = 8; i < simulation.scanCount(); i += 9)
  {
    const LidarScan scan = simulation.scan(i);
    for (std::size_t k = 0; k < scan.points.size(); k += 5, ++points)
    {
      const double t = simulation.secondsSinceStart(scan.stamp_ns + scan.points.time_offset_ns[k]);
      const Vec3 p(scan.points.x[k], scan.points.y[k], scan.points.z[k]);
      const Vec3 in_world = simulation.motion().pose(t) * (scan.T_imu_lidar * p);
      worst = std::max(worst, testing::surfaceDistance(simulation.world(), in_world, t));
    }
  }
  EXPECT_GT(points, 300U);
  EXPECT_LT(worst, 2e-5);  // single precision of 100 m
}

INSTANTIATE_TEST_SUITE_P(
    Catalog, EveryWorld,
    ::testing::Values(
        "campus", "office", "uav", "car", "shake", "spin", "stairs", "tunnel", "open_area", "crowd",
        "park", "rotunda", "ramp", "town", "facades", "corridors"),
    [](const auto& test) { return std::string(test.param); });

/** Echoes of one setting, at rest. */
std::vector<Echo> echoesOf(const SimulationSettings& settings, std::size_t index = 2)
{
  return Simulation(settings).fire(index).echoes;
}

TEST(Echoes, NoiseAndDropoutsHaveTheGivenSize)
{
  SimulationSettings settings = testing::shortSettings("rest", 2.0, 1);
  settings.lidar.range_noise = 0.05;
  settings.lidar.dropout = 0.1;
  const std::vector<Echo> noisy = echoesOf(settings);
  const std::vector<Echo> exact = echoesOf(testing::withoutErrors(settings));
  double sum = 0.0, squares = 0.0;
  std::size_t lost = 0, present = 0, kept = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    if (exact[i].range <= 0.0) continue;
    ++present;
    if (noisy[i].range <= 0.0)
    {
      ++lost;
      continue;
    }
    ++kept;
    sum += noisy[i].range - exact[i].range;
    squares += std::pow(noisy[i].range - exact[i].range, 2);
  }
  ASSERT_GT(present, 10000U);
  EXPECT_NEAR(static_cast<double>(lost) / static_cast<double>(present), 0.1, 0.01);
  EXPECT_NEAR(sum / static_cast<double>(kept), 0.0, 0.002);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(kept)), 0.05, 0.002);
}

TEST(Echoes, SeedsChangeNoiseOnly)
{
  SimulationSettings settings = testing::shortSettings("office", 4.0);
  const Simulation one(settings), same(settings);
  settings.seed = 2;
  const Simulation other(settings);
  const LidarScan a = one.scan(30), b = same.scan(30), c = other.scan(30);
  EXPECT_EQ(a.points.x, b.points.x);
  EXPECT_NE(a.points.x, c.points.x);
  EXPECT_EQ(a.stamp_ns, c.stamp_ns);
  EXPECT_EQ((one.motion().pose(3.3).p - other.motion().pose(3.3).p).norm(), 0.0);
}

TEST(Echoes, RangesAreLimitedOnBothSides)
{
  SimulationSettings settings = testing::withoutErrors(testing::shortSettings("rest", 2.0, 1));
  settings.lidar.min_range = 2.0;
  settings.lidar.max_range = 3.0;
  std::size_t present = 0;
  for (const auto& echo : echoesOf(settings))
  {
    if (echo.range == 0.0) continue;
    ++present;
    EXPECT_GE(echo.range, 2.0);
    EXPECT_LE(echo.range, 3.0);
  }
  EXPECT_GT(present, 100U);
}

TEST(Echoes, StrideThinsOutColumnsAndKeepsTheRest)
{
  const SimulationSettings all = testing::withoutErrors(testing::shortSettings("rest", 2.0, 1));
  SimulationSettings some = all;
  some.lidar.stride = 7;
  const FiredSweep full = Simulation(all).fire(1), thin = Simulation(some).fire(1);
  ASSERT_EQ(full.echoes.size(), thin.echoes.size());
  for (std::size_t i = 0; i < full.echoes.size(); ++i)
    EXPECT_EQ(thin.echoes[i].range, full.sweep.shots[i].column % 7 == 0 ? full.echoes[i].range : 0);
}

TEST(Scan, TimeOffsetShiftsStampsOnly)
{
  SimulationSettings settings = testing::shortSettings("office", 4.0);
  const LidarScan on_time = Simulation(settings).scan(30);
  settings.lidar.time_offset = 0.015;
  const LidarScan late = Simulation(settings).scan(30);
  EXPECT_EQ(late.stamp_ns - on_time.stamp_ns, 15'000'000);
  EXPECT_EQ(late.points.x, on_time.points.x);
  EXPECT_EQ(late.points.time_offset_ns, on_time.points.time_offset_ns);
}
}  // namespace
}  // namespace fastlio
