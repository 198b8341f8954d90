// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/loops/mapper.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::size_t kStraight = 20, kSteps = 2 * kStraight;    // then it turns left
constexpr double kStepLength = 2.5, kTurn = 1.5707963267948966;  // [m], [rad]
constexpr int kGyroScaleZ = 14;  // third element of the third column of the gyro's matrix

/** The poses of a road as a gyro measures it whose scale is off by so much. */
std::vector<Pose> roadBy(double scale_error)
{
  std::vector<Pose> poses(1);
  for (std::size_t i = 0; i < kSteps; ++i)
  {
    const double turn = i < kStraight ? 0.0 : kTurn / kStraight;
    const Pose step{expSO3({0.0, 0.0, (1.0 + scale_error) * turn}), {kStepLength, 0.0, 0.0}};
    poses.push_back(poses.back() * step);
  }
  return poses;
}

/** The submaps of a road, without surfaces. \param std of the scale error, as the odometry knows it
 */
MappingResult mapOf(double scale_error, double std, std::size_t session = 0)
{
  constexpr double kSmall = 1e-5;
  const std::vector<Pose> odometry = roadBy(scale_error), more = roadBy(scale_error + kSmall);
  Mapper mapper;
  for (std::size_t i = 0; i < odometry.size(); ++i)
  {
    Submap submap;
    submap.session = session;
    submap.reference.stamp_ns = static_cast<std::int64_t>(i + 1) * 1'000'000'000;
    submap.reference.T_world_body = odometry[i];
    submap.reference.covariance = 1e-10 * Matrix6::Identity();
    Vector6 change;
    change << logSO3(odometry[i].R.transpose() * more[i].R), more[i].p - odometry[i].p;
    submap.pose_by_calibration.col(kGyroScaleZ) = (change / kSmall).cast<float>();
    submap.calibration_moment(kGyroScaleZ, kGyroScaleZ) = static_cast<float>(std * std);
    submap.travel = kStepLength * static_cast<double>(i);
    submap.range = 20.0;
    mapper.add(std::move(submap));
  }
  return std::move(mapper).result();
}

double headingStd(const MappingResult& result, std::size_t node)
{
  return std::sqrt(result.estimate.covariances.at(node)(2, 2));
}
}  // namespace

/** The odometry may find no pose in the first recording. */
TEST(SessionErrors, SessionsBeforeTheFirstSubmapHaveNone)
{
  const MappingResult alone = mapOf(0.01, 0.02), second = mapOf(0.01, 0.02, 1);
  ASSERT_EQ(second.estimate.nodes.size(), alone.estimate.nodes.size());
  for (std::size_t i = 0; i < alone.estimate.nodes.size(); ++i)
    EXPECT_LT((second.estimate.nodes[i].p - alone.estimate.nodes[i].p).norm(), 1e-6) << i;
}

/** Motions that share an error do not average it out: 40 independent ones of the same size would
 * give the 20th part of it. */
TEST(SessionErrors, OfTheGyroAddUpWhereTheRoadTurns)
{
  constexpr double kStd = 0.01;
  const MappingResult known = mapOf(0.0, 0.0), unknown = mapOf(0.0, kStd);
  const auto by_gyro = [&](std::size_t node)
  {
    return std::sqrt(std::pow(headingStd(unknown, node), 2) - std::pow(headingStd(known, node), 2));
  };
  EXPECT_NEAR(by_gyro(kSteps), kStd * kTurn, 0.02 * kStd * kTurn);
  EXPECT_NEAR(by_gyro(kStraight + kStraight / 2), kStd * kTurn / 2.0, 0.02 * kStd * kTurn);
  EXPECT_LT(by_gyro(kStraight), 0.01 * kStd * kTurn);
}

/** An odometry that has lost its pose is sure of nothing, by numbers that have lost all meaning: so
 * says the map, but it comes out. */
