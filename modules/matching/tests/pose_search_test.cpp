// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/matching/pose_search.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace fastlio
{
namespace
{
FilterState predictionWithStd(double x, double y, double z)
{
  FilterState s;
  s.P.diagonal().setConstant(1e-6);
  s.P.diagonal().segment<3>(kPosition) = Vec3(x * x, y * y, z * z);
  return s;
}

/** A scan of points that do not matter: the matcher of these tests looks at the start only. */
DeskewedScan someScan(std::size_t points)
{
  DeskewedScan scan;
  scan.surfaces.resize(points);
  return scan;
}

/** Pulls starts within half a metre of a place there, with so many matches of a hundred. */
struct Place
{
  Vec3 p;
  double inlier_ratio;
};
MatchFromStarts matcherWith(const std::vector<Place>& places)
{
  const auto one = [places](const PoseStart& start, const DeskewedScan& scan)
  {
    PoseMatch match;
    match.T_world_imu = start.T_world_imu;
    for (const Place& place : places)
    {
      if ((place.p - start.T_world_imu.p).norm() > 0.5) continue;
      match.updated = true;
      match.T_world_imu.p = place.p;
      const double count = place.inlier_ratio * static_cast<double>(scan.surfaces.size());
      match.sums.count = static_cast<std::size_t>(count);
      match.sums.weighted_squares = static_cast<double>(match.sums.count);
      return match;
    }
    return match;
  };
  return [one](const std::vector<PoseStart>& starts, const DeskewedScan& scan, int /*iterations*/)
  {
    std::vector<PoseMatch> matches;
    matches.reserve(starts.size());
    for (const PoseStart& start : starts)
      matches.push_back(one(start, scan));
    return matches;
  };
}

TEST(PoseSearch, LooksAtThePredictionAloneWhenItIsCertain)
{
  const auto offsets = candidateGrid(predictionWithStd(0.01, 0.02, 0.01), 3000).offsets;
  ASSERT_EQ(offsets.size(), 1U);
  EXPECT_EQ(offsets[0], Vec3::Zero().eval());
}

TEST(PoseSearch, CoversThreeStandardDeviationsTheLikeliestFirst)
{
  const FilterState s = predictionWithStd(1.0, 0.5, 0.1);
  const CandidateGrid grid = candidateGrid(s, 3000);
  EXPECT_TRUE(grid.complete);
  const auto& offsets = grid.offsets;
  EXPECT_EQ(offsets[0], Vec3::Zero().eval());
  for (const Vec3& wanted : {Vec3(3, 0, 0), Vec3(0, -1.5, 0), Vec3(0.7, 0.9, 0.1)})
  {
    double nearest = 1e9;
    for (const Vec3& offset : offsets)
      nearest = std::min(nearest, (offset - wanted).norm());
    EXPECT_LE(nearest, 0.25 * std::sqrt(3.0) + 1e-9) << wanted.transpose();
  }
  for (std::size_t i = 1; i < offsets.size(); ++i)
    EXPECT_LE(std::abs(offsets[i].z()), 0.5) << "along z the prediction is certain";
}

TEST(PoseSearch, IsBoundedHoweverUncertainThePredictionIs)
{
  for (const double std : {3.0, 1e6, std::numeric_limits<double>::quiet_NaN()})
  {
    const CandidateGrid grid = candidateGrid(predictionWithStd(std, std, std), 230);
    EXPECT_LE(grid.offsets.size(), 230U);
    EXPECT_FALSE(grid.complete) << std;
  }
}

TEST(PoseSearch, WidensTheGridBeforeItLeavesPlacesOut)
{
  const CandidateGrid grid = candidateGrid(predictionWithStd(2.0, 2.0, 2.0), 3000);
  EXPECT_TRUE(grid.complete);
  EXPECT_EQ(grid.step, 1.0);
}

TEST(PoseSearch, FindsThePlaceThatMatches)
{
  const FilterState s = predictionWithStd(1.0, 1.0, 0.1);
  const Vec3 truth(1.3, -0.8, 0.05);
  const auto result = searchPose(s, {s.x.R}, someScan(1000), {}, matcherWith({{truth, 0.8}}));
  ASSERT_TRUE(result.accepted);
  EXPECT_EQ(result.best->T_world_imu.p, truth);
  EXPECT_DOUBLE_EQ(result.best->inlier_ratio, 0.8);
}

TEST(PoseSearch, RefusesFewMatches)
{
  const FilterState s = predictionWithStd(1.0, 1.0, 0.1);
  const auto result = searchPose(s, {s.x.R}, someScan(1000), {}, matcherWith({{{1, 1, 0}, 0.2}}));
  EXPECT_FALSE(result.accepted);
  ASSERT_TRUE(result.best);
  EXPECT_DOUBLE_EQ(result.best->inlier_ratio, 0.2);
}

TEST(PoseSearch, RefusesToChooseBetweenRivals)
{
  const FilterState s = predictionWithStd(1.0, 1.0, 0.1);
  const auto two = [&](double second)
  {
    return searchPose(
        s, {s.x.R}, someScan(1000), {}, matcherWith({{{1.5, 0, 0}, 0.8}, {{-1.5, 0, 0}, second}}));
  };
  EXPECT_FALSE(two(0.75).accepted);
  EXPECT_TRUE(two(0.4).accepted);
}

// A stairwell repeats itself from floor to floor: the floor that matches is not the one where the
// platform is if the prediction excludes it, and yet it says that the map cannot be trusted here.
TEST(PoseSearch, APlaceThatThePredictionExcludesIsNotAcceptedButIsARival)
{
  const FilterState s = predictionWithStd(0.3, 0.3, 0.3);
  const Vec3 excluded(0, 0, 1.35), possible(0.6, 0, -0.3);
  const auto far = searchPose(s, {s.x.R}, someScan(1000), {}, matcherWith({{excluded, 0.8}}));
  ASSERT_TRUE(far.best);
  EXPECT_FALSE(far.accepted);
  const auto both = [&](double excluded_ratio)
  {
    return searchPose(
        s, {s.x.R}, someScan(1000), {}, matcherWith({{excluded, excluded_ratio}, {possible, 0.6}}));
  };
  EXPECT_FALSE(both(0.8).accepted);
  const auto found = both(0.3);
  ASSERT_TRUE(found.accepted);
  EXPECT_EQ(found.best->T_world_imu.p, possible);
  EXPECT_DOUBLE_EQ(found.searched_std, 0.3);
}

// Too many places in space: those on the level of the best one are tried farther away.
TEST(PoseSearch, LooksForRivalsOnTheLevelWhereItCannotLookEverywhere)
{
  const FilterState s = predictionWithStd(5.0, 5.0, 5.0);
  EXPECT_FALSE(candidateGrid(s, 3000).complete);
  const auto found = [&](const std::vector<Place>& places)
  { return searchPose(s, {s.x.R}, someScan(1000), {}, matcherWith(places)); };
  const Vec3 near(1, 0, 2), far(1, 13, 2);
  EXPECT_TRUE(found({{near, 0.6}}).accepted);
  EXPECT_FALSE(found({{near, 0.45}}).accepted) << "more evidence is needed";
  EXPECT_FALSE(found({{near, 0.6}, {far, 0.55}}).accepted);
  EXPECT_TRUE(found({{near, 0.6}, {far, 0.3}}).accepted);
}

// Rooms repeat: who cannot look everywhere does not know whether the best place is the only one.
TEST(PoseSearch, AcceptsNothingWhenNotEvenTheLevelCanBeSearched)
{
  const FilterState s = predictionWithStd(20.0, 20.0, 20.0);
  const auto result = searchPose(s, {s.x.R}, someScan(1000), {}, matcherWith({{{1, 0, 0}, 0.9}}));
  EXPECT_TRUE(result.best);
  EXPECT_FALSE(result.complete);
  EXPECT_FALSE(result.accepted);
}

TEST(PoseSearch, AnotherHeadingAtTheSamePlaceIsARival)
{
  const FilterState s = predictionWithStd(0.1, 0.1, 0.1);
  const Mat3 R = expSO3({0.0, 0.0, 0.5});
  EXPECT_FALSE(
      searchPose(s, {s.x.R, R}, someScan(1000), {}, matcherWith({{{0, 0, 0}, 0.9}})).accepted);
}

TEST(PoseSearch, FindsNothingInAnEmptyScanOrMap)
{
  const FilterState s = predictionWithStd(1.0, 1.0, 0.1);
  EXPECT_FALSE(searchPose(s, {s.x.R}, someScan(0), {}, matcherWith({{{0, 0, 0}, 1.0}})).best);
  EXPECT_FALSE(searchPose(s, {s.x.R}, someScan(100), {}, matcherWith({})).best);
}

TEST(UnmodelledAcceleration, GrowsWithTheTimeAndKeepsTheCovariancePositive)
{
  FilterState s = predictionWithStd(0.01, 0.01, 0.01);
  const StateMatrix before = s.P;
  considerUnmodelledAcceleration(s, 0.1);
  EXPECT_EQ(s.P, before);
  considerUnmodelledAcceleration(s, 10.0);
  // 0.05 m/s^2 for 10 s.
  EXPECT_NEAR(std::sqrt(s.P(kPosition, kPosition)), 2.5, 0.01);
  EXPECT_NEAR(std::sqrt(s.P(kVelocity, kVelocity)), 0.5 * std::sqrt(15.0 / 16.0), 0.01);
  EXPECT_TRUE(needsPoseSearch(s, 10.0));
  EXPECT_FALSE(needsPoseSearch(s, 0.1)) << "uncertain along a tunnel, but not blind";
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(s.P)};
  EXPECT_GE(solver.eigenvalues().minCoeff(), 0.0);
}

TEST(NeedsPullIn, WhereTheScanSeesWhatThePredictionDoesNotKnow)
{
  FilterState s;
  s.P = 1e-6 * StateMatrix::Identity();
  EXPECT_FALSE(needsPullIn(s, false));
  s.P(kPosition, kPosition) = 100.0;
  EXPECT_FALSE(needsPullIn(s, true)) << "along a tunnel";
  EXPECT_TRUE(needsPullIn(s, false)) << "at its end";
  s.P(kPosition + 2, kPosition + 2) = 0.06 * 0.06;
  EXPECT_TRUE(needsPullIn(s, true));
  FilterState tilted;
  tilted.P = 1e-6 * StateMatrix::Identity();
  tilted.P(kAttitude, kAttitude) = 0.006 * 0.006;
  EXPECT_TRUE(needsPullIn(tilted, false)) << "6 cm at points that are 10 m away";
}

// Scans with hardly a point do not end an outage.
TEST(UnmodelledAcceleration, IsTheSameInStepsAsAtOnce)
{
  FilterState s, once;
  s.P.setZero();
  once.P.setZero();
  considerUnmodelledAcceleration(once, 4.0);
  StateMatrix F = StateMatrix::Identity();
  F.block<3, 3>(kPosition, kVelocity) = Mat3::Identity();
  for (int second = 1; second <= 4; ++second)
  {
    s.P = F * s.P * F.transpose();
    considerUnmodelledAcceleration(s, second, second - 1.0);
  }
  EXPECT_TRUE(s.P.isApprox(once.P, 1e-12));
}

TEST(CorrectedByPose, CorrectsTheVelocityThatMadeTheError)
{
  FilterState s;
  s.P.diagonal().setConstant(1e-8);
  considerUnmodelledAcceleration(s, 4.0);
  const Vec3 off(0.4, 0.0, 0.0);  // 0.05 m/s^2 for 4 s
  const FilterState corrected = correctedByPose(s, {s.x.R, s.x.p + off});
  EXPECT_NEAR(corrected.x.p.x(), 0.4, 0.01);
  // A constant acceleration would have made it 0.2, one that changes less.
  EXPECT_NEAR(corrected.x.v.x(), 0.1875, 0.01);
  EXPECT_LT(corrected.P(kPosition, kPosition), 0.04 * 0.04);
  EXPECT_LT(corrected.P(kVelocity, kVelocity), 0.1 * s.P(kVelocity, kVelocity));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(corrected.P)};
  EXPECT_GE(solver.eigenvalues().minCoeff(), -1e-12);
}

