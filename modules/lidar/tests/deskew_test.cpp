// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/lidar/deskew.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace fastlio
{
namespace
{
constexpr std::int64_t kEnd = 1'700'000'000'100'000'000;
constexpr std::int64_t kLength = 100'000'000;  // of a scan [ns]
constexpr double kRange = 10.0;                // of all points [m]

Pose mounting()
{
  return {expSO3({0.4, -2.0, 1.1}), {0.3, -0.1, 0.2}};
}

/** Motion over a scan: turning at about the rate, accelerating, with samples every so often. */
std::vector<MotionKnot> motion(double rate, std::int64_t period_ns, unsigned seed = 1)
{
  std::mt19937 rng(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(rng), normal(rng), normal(rng)); };
  const Vec3 axis = vector().normalized();
  std::vector<ImuSample> samples;
  for (std::int64_t t = kEnd - kLength; t < kEnd; t += period_ns)
    samples.push_back({t, rate * (axis + 0.05 * vector()), 5.0 * vector()});
  NavState end;
  end.R = expSO3(vector());
  end.v = 3.0 * vector();
  std::vector<MotionKnot> knots;
  backwardPropagate(end, kEnd, samples, knots);
  return knots;
}

LidarScan scanOver(std::int32_t first_offset_ns, std::int32_t last_offset_ns, int count)
{
  std::mt19937 rng(2);
  std::normal_distribution<double> normal;
  LidarScan scan;
  scan.stamp_ns = kEnd - kLength;
  scan.T_imu_lidar = mounting();
  for (int i = 0; i < count; ++i)
  {
    const Vec3 p = kRange * Vec3(normal(rng), normal(rng), normal(rng)).normalized();
    const double fraction = double(i) / double(count - 1);
    const double offset = first_offset_ns + fraction * (double(last_offset_ns) - first_offset_ns);
    scan.points.push_back(float(p.x()), float(p.y()), float(p.z()), 0.0F, std::int32_t(offset), 0);
  }
  return scan;
}

std::vector<std::uint32_t> allOf(const LidarScan& scan)
{
  std::vector<std::uint32_t> indices(scan.points.size());
  std::iota(indices.begin(), indices.end(), 0U);
  return indices;
}

Vec3 pointOf(const LidarScan& scan, std::size_t j)
{
  return {scan.points.x[j], scan.points.y[j], scan.points.z[j]};
}

Vec3 positionOf(const BodyPoints& body, std::size_t i)
{
  return {body.x[i], body.y[i], body.z[i]};
}

Vec3 beamOf(const BodyPoints& body, std::size_t i)
{
  return {body.ux[i], body.uy[i], body.uz[i]};
}

void deskew(
    const LidarScan& scan, const std::vector<std::uint32_t>& indices,
    const std::vector<MotionKnot>& knots, BodyPoints& body)
{
  Deskewer().deskew(scan, indices, knots, body);
}

void transformToBody(
    const LidarScan& scan, const std::vector<std::uint32_t>& indices, BodyPoints& body)
{
  Deskewer().transformToBody(scan, indices, body);
}

struct WorstErrors
{
  double position = 0.0;  // [m]
  double beam = 0.0;
};

/** Largest distance from eq. 10 with the exact pose at each point's own time. */
WorstErrors worstErrors(const LidarScan& scan, const std::vector<MotionKnot>& knots)
{
  BodyPoints body;
  deskew(scan, allOf(scan), knots, body);
  WorstErrors worst;
  for (std::size_t j = 0; j < scan.points.size(); ++j)
  {
    const Pose T_end_then = bodyPoseAt(knots, scan.stamp_ns + scan.points.time_offset_ns[j]);
    const Pose T_end_lidar = T_end_then * scan.T_imu_lidar;
    const Vec3 p = pointOf(scan, j);
    worst.position = std::max(worst.position, (positionOf(body, j) - T_end_lidar * p).norm());
    worst.beam = std::max(worst.beam, (beamOf(body, j) - T_end_lidar.R * p.normalized()).norm());
  }
  return worst;
}

TEST(Deskew, FollowsFastRotation)
{
  // First order within a step: 0.1 mm at 10 m by the rotation, the same by the acceleration.
  const LidarScan scan = scanOver(0, std::int32_t(kLength), 5000);
  for (const double rate : {0.0, 0.1, 1.0, 5.0, 20.0})
    for (const std::int64_t period_ns : {1'250'000, 5'000'000, 10'000'000})
    {
      const WorstErrors worst = worstErrors(scan, motion(rate, period_ns));
      EXPECT_LT(worst.position, 4e-4) << rate << " rad/s, period " << period_ns;
      EXPECT_LT(worst.beam, 2e-5) << rate << " rad/s, period " << period_ns;
    }
}

TEST(Deskew, IsWorthTheEffort)
{
  // Without it points of the scan's begin would be off by metres: the test above can fail.
  const LidarScan scan = scanOver(0, std::int32_t(kLength), 100);
  BodyPoints moved, rigid;
  deskew(scan, allOf(scan), motion(5.0, 5'000'000), moved);
  transformToBody(scan, allOf(scan), rigid);
  EXPECT_GT((positionOf(moved, 0) - positionOf(rigid, 0)).norm(), 1.0);
  EXPECT_LT((positionOf(moved, 99) - positionOf(rigid, 99)).norm(), 1e-4);
}

TEST(Deskew, DoesNotDependOnTheOrderOfPoints)
{
  const LidarScan scan = scanOver(0, std::int32_t(kLength), 3000);
  const auto knots = motion(8.0, 5'000'000);
  BodyPoints in_order, in_disorder;
  deskew(scan, allOf(scan), knots, in_order);
  auto indices = allOf(scan);
  std::shuffle(indices.begin(), indices.end(), std::mt19937(3));
  deskew(scan, indices, knots, in_disorder);
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    EXPECT_EQ(positionOf(in_disorder, i), positionOf(in_order, indices[i]));
    EXPECT_EQ(beamOf(in_disorder, i), beamOf(in_order, indices[i]));
  }
}

