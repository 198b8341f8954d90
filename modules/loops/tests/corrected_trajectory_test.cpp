// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/loops/corrected_trajectory.h>

#include <gtest/gtest.h>

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

}  // namespace fastlio
