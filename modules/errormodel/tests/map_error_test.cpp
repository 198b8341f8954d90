// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "map_error_scans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <vector>

namespace fastlio::testing
{
namespace
{
/** Of a pose whose height is known differently. */
InsertionError poseAndHeight(double variance, double of_height)
{
  Matrix6 covariance = variance * Matrix6::Identity();
  covariance(5, 5) = of_height;
  return poseError(covariance);
}

TEST(MapError, IsThatOfTheCreatingPosesWhereTheMapIsTrusted)
{
  MapErrorModel model;
  model.recordInsertion(1, poseError(4e-6), {});
  EXPECT_EQ(poseAddition(model).norm(), 0.0);
  model.update(fullTrust(), scanOn({1}));
  EXPECT_LT((poseAddition(model) - 4e-6 * Matrix6::Identity()).norm(), 1e-12);
}

// The second pose has the error of the first one, from its planes, and one of its own. Half of the
// planes have this, too.
TEST(MapError, OwnErrorsOfScansAverageOut)
{
  MapErrorModel model;
  model.recordInsertion(1, poseError(4e-6), {});
  model.update(fullTrust(), scanOn({1}));
  model.recordInsertion(2, poseError(4e-6), {});
  model.update(fullTrust(), scanOn({1, 2}));
  EXPECT_LT((poseAddition(model) - 5e-6 * Matrix6::Identity()).norm(), 1e-12);
}

TEST(MapError, OfThePosesIsOneAndTheSameWithoutAnUpdateBetween)
{
  MapErrorModel model;
  model.recordInsertion(1, poseError(4e-6), {});
  model.recordInsertion(2, poseError(4e-6), {});
  model.update(fullTrust(), scanOn({1, 2}));
  EXPECT_LT((poseAddition(model) - 4e-6 * Matrix6::Identity()).norm(), 1e-12);
}

TEST(MapError, IsInheritedByThePlanesThatAScanCreates)
{
  MapErrorModel model;
  model.recordInsertion(1, poseError(4e-6), {});
  model.update(fullTrust(), scanOn({1}));
  model.recordInsertion(2, {}, {});
  model.update(fullTrust(), scanOn({1, 2}));
  EXPECT_LT((poseAddition(model) - 4e-6 * Matrix6::Identity()).norm(), 1e-12);
}

// A scan that warps its own planes, in motion before the velocity is known, is no less certain.
TEST(MapError, ContainsTheDistortionOfAScanWhereItsPlanesAreSeen)
{
  InsertionError error;
  error.distortion = 4e-6 * Matrix6::Identity();
  MapErrorModel model;
  model.recordInsertion(1, error, {});
  EXPECT_EQ(poseAddition(model).norm(), 0.0);
  model.update(fullTrust(), scanOn({1}));
  EXPECT_LT((poseAddition(model) - 4e-6 * Matrix6::Identity()).norm(), 1e-12);
}

/** The pose's error where nine planes of ten show x, and the tenth one shows the height. The poses
 * that created them have nothing in common. */
Matrix6 additionOn(
    const InsertionError& walls, const InsertionError& ground, const LinearizedUpdate& update)
{
  MapErrorModel model;
  model.recordInsertion(1, walls, {});
  ErrorTransition another;  // the pose of the second one has another error
  another.by_state.setZero();
  model.propagate(another);
  model.recordInsertion(2, ground, {});
  GroupedMeasurements scan = scanOn({1, 1, 1, 1, 1, 1, 1, 1, 1, 2});
  for (PlaneGroup& group : scan.groups)
    group.g[group.created_insertion == 1 ? 3 : 5] = 10.0 * std::sqrt(kScanInformation);
  model.update(update, scan);
  return poseAddition(model);
}

TEST(MapError, AlongAWeakDirectionItIsThatOfThePlanesThatShowIt)
{
  LinearizedUpdate update = fullTrust();
  update.constraints.directions = Matrix6::Identity().rowwise().reverse();
  update.constraints.information.setConstant(kScanInformation);
  update.constraints.information[0] = 0.01 * kScanInformation;
  const Matrix6 addition = additionOn(poseAndHeight(1e-6, 1e-6), poseAndHeight(1e-6, 0.09), update);
  EXPECT_NEAR(addition(5, 5), 0.09, 1e-4);
  EXPECT_NEAR(addition(3, 3), 1e-6, 1e-9);
  EXPECT_LT(std::abs(addition(3, 5)), 1e-9);
}

// Walls of the start are in view again, above ground that was first seen after the height had
// drifted. All directions are well determined.
TEST(MapError, OldWallsDoNotMakeTheHeightOfNewGroundCertain)
{
  const Matrix6 addition =
      additionOn(poseAndHeight(1e-6, 1e-6), poseAndHeight(1e-6, 0.09), fullTrust());
  EXPECT_NEAR(addition(5, 5), 0.09, 1e-4);
  EXPECT_NEAR(addition(3, 3), 1e-6, 1e-9);
}

// The other way round: new walls leave the height as certain as the old ground makes it.
TEST(MapError, NewWallsDoNotMakeTheHeightOfOldGroundUncertain)
{
  const Matrix6 addition =
      additionOn(poseAndHeight(0.09, 0.09), poseAndHeight(1e-6, 1e-6), fullTrust());
  EXPECT_NEAR(addition(3, 3), 0.09, 1e-4);
  EXPECT_NEAR(addition(5, 5), 1e-6, 1e-9);
}

// The odometry has drifted by 0.3 m since it began. Planes of late have the same error as the pose;
// the first ones have none, and the prediction lies beside them by all that it has drifted.
TEST(MapError, IsInTheInnovationWhereAnOldPlaceIsSeenAgain)
{
  constexpr double kDrift2 = 0.09;  // [m^2]
  MapErrorModel model;
  model.recordInsertion(1, {}, {});
  model.recordInsertion(2, poseError(kDrift2), {});
  model.update(fullTrust(), scanOn({2}));
  const Matrix6 ahead = model.update(fullTrust(), scanOn({2}));
  EXPECT_LT(ahead.norm(), 1e-9);
  const Matrix6 back = model.update(fullTrust(), scanOn({1}));
  EXPECT_LT((back - kDrift2 * Matrix6::Identity()).norm(), 1e-9);
}

// The error of the pose is as certain as that of the planes that it has just created.
TEST(MapError, AScanDoesNotContradictTheErrorOfItsOwnPlanes)
{
  std::srand(2);  // of Eigen's random matrices
  const StateMatrix m = StateMatrix::Random();
  InsertionError error;
  error.filter = 1e-6 * m * m.transpose();
  LinearizedUpdate update = fullTrust();
  update.T_world_scan = {expSO3(Vec3(0.3, -0.2, 1.0)), Vec3(5.0, -3.0, 1.0)};
  update.by_state = bodyPoseJacobian() + 0.1 * ScanPoseJacobian::Random();
  MapErrorModel model;
  model.recordInsertion(1, error, update.T_world_scan, update.by_state);
  const Matrix6 of_filter = update.by_state * error.filter * update.by_state.transpose();
  const Matrix6 mismatch = model.update(update, scanOn({1}));
  EXPECT_LT((mismatch + of_filter).norm(), 1e-9 * of_filter.norm());
}

/** Lost by metres along x, the odometry maps what it sees, and then finds old planes again.
 * \param views the insertions whose planes each scan after that sees: 1 is before, 2 while lost
 * \return standard deviation along x at the end [m] */
double errorAfterLoss(std::initializer_list<std::initializer_list<std::uint32_t>> views)
{
  Matrix6 lost = 1e-6 * Matrix6::Identity();
  lost(3, 3) = 9.0;
  MapErrorModel model;
  model.recordInsertion(1, {}, {});
  model.recordInsertion(2, poseError(lost), {});
  for (const auto& view : views)
    model.update(fullTrust(), scanOn(view));
  return std::sqrt(poseAddition(model)(3, 3));
}

TEST(MapError, OfPlanesThatWereMadeWhileLostStays)
{
  EXPECT_NEAR(errorAfterLoss({{2}, {2}, {2}}), 3.0, 1e-9);
}

// A scan sees both at once. The pose that lies between them is wrong by half of it where they are
// apart; but then the scan would not have matched both.
TEST(MapError, OfPlanesThatAgreeWithOldOnesIsSmall)
{
  EXPECT_LT(errorAfterLoss({{2}, {1, 2}}), 0.4);
  EXPECT_LT(errorAfterLoss({{2}, {1, 2}, {2}}), 0.7);
  EXPECT_LT(errorAfterLoss({{2}, {1, 2}, {2}, {1, 2}, {2}}), 0.7);
}

/** The insertions whose planes scan number \a scan sees: ten of the newer half, the latest
 * included. */
std::vector<std::size_t> insertionsInView(std::size_t scan)
{
  std::vector<std::size_t> insertions;
  for (std::size_t i = 0; i < 10; ++i)
    insertions.push_back(scan - i * scan / 18);
  return insertions;
}

/** The pose of each scan has a new error of variance 1 when it creates planes.
 * \return variance of the pose after each scan, exactly */
std::vector<double> variancesInView(std::size_t scans)
{
  std::vector<Eigen::VectorXd> creating;  // the error of each creating pose by the new errors
  std::vector<double> variances;
  Eigen::VectorXd pose = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(scans));
  for (std::size_t scan = 0; scan < scans; ++scan)
  {
    pose[static_cast<Eigen::Index>(scan)] += 1.0;
    creating.push_back(pose);
    pose.setZero();
    for (const std::size_t insertion : insertionsInView(scan))
      pose += 0.1 * creating[insertion];
    variances.push_back(pose.squaredNorm());
  }
  return variances;
}

// Groups of insertions have the mean error of their poses. A thousand are in twelve groups.
TEST(MapError, IsHardlyLessInGroupsOfInsertions)
{
  const std::vector<double> exact = variancesInView(1000);
  MapErrorModel model;
  for (std::uint32_t scan = 0; scan < exact.size(); ++scan)
  {
    model.recordInsertion(scan + 1, poseError(1e-6), {});
    GroupedMeasurements measured;
    measured.information = kScanInformation * Matrix6::Identity();
    for (const std::size_t insertion : insertionsInView(scan))
    {
      PlaneGroup& group = measured.groups.emplace_back();
      group.weight = 1.0;
      group.created_insertion = static_cast<std::uint32_t>(insertion) + 1;
    }
    model.update(fullTrust(), measured);
    EXPECT_NEAR(poseAddition(model)(3, 3), 1e-6 * exact[scan], 0.2e-6 * exact[scan]) << scan;
  }
}

}  // namespace
}  // namespace fastlio::testing