void expectSameBytes(const BodyPoints& a, const BodyPoints& b)
{
  EXPECT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z);
  EXPECT_TRUE(a.ux == b.ux && a.uy == b.uy && a.uz == b.uz);
}

TEST(Deskew, GivesTheSameBytesOnAnyNumberOfThreads)
{
  const LidarScan scan = scanOver(0, std::int32_t(kLength), 3000);
  const auto knots = motion(8.0, 5'000'000);
  BodyPoints expected, body;
  Deskewer().deskew(scan, allOf(scan), knots, expected);
  for (const int threads : {2, 3, 5})
  {
    Deskewer deskewer(std::make_shared<const Workers>(threads));
    deskewer.deskew(scan, allOf(scan), knots, body);
    expectSameBytes(body, expected);
  }
  Deskewer().transformToBody(scan, allOf(scan), expected);
  Deskewer(std::make_shared<const Workers>(2)).transformToBody(scan, allOf(scan), body);
  expectSameBytes(body, expected);
}

TEST(Deskew, TakesTheChosenPointsOnly)
{
  const LidarScan scan = scanOver(0, std::int32_t(kLength), 1000);
  const auto knots = motion(3.0, 5'000'000);
  BodyPoints all, some;
  deskew(scan, allOf(scan), knots, all);
  deskew(scan, {999, 5, 5, 400}, knots, some);
  ASSERT_EQ(some.size(), 4U);
  EXPECT_EQ(positionOf(some, 0), positionOf(all, 999));
  EXPECT_EQ(positionOf(some, 1), positionOf(all, 5));
  EXPECT_EQ(positionOf(some, 2), positionOf(all, 5));
  EXPECT_EQ(positionOf(some, 3), positionOf(all, 400));
  deskew(scan, {}, knots, some);
  EXPECT_EQ(some.size(), 0U);
}

TEST(Deskew, MovesPointsOutsideOfTheKnotsWithTheNearestStep)
{
  // 3 ms before the first and after the last knot, at 2 rad/s: second order, 10 m * 0.01^2 / 2, and
  // as much again by the acceleration.
  const LidarScan scan = scanOver(-3'000'000, std::int32_t(kLength) + 3'000'000, 2000);
  EXPECT_LT(worstErrors(scan, motion(2.0, 5'000'000)).position, 1e-3);
}

TEST(Deskew, PointsFarOutsideStayFinite)
{
  const LidarScan scan = scanOver(-2'000'000'000, 2'000'000'000, 200);
  BodyPoints body;
  deskew(scan, allOf(scan), motion(20.0, 5'000'000), body);
  for (std::size_t i = 0; i < body.size(); ++i)
    EXPECT_TRUE(positionOf(body, i).allFinite() && beamOf(body, i).allFinite());
}

TEST(Deskew, WithoutMotionDataAppliesTheMountingOnly)
{
  const LidarScan scan = scanOver(0, std::int32_t(kLength), 100);
  BodyPoints expected, without_knots, one_knot;
  transformToBody(scan, allOf(scan), expected);
  deskew(scan, allOf(scan), {}, without_knots);
  deskew(scan, allOf(scan), {MotionKnot{}}, one_knot);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_EQ(positionOf(without_knots, i), positionOf(expected, i));
    EXPECT_EQ(positionOf(one_knot, i), positionOf(expected, i));
  }
}

TEST(TransformToBody, AppliesTheMounting)
{
  const LidarScan scan = scanOver(0, std::int32_t(kLength), 500);
  BodyPoints body;
  transformToBody(scan, allOf(scan), body);
  for (std::size_t j = 0; j < body.size(); ++j)
  {
    const Vec3 p = pointOf(scan, j);
    EXPECT_LT((positionOf(body, j) - mounting() * p).norm(), 3e-6);
    EXPECT_LT((beamOf(body, j) - mounting().R * p.normalized()).norm(), 1e-6);
  }
}
}  // namespace
}  // namespace fastlio
