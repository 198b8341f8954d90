// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/calibration_error.h>
#include <fastlio/math/so3.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
constexpr double kInformation = 1e4;
const CompensatedWith kUnmoved;

GroupedMeasurements scanOn(std::uint32_t insertion)
{
  GroupedMeasurements scan;
  scan.information = kInformation * Matrix6::Identity();
  PlaneGroup& group = scan.groups.emplace_back();
  group.weight = 1.0;
  group.created_insertion = insertion;
  return scan;
}

/** A scan at a pose of the body that is put wherever the map says. */
LinearizedUpdate fullTrustAt(const Pose& T_world_imu)
{
  NavState x;
  x.R = T_world_imu.R;
  x.p = T_world_imu.p;
  LinearizedUpdate update;
  update.T_world_scan = T_world_imu;
  update.by_state = scanPoseJacobian(x, kUnmoved);
  update.gain.topRows<6>() = Matrix6(update.by_state.leftCols<6>()).inverse() / kInformation;
  return update;
}

/** Error of the body's pose by a unit error of each element of the extrinsic, after the LiDAR has
 * been matched with its own map at \a here. */
Matrix6 poseByExtrinsic(const Pose& here)
{
  CalibrationErrorModel model;
  model.recordInsertion(1, Pose{}, fullTrustAt(Pose{}).by_state);
  (void)model.update(fullTrustAt(here), scanOn(1));
  // Each second moment names one element; S S^T of it gives back its column up to the sign.
  CalibrationErrorMatrix moment = CalibrationErrorMatrix::Zero();
  moment.topLeftCorner<6, 6>().setIdentity();
  return model.addition(moment).topLeftCorner<6, 6>();
}

TEST(CalibrationError, IsHiddenWhileNothingTurns)
{
  // The map has the same error, so that a LiDAR that only moves fits to it: of a wrong position
  // nothing is left, of a wrong rotation the way is turned.
  const Matrix6 moved = poseByExtrinsic({Mat3::Identity(), {10.0, 0.0, 0.0}});
  EXPECT_NEAR(moved(kPosition, kPosition), 0.0, 1e-9);
  EXPECT_NEAR(moved(kPosition + 1, kPosition + 1), 100.0, 1e-6);
  EXPECT_NEAR(moved(kPosition + 2, kPosition + 2), 100.0, 1e-6);
  EXPECT_NEAR((moved.topLeftCorner<3, 3>().norm()), 0.0, 1e-9);
}

TEST(CalibrationError, ShowsInTurns)
{
  // Half a turn about z: a rotation about x or y counts twice, one about z does not show.
  const Pose half_turn{expSO3({0.0, 0.0, M_PI}), Vec3::Zero()};
  const Matrix6 turned = poseByExtrinsic(half_turn);
  EXPECT_NEAR(turned(kAttitude, kAttitude), 4.0, 1e-6);
  EXPECT_NEAR(turned(kAttitude + 1, kAttitude + 1), 4.0, 1e-6);
  EXPECT_NEAR(turned(kAttitude + 2, kAttitude + 2), 0.0, 1e-6);
  // A wrong lever arm is on the other side then.
  EXPECT_NEAR(turned(kPosition, kPosition), 4.0, 1e-6);
  EXPECT_NEAR(turned(kPosition + 2, kPosition + 2), 0.0, 1e-6);
}

/** Of the pose that a wrong extrinsic leaves: the true body pose moves the LiDAR with the true
 * extrinsic, and the map holds it where the wrong one had put it at first. */
StateVector trueError(const Pose& here, const Vector6& theta)
{
  const Pose wrong{expSO3(theta.head<3>()), theta.tail<3>()};
  // Map and LiDAR: wrong * T_lidar_start^-1 ... T_world_imu wrong = wrong here (in their own
  // world).
  const Pose estimated = wrong * here * wrong.inverse();
  NavState a, b;
  a.R = estimated.R;
  a.p = estimated.p;
  b.R = here.R;
  b.p = here.p;
  return boxminus(a, b);
}

TEST(CalibrationError, IsTheDerivativeOfThePoseThatAWrongExtrinsicLeaves)
{
  const Pose here{expSO3({0.3, -0.5, 1.2}), {4.0, -7.0, 1.5}};
  constexpr double kStep = 1e-6;
  Matrix6 numeric;
  for (int k = 0; k < 6; ++k)
  {
    const Vector6 step = kStep * Vector6::Unit(k);
    numeric.col(k) = ((trueError(here, step) - trueError(here, -step)) / (2.0 * kStep)).head<6>();
  }
  EXPECT_LT((poseByExtrinsic(here) - numeric * numeric.transpose()).norm(), 1e-5);
}

TEST(CalibrationError, NeedsNoScanForTheInertialSensor)
{
  CalibrationErrorModel model;
  ErrorTransition transition;
  transition.by_inertial(kAttitude, 0) = 0.5;
  CalibrationErrorMatrix moment = CalibrationErrorMatrix::Zero();
  moment(kGyroMatrixError, kGyroMatrixError) = 1e-4;
  const StateMatrix after = model.additionAfter(transition, moment);
  EXPECT_NEAR(after(kAttitude, kAttitude), 0.25e-4, 1e-12);
  EXPECT_EQ(model.addition(moment).norm(), 0.0);
  model.propagate(transition);
  EXPECT_LT((model.addition(moment) - after).norm(), 1e-15);
}

TEST(CalibrationError, StaysTheSameWhenOldInsertionsAreForgotten)
{
  // Scans that see the first planes all the time: what is remembered of them must not wear off.
  const Pose here{expSO3({0.0, 0.0, 1.0}), Vec3::Zero()};
  CalibrationErrorModel model;
  CalibrationErrorMatrix moment = CalibrationErrorMatrix::Identity();
  model.recordInsertion(1, Pose{}, fullTrustAt(Pose{}).by_state);
  (void)model.update(fullTrustAt(here), scanOn(1));
  const StateMatrix first = model.addition(moment);
  for (std::uint32_t scan = 2; scan < 1000; ++scan)
  {
    model.recordInsertion(scan, here, fullTrustAt(here).by_state);
    (void)model.update(fullTrustAt(here), scanOn(1));
  }
  EXPECT_LT((model.addition(moment) - first).norm(), 1e-9);
}
}  // namespace
}  // namespace fastlio
