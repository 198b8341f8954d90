// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/loops/corrected_trajectory.h>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::int64_t kSecond = 1'000'000'000;

ScanResult scanAt(std::int64_t stamp_ns, const Pose& T_world_imu)
{
  ScanResult scan;
  scan.status = ScanStatus::Tracking;
  scan.stamp_ns = stamp_ns;
  scan.filter.x.R = T_world_imu.R;
  scan.filter.x.p = T_world_imu.p;
  return scan;
}

/** Two sessions of a submap each; the second begins where its own odometry has its origin. */
MappingResult twoSessions(const Pose& T_world_second)
{
  MappingResult result;
  result.submaps.resize(2);
  result.submaps[0].reference.stamp_ns = kSecond;
  result.submaps[1].session = 1;
  result.submaps[1].reference.stamp_ns = kSecond;
  result.anchors = {{true, Pose{}, 1.0, 0, 0}, {true, T_world_second, 0.99, 5, 2}};
  result.estimate.nodes = {Pose{}, T_world_second};
  result.estimate.covariances.assign(2, Matrix6::Identity() * 1e-4);
  return result;
}
}  // namespace

/** Without any closure, a session that was found in the map of another lies in that map. */
TEST(CorrectedTrajectory, ASessionThatWasPlacedMoves)
{
  const Pose T_world_second{expSO3({0.0, 0.0, 0.8}), {12.0, -3.0, 0.5}};
  const MappingResult result = twoSessions(T_world_second);
  ASSERT_FALSE(result.corrected);
  const Pose odometry{expSO3({0.0, 0.0, 0.1}), {1.0, 2.0, 0.0}};
  const ScanResult scan = scanAt(2 * kSecond, odometry);

  const ScanResult first = CorrectedTrajectory(result, 0).corrected(scan);
  EXPECT_EQ(first.filter.x.p, odometry.p);
  EXPECT_EQ(first.filter.x.R, odometry.R);

  const CorrectedTrajectory second(result, 1);
  EXPECT_TRUE(second.changes());
  const Pose expected = T_world_second * odometry;
  EXPECT_LT((second.corrected(scan).filter.x.p - expected.p).norm(), 1e-9);
  const Pose correction = second.correctionAt(scan.stamp_ns, odometry);
  EXPECT_LT((correction.p - T_world_second.p).norm(), 1e-9);
}

/** A map that turns takes the whole state along: what the body feels of its velocity and of gravity
 * stays the same, and so does what is known of them. */
TEST(CorrectedTrajectory, VelocityAndGravityTurnWithThePose)
{
  const Pose T_world_second{expSO3({0.3, -0.2, 0.8}), {12.0, -3.0, 0.5}};
  ScanResult scan = scanAt(2 * kSecond, {expSO3({0.0, 0.1, 0.1}), {1.0, 2.0, 0.0}});
  NavState& x = scan.filter.x;
  x.v = {3.0, -1.0, 0.2};
  x.g = {0.3, 0.2, -9.8};
  x.accel_bias = {0.01, 0.02, 0.03};
  const StateMatrix root = StateMatrix::Random();
  scan.filter.P = 1e-4 * (root * root.transpose() + StateMatrix::Identity());
  const FilterState& before = scan.filter;
  const FilterState after =
      CorrectedTrajectory(twoSessions(T_world_second), 1).corrected(scan).filter;
  EXPECT_LT((after.x.R.transpose() * after.x.v - x.R.transpose() * x.v).norm(), 1e-9);
  EXPECT_LT((after.x.R.transpose() * after.x.g - x.R.transpose() * x.g).norm(), 1e-9);
  EXPECT_EQ(after.x.accel_bias, x.accel_bias);
  const auto inBody = [](const FilterState& filter, int row, int column) -> Mat3
  { return filter.x.R.transpose() * filter.P.block<3, 3>(row, column) * filter.x.R; };
  const std::vector<std::pair<int, int>> blocks = {
      {kVelocity, kVelocity}, {kGravity, kGravity}, {kVelocity, kGravity}};
  for (const auto& [row, column] : blocks)
    EXPECT_LT((inBody(after, row, column) - inBody(before, row, column)).norm(), 1e-9)
        << row << ", " << column;
  const Mat3 by_bias = after.x.R.transpose() * after.P.block<3, 3>(kVelocity, kAccelBias);
  const Mat3 by_bias_before = x.R.transpose() * before.P.block<3, 3>(kVelocity, kAccelBias);
  EXPECT_LT((by_bias - by_bias_before).norm(), 1e-9);
  EXPECT_LT((after.P - after.P.transpose()).norm(), 1e-9);
}

/** What two rigs whose LiDARs are mounted a bit otherwise than they say make of the poses of the
 * second one in the map of the first one, and what the covariance says of it. */
TEST(CorrectedTrajectory, AnotherRigHasAnErrorOfItsOwn)
{
  constexpr double kTurned = 0.005, kMoved = 0.01;  // of the LiDARs [rad], [m]
  constexpr int kRigs = 2000;
  const Pose T_world_second{expSO3({0.1, 0.0, 0.3}), {12.0, -3.0, 0.5}};
  MappingResult map = twoSessions(T_world_second);
  map.estimate.covariances.assign(2, Matrix6::Identity() * 1e-12);
  for (Submap& submap : map.submaps)
  {
    submap.calibration_moment.diagonal().head<3>().setConstant(
        static_cast<float>(kTurned * kTurned));
    submap.calibration_moment.diagonal().segment<3>(3).setConstant(
        static_cast<float>(kMoved * kMoved));
  }
  const Matrix6 other =
      CorrectedTrajectory(map, 1).corrected(scanAt(kSecond, Pose{})).filter.P.topLeftCorner<6, 6>();
  map.rigs = {0, 0};
  const Matrix6 same =
      CorrectedTrajectory(map, 1).corrected(scanAt(kSecond, Pose{})).filter.P.topLeftCorner<6, 6>();

  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  const auto error = [&]
  {
    const auto vector = [&](double std)
    {
      const double x = normal(engine), y = normal(engine), z = normal(engine);
      return Vec3(std * x, std * y, std * z);
    };
    const Vec3 turn = vector(kTurned);
    return Pose{expSO3(turn), vector(kMoved)};
  };
  double nees = 0.0;
  for (int i = 0; i < kRigs; ++i)
  {
    const Pose of_first = error(), of_second = error();
    const Pose found = of_first * T_world_second * of_second.inverse();
    Vector6 e;
    e << logSO3(found.R.transpose() * T_world_second.R), T_world_second.p - found.p;
    nees += e.dot(other.ldlt().solve(e)) / kRigs;
  }
  EXPECT_NEAR(nees, 6.0, 0.5);
  EXPECT_LT(same(2, 2), 0.2 * other(2, 2)) << "turned by little, most of one error cancels";
}

}  // namespace fastlio
