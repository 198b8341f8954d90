// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/own_body.h>
#include <fastlio/math/so3.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace fastlio
{
namespace
{
/** A LiDAR of 16 lines, 1.2 m above the ground, in a corridor along x that is 3 m wide and ends at
 * -10 and 60 m. */
class Corridor
{
 public:
  explicit Corridor(bool with_carrier) : with_carrier_(with_carrier) {}

  PointColumns scan(const Pose& T_world_lidar)
  {
    PointColumns points;
    for (int line = 0; line < 16; ++line)
      for (int column = 0; column < 360; ++column)
      {
        const double elevation = (2.0 * line - 15.0) * M_PI / 180.0;
        const double azimuth = column * M_PI / 180.0;
        const Vec3 d(
            std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation));
        const bool on_carrier = with_carrier_ && std::abs(column - 180) < 16;
        const double range = on_carrier ? 0.6 : wallRange(T_world_lidar.p, T_world_lidar.R * d);
        const Vec3 p = (range + 0.01 * normal_(random_)) * d;
        points.push_back(
            static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
            on_carrier ? 1.0F : 0.0F, 0, 0);
      }
    return points;
  }

 private:
  static double wallRange(const Vec3& p, const Vec3& d)
  {
    const auto along = [](double from, double direction, double low, double high)
    {
      if (direction > 1e-9) return (high - from) / direction;
      return direction < -1e-9 ? (low - from) / direction : std::numeric_limits<double>::infinity();
    };
    return std::min(
        {along(p.x(), d.x(), -10.0, 60.0), along(p.y(), d.y(), -1.5, 1.5),
         along(p.z(), d.z(), -1.2, 1.8)});
  }

  bool with_carrier_;
  std::mt19937 random_{5};
  std::normal_distribution<double> normal_;
};

/** Walks on at 1 m/s, ten scans a second; turns to and fro if it may. */
std::pair<std::size_t, PointColumns> walk(
    OwnBody& body, bool with_carrier, double seconds, double turns, double speed = 1.0)
{
  Corridor corridor(with_carrier);
  std::size_t masked = 0;
  PointColumns last;
  for (int i = 0; i < static_cast<int>(10.0 * seconds); ++i)
  {
    const double t = 0.1 * i;
    const Pose T{expSO3({0.0, 0.0, turns * std::sin(0.6 * t)}), {speed * t, 0.3, 0.0}};
    last = corridor.scan(T);
    body.look(last);
    masked = body.mask(last);
    body.judge(T, true);
  }
  return {masked, last};
}

TEST(OwnBody, IsMaskedAfterSomeTurns)
{
  OwnBody body;
  const auto [masked, points] = walk(body, true, 40.0, 0.6);
  ASSERT_TRUE(body.found());
  std::size_t left = 0;
  for (const float intensity : points.intensity)
    left += intensity > 0.0F ? 1 : 0;
  constexpr std::size_t kOnCarrier = 16UL * 31, kAll = 16UL * 360;
  EXPECT_LT(left, kOnCarrier / 20);
  EXPECT_LE(masked, kOnCarrier) << "walls were masked";
  EXPECT_EQ(points.size() + masked, kAll);
  const auto place = body.takeReport();
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->nearest, 0.6, 0.05);
  EXPECT_NEAR(std::abs(place->azimuth), M_PI, 0.1);
  EXPECT_FALSE(body.takeReport()) << "once is enough";
}

TEST(OwnBody, IsNoWallOfACorridor)
{
  OwnBody straight, turning;
  walk(straight, false, 45.0, 0.0);
  EXPECT_FALSE(straight.found());
  walk(turning, false, 45.0, 0.6);
  EXPECT_FALSE(turning.found());
  EXPECT_FALSE(turning.takeReport());
}

TEST(OwnBody, IsNotGuessedWhereNothingMoves)
{
  OwnBody resting, straight;
  walk(resting, true, 20.0, 0.0, 0.0);
  EXPECT_FALSE(resting.found());
  // All that was behind the carrier stays hidden behind it.
  walk(straight, true, 20.0, 0.0);
  EXPECT_FALSE(straight.found());
}

TEST(OwnBody, IsNotJudgedByPosesThatAreNotTracked)
{
  OwnBody body;
  Corridor corridor(true);
  for (int i = 0; i < 300; ++i)
  {
    const Pose T{expSO3({0.0, 0.0, 0.6 * std::sin(0.06 * i)}), {0.1 * i, 0.3, 0.0}};
    body.look(corridor.scan(T));
    body.judge(T, false);
  }
  EXPECT_FALSE(body.found());
}

TEST(DirectionCells, AreAroundTheirMiddle)
{
  for (std::size_t cell = 0; cell < DirectionCells::kCount; ++cell)
  {
    const Vec3 d = DirectionCells::middle(cell);
    ASSERT_EQ(
        DirectionCells::of(
            static_cast<float>(d.x()), static_cast<float>(d.y()), static_cast<float>(d.z())),
        cell);
    for (const std::size_t near : DirectionCells::around(cell))
      EXPECT_GT(DirectionCells::middle(near).dot(d), std::cos(0.12)) << cell;
    EXPECT_EQ(DirectionCells::around(cell)[0], cell);
  }
}
}  // namespace
}  // namespace fastlio