TEST(CorrectedByPose, LeavesAloneWhatTheSurroundingsDoNotTell)
{
  FilterState s;
  s.P.diagonal().setConstant(1e-8);
  considerUnmodelledAcceleration(s, 4.0);
  const Pose found{s.x.R, s.x.p + Vec3(0.4, 0.0, -0.3)};
  const FilterState corrected = correctedByPose(s, found, {{false, Vec3::UnitZ()}});
  EXPECT_NEAR(corrected.x.p.x(), 0.4, 0.01);
  EXPECT_NEAR(corrected.x.p.z(), s.x.p.z(), 1e-6);
  EXPECT_NEAR(corrected.x.v.z(), s.x.v.z(), 1e-6);
  EXPECT_NEAR(corrected.P(kVelocity + 2, kVelocity + 2), s.P(kVelocity + 2, kVelocity + 2), 1e-6);
}

TEST(CorrectedByPose, IsTheKalmanUpdateWithDenseMatrices)
{
  FilterState s = predictionWithStd(0.5, 0.7, 0.2);
  considerUnmodelledAcceleration(s, 2.0);
  s.P(kPosition, kGyroBias) = s.P(kGyroBias, kPosition) = 1e-5;
  const Pose found{expSO3({0.002, -0.001, 0.003}), {0.3, -0.2, 0.1}};
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6, kStateDim);
  H.leftCols(6).setIdentity();
  Eigen::VectorXd r(6);
  r << 1e-4, 1e-4, 1e-4, 9e-4, 9e-4, 9e-4;
  const Eigen::MatrixXd P = s.P, R = r.asDiagonal();
  const Eigen::MatrixXd K = P * H.transpose() * (H * P * H.transpose() + R).inverse();
  const Eigen::MatrixXd expected = (Eigen::MatrixXd::Identity(kStateDim, kStateDim) - K * H) * P;
  const FilterState corrected = correctedByPose(s, found);
  EXPECT_TRUE(corrected.P.isApprox(StateMatrix(expected), 1e-9));
}

}  // namespace
}  // namespace fastlio