TEST(SessionErrors, OfALostOdometryLeaveTheGraphSolvable)
{
  Mapper mapper;
  for (std::size_t i = 0; i < kSteps; ++i)
  {
    Submap submap;
    const auto at = static_cast<double>(i);
    const double lost = i < kStraight ? 1.0 : std::pow(10.0, at - kStraight);
    submap.reference.stamp_ns = static_cast<std::int64_t>(i + 1) * 1'000'000'000;
    submap.reference.T_world_body.p = {kStepLength * at, 0.1 * std::min(lost, 1e3), 0.0};
    submap.reference.covariance = 1e-10 * lost * lost * Matrix6::Identity();
    submap.pose_by_calibration.setConstant(static_cast<float>(1e-3 * lost));
    submap.calibration_moment.setIdentity();
    submap.calibration_moment *= 1e-4F;
    submap.travel = kStepLength * at;
    submap.range = 20.0;
    submap.gravity =
        GravityReading{{0.1 * std::sin(at), 0.0, 9.81}, Mat3::Identity(), 1e-4 * Mat3::Identity()};
    mapper.add(std::move(submap));
  }
  const MappingResult result = std::move(mapper).result();
  ASSERT_EQ(result.estimate.covariances.size(), kSteps);
  for (const Matrix6& covariance : result.estimate.covariances)
    EXPECT_TRUE(covariance.allFinite());
  EXPECT_GT(result.estimate.covariances.back()(4, 4), 1e6);
}

/** Readings of gravity tell the graph of a drift. As long as nothing corrects the map, its poses
 * and the motions between them are those of the odometry all the same. */
TEST(SessionErrors, AreNotTakenOffWhereNothingIsCorrected)
{
  Mapper mapper;
  for (std::size_t i = 0; i < kSteps; ++i)
  {
    Submap submap;
    const auto at = static_cast<double>(i);
    submap.reference.stamp_ns = static_cast<std::int64_t>(i + 1) * 1'000'000'000;
    submap.reference.T_world_body.p.x() = kStepLength * at;
    submap.reference.covariance = 1e-10 * Matrix6::Identity();
    submap.travel = kStepLength * at;
    submap.range = 20.0;
    const double pitch = 1e-4 * submap.travel;
    submap.gravity = GravityReading{
        9.81 * Vec3(-std::sin(pitch), 0.0, std::cos(pitch)), Mat3::Identity(),
        1e-4 * Mat3::Identity()};
    mapper.add(std::move(submap));
  }
  const MappingResult result = std::move(mapper).result();
  ASSERT_FALSE(result.corrected);
  GraphEstimate optimum = optimize(result.graph);
  ASSERT_GT(optimum.sensor_errors.at(0).head<6>().norm(), 1e-5);
  const GraphEdge& edge = result.graph.edges.front();
  EXPECT_EQ(withoutSensorErrors(edge, result.estimate).T_a_b.p, edge.measured.T_a_b.p);
  EXPECT_EQ(withoutSensorErrors(edge, result.estimate).T_a_b.R, edge.measured.T_a_b.R);
  EXPECT_GT(
      withoutSensorErrors(edge, result.estimate).covariance(1, 1), edge.measured.covariance(1, 1));
}

/** One measurement from end to end shows which error it was, and so corrects all poses between. */
TEST(SessionErrors, OfTheGyroAreFoundByTheGraph)
{
  constexpr double kError = 0.01;
  PoseGraph graph = mapOf(kError, kError).graph;
  const std::vector<Pose> truth = roadBy(0.0);
  graph.edges.push_back({0, kSteps, {truth.back(), 1e-8 * Matrix6::Identity()}, false});
  const GraphEstimate found = optimize(graph);
  double odometry = 0.0, corrected = 0.0;  // largest error [m]
  for (std::size_t i = 0; i <= kSteps; ++i)
  {
    odometry = std::max(odometry, (graph.nodes[i].p - truth[i].p).norm());
    corrected = std::max(corrected, (found.nodes[i].p - truth[i].p).norm());
  }
  EXPECT_GT(odometry, 0.3);
  EXPECT_LT(corrected, 0.05);
}

}  // namespace fastlio
