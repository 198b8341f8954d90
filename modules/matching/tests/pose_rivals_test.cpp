// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/matching/pose_search.h>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace fastlio
{
namespace
{
constexpr double kRise = 0.17;  // of a step [m]

/** Where a match ends, and what it shows there. */
struct Height
{
  double z = 0.0;  // [m]
  double information = 0.0;
  double innovation = 1.0;  // mean z^2/r
};

/** Walls fit everywhere: \a at says what a match makes of the height where it starts. */
MatchFromStarts betweenWalls(const std::function<Height(double)>& at)
{
  return [at](const std::vector<PoseStart>& starts, const DeskewedScan&, int)
  {
    std::vector<PoseMatch> matches;
    for (const PoseStart& start : starts)
    {
      const Height height = at(start.T_world_imu.p.z());
      PoseMatch match;
      match.updated = true;
      match.T_world_imu.p = {0.0, 0.0, height.z};
      match.sums.count = 1000;
      match.sums.weighted_squares = 1000.0 * height.innovation;
      match.sums.HtRinvH.bottomRightCorner<3, 3>() =
          Vec3(1e7, 1e7, height.information).asDiagonal();
      matches.push_back(match);
    }
    return matches;
  };
}

Height onSteps(double z)
{
  const double step = kRise * std::round(z / kRise);
  const bool on_step = std::abs(z - step) < 0.06;
  return {on_step ? step : z, on_step ? 1e6 : 0.0};
}

FilterState predictionAt(double z, double std)
{
  FilterState s;
  s.x.p.z() = z;
  s.P.diagonal().setConstant(1e-6);
  s.P(kPosition + 2, kPosition + 2) = std * std;
  return s;
}

Vec3 rivalAt(double z, double std, const std::function<Height(double)>& at)
{
  return farthestRival(predictionAt(z, std), Pose(), DeskewedScan(), betweenWalls(at));
}

// A scan in a stairwell fitted as well two steps lower: 0.3 m off, at a deviation of 0.03 m.
TEST(FarthestRival, IsTheFarthestStepThatThePredictionAllows)
{
  EXPECT_NEAR(rivalAt(0.1, 0.1, onSteps).z(), 2.0 * kRise, 1e-9) << "0.4 m are three sigma";
  EXPECT_NEAR(rivalAt(-0.2, 0.1, onSteps).z(), -3.0 * kRise, 0.02 + 1e-9);
  EXPECT_EQ(rivalAt(0.0, 0.03, onSteps), Vec3::Zero().eval()) << "the next step is excluded";
}

TEST(FarthestRival, IsNoneWhereWallsFitBesideTheFloor)
{
  const auto on_floor = [](double z) -> Height {
    return std::abs(z) < 0.06 ? Height{0.0, 1e6} : Height{z, 1e3};
  };
  EXPECT_EQ(rivalAt(0.1, 0.2, on_floor), Vec3::Zero().eval());
}

TEST(FarthestRival, IsNoneWhereThePointsDoNotFit)
{
  const auto badly = [](double z) -> Height
  {
    Height height = onSteps(z);
    if (height.z != 0.0) height.innovation = 10.0;
    return height;
  };
  EXPECT_EQ(rivalAt(0.1, 0.2, badly), Vec3::Zero().eval());
}

// What the scan does not show stays as uncertain as it is predicted.
TEST(FarthestRival, IsNotSoughtAlongAnOpenDirection)
{
  const auto open = [](double z) -> Height { return {z, 1.0}; };
  EXPECT_EQ(rivalAt(0.1, 0.2, open), Vec3::Zero().eval());
}

FilterState movingPrediction()
{
  FilterState s;
  const StateMatrix A = StateMatrix::Random();
  s.P = A * A.transpose() + 1e-3 * StateMatrix::Identity();
  return s;
}

// The position was found beside the right one, and the velocity was corrected by the difference.
TEST(IndependentPosition, DoesNotCorrectTheVelocity)
{
  const FilterState predicted = movingPrediction();
  const Pose found{predicted.x.R, predicted.x.p + Vec3(0.2, -0.1, 0.3)};
  const FilterState moved = correctedByPose(predicted, found);
  EXPECT_GT((moved.x.v - predicted.x.v).norm(), 1e-3);
  const FilterState corrected =
      correctedByPose(withIndependentPosition(predicted, Mat3::Identity()), found);
  EXPECT_LT((corrected.x.p - found.p).norm(), 0.05);
  EXPECT_LT((corrected.x.v - predicted.x.v).norm(), 1e-9);
}

TEST(IndependentPosition, IsOneAlongTheGivenDirectionsOnly)
{
  const FilterState s = movingPrediction();
  const Mat3 vertical = Vec3::UnitZ() * Vec3::UnitZ().transpose();
  const FilterState independent = withIndependentPosition(s, vertical);
  StateMatrix expected = s.P;
  const double height = expected(kPosition + 2, kPosition + 2);
  expected.row(kPosition + 2).setZero();
  expected.col(kPosition + 2).setZero();
  expected(kPosition + 2, kPosition + 2) = height;
  EXPECT_LT((independent.P - expected).norm(), 1e-12 * expected.norm());
  EXPECT_EQ(independent.P.llt().info(), Eigen::Success);
  EXPECT_LT((withIndependentPosition(s, Mat3::Zero()).P - s.P).norm(), 1e-12 * s.P.norm());
}

}  // namespace
}  // namespace fastlio
