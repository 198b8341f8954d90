// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "map_error_scans.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace fastlio::testing
{
namespace
{
InsertionError inheritedError(double variance, double of_height)
{
  InsertionError error;
  error.inherited = variance * Matrix6::Identity();
  error.inherited(5, 5) = of_height;
  return error;
}

TEST(MapError, IsThatOfTheCreatingPosesWhereTheMapIsTrusted)
{
  MapErrorModel model;
  model.recordInsertion(1, ownError(4e-6), {});
  EXPECT_EQ(poseAddition(model).norm(), 0.0);
  model.update(fullTrust(), scanOn({1}));
  EXPECT_LT((poseAddition(model) - 4e-6 * Matrix6::Identity()).norm(), 1e-12);
}

TEST(MapError, OwnErrorsOfScansThatForgetAverageOut)
{
  MapErrorModel model;
  model.recordInsertion(1, ownError(4e-6), {});
  model.update(fullTrust(), scanOn({1}));  // nothing is left of the error before
  model.recordInsertion(2, ownError(4e-6), {});
  model.update(fullTrust(), scanOn({1, 2}));
  EXPECT_LT((poseAddition(model) - 2e-6 * Matrix6::Identity()).norm(), 1e-12);
}

TEST(MapError, OwnErrorsThatAreRememberedDoNot)
{
  MapErrorModel model;
  model.recordInsertion(1, ownError(4e-6), {});
  model.recordInsertion(2, ownError(4e-6), {});  // no update between: one and the same error
  model.update(fullTrust(), scanOn({1, 2}));
  EXPECT_LT((poseAddition(model) - 4e-6 * Matrix6::Identity()).norm(), 1e-12);
}

TEST(MapError, InheritedErrorsAreCommonToAllInsertions)
{
  const InsertionError inherited = inheritedError(4e-6, 4e-6);
  MapErrorModel model;
  model.recordInsertion(1, inherited, {});
  model.update(fullTrust(), scanOn({1}));
  model.recordInsertion(2, inherited, {});
  model.update(fullTrust(), scanOn({1, 2}));
  EXPECT_LT((poseAddition(model) - 4e-6 * Matrix6::Identity()).norm(), 1e-12);
}

/** The pose's error where nine planes of ten show x, and the tenth one shows the height. */
Matrix6 additionOn(
    const InsertionError& walls, const InsertionError& ground, const LinearizedUpdate& update)
{
  MapErrorModel model;
  model.recordInsertion(1, walls, {});
  model.recordInsertion(2, ground, {});
  GroupedMeasurements scan = scanOn({1, 1, 1, 1, 1, 1, 1, 1, 1, 2});
  for (PlaneGroup& group : scan.groups)
    group.g[group.created_insertion == 1 ? 3 : 5] = 1.0;
  model.update(update, scan);
  return poseAddition(model);
}

TEST(MapError, AlongAWeakDirectionItIsThatOfThePlanesThatShowIt)
{
  LinearizedUpdate update = fullTrust();
  update.constraints.directions = Matrix6::Identity().rowwise().reverse();
  update.constraints.information.setConstant(kScanInformation);
  update.constraints.information[0] = 0.01 * kScanInformation;
  const Matrix6 addition =
      additionOn(inheritedError(1e-6, 1e-6), inheritedError(1e-6, 0.09), update);
  EXPECT_NEAR(addition(5, 5), 0.09, 1e-4);
  EXPECT_NEAR(addition(3, 3), 1e-6, 1e-9);
  EXPECT_LT(std::abs(addition(3, 5)), 1e-9);
}

// Walls of the start are in view again, above ground that was first seen after the height had
// drifted. All directions are well determined.
TEST(MapError, OldWallsDoNotMakeTheHeightOfNewGroundCertain)
{
  const Matrix6 addition =
      additionOn(inheritedError(1e-6, 1e-6), inheritedError(1e-6, 0.09), fullTrust());
  EXPECT_NEAR(addition(5, 5), 0.09, 1e-4);
  EXPECT_NEAR(addition(3, 3), 1e-6, 1e-9);
}

// The other way round: new walls leave the height as certain as the old ground makes it.
TEST(MapError, NewWallsDoNotMakeTheHeightOfOldGroundUncertain)
{
  const Matrix6 addition =
      additionOn(inheritedError(0.09, 0.09), inheritedError(1e-6, 1e-6), fullTrust());
  EXPECT_NEAR(addition(3, 3), 0.09, 1e-4);
  EXPECT_NEAR(addition(5, 5), 1e-6, 1e-9);
}

// The odometry has drifted by 0.3 m since it began. Planes of late have the same error as the pose;
// the first ones have none, and the prediction lies beside them by all that it has drifted.
TEST(MapError, IsInTheInnovationWhereAnOldPlaceIsSeenAgain)
{
  constexpr double kDrift2 = 0.09;  // [m^2]
  MapErrorModel model;
  const InsertionError drifted = inheritedError(kDrift2, kDrift2);
  model.recordInsertion(1, InsertionError{}, {});
  model.recordInsertion(2, drifted, {});
  model.update(fullTrust(), scanOn({2}));
  const Matrix6 ahead = model.update(fullTrust(), scanOn({2}));
  EXPECT_LT(ahead.norm(), 1e-9);
  const Matrix6 back = model.update(fullTrust(), scanOn({1}));
  EXPECT_LT((back - kDrift2 * Matrix6::Identity()).norm(), 1e-9);
}

TEST(MapError, StaysBoundedOverMoreInsertionsThanAreKept)
{
  MapErrorModel model;
  for (std::uint32_t scan = 1; scan <= 1000; ++scan)
  {
    model.recordInsertion(scan, ownError(4e-6), {});
    model.update(fullTrust(), scanOn({scan, 1 + scan / 2}));
    const double largest = poseAddition(model).diagonal().maxCoeff();
    EXPECT_GT(largest, 1.9e-6);
    EXPECT_LT(largest, 4.1e-6);
  }
}

/** The recursion of docs/covariance.md with dense matrices, E and D apart. */
class DenseRecursion
{
 public:
  void propagate(const StateMatrix& Phi)
  {
    E_ = Phi * E_ * Phi.transpose();
    D_ = Phi * D_ * Phi.transpose();
    Y_planes_ = Phi * Y_planes_;
    Y_beams_ = Phi * Y_beams_;
    Y_poses_ = Phi * Y_poses_;
  }

  /** \param insertion covariance of the creating poses by all that is not of the beams */
  void update(
      const LinearizedUpdate& update, const GroupedMeasurements& scan, const Matrix6& insertion,
      const Matrix6& insertion_by_beams, const Matrix6& beam_errors)
  {
    const StateBy6 G = update.gain;
    const StateMatrix keep =
        StateMatrix::Identity() - G * scan.information * Matrix6(update.constraints.projection) *
                                      Eigen::Matrix<double, 6, kStateDim>(update.by_state);
    Matrix6 planes = Matrix6::Zero();
    for (const PlaneGroup& group : scan.groups)
      planes += group.shared_variance * group.g * group.g.transpose();
    const StateBy6 in_planes = G * squareRoot(planes);
    const StateBy6 in_beams =
        G * squareRoot(beam_errors) + G * scan.information * insertion_by_beams;
    const StateBy6 in_poses = G * scan.information * squareRoot(insertion);
    const StateMatrix cross = scan.persistence * keep * Y_planes_ * in_planes.transpose() +
                              keep * Y_beams_ * in_beams.transpose() +
                              keep * Y_poses_ * in_poses.transpose();
    E_ = keep * E_ * keep.transpose() + in_planes * in_planes.transpose() +
         in_beams * in_beams.transpose() + in_poses * in_poses.transpose() + cross +
         cross.transpose();
    D_ = keep * D_ * keep.transpose() + G * scan.shared_noise * G.transpose();
    Y_planes_ = scan.persistence * keep * Y_planes_ + in_planes;
    Y_beams_ = keep * Y_beams_ + in_beams;
    Y_poses_ = keep * Y_poses_ + in_poses;
  }

  [[nodiscard]] StateMatrix addition() const { return E_ - D_; }
  [[nodiscard]] Matrix6 poseError() const { return E_.topLeftCorner<6, 6>(); }
  [[nodiscard]] Matrix6 poseByBeams() const { return Y_beams_.topRows<6>(); }

 private:
  using StateBy6 = Eigen::Matrix<double, kStateDim, 6>;
  static Matrix6 squareRoot(const Matrix6& m) { return m.llt().matrixL(); }

  StateMatrix E_ = StateMatrix::Zero(), D_ = StateMatrix::Zero();
  StateBy6 Y_planes_ = StateBy6::Zero(), Y_beams_ = StateBy6::Zero(), Y_poses_ = StateBy6::Zero();
};

Matrix6 randomCovariance(double scale)
{
  const Matrix6 m = Matrix6::Random();
  return scale * (m * m.transpose() + 0.1 * Matrix6::Identity());
}

TEST(MapError, IsTheRecursionWithDenseMatrices)
{
  std::srand(1);  // of Eigen's random matrices
  InsertionError insertion;
  insertion.inherited = randomCovariance(1e-6);
  MapErrorModel model;
  model.recordInsertion(1, insertion, {});
  DenseRecursion dense;
  Matrix6 creating = insertion.inherited, creating_by_beams = Matrix6::Zero();
  std::uint32_t newest = 1;
  for (int i = 0; i < 30; ++i)
  {
    if (i == 15)  // half of the planes in view are those of a second insertion from then on
    {
      InsertionError second;
      second.inherited = dense.poseError() + randomCovariance(1e-6);
      model.recordInsertion(newest = 2, second, {});
      const Matrix6 by_beams = dense.poseByBeams();
      creating = 0.5 * (insertion.inherited + second.inherited - by_beams * by_beams.transpose());
      creating_by_beams = 0.5 * by_beams;
      ASSERT_GT(creating_by_beams.norm(), 0.0);
    }
    ErrorTransition transition;
    transition.by_state += 0.02 * MotionRows::Random();
    StateMatrix Phi = StateMatrix::Identity();
    Phi.topRows<kMotionDim>() = transition.by_state;
    model.propagate(transition);
    dense.propagate(Phi);
    const StateMatrix kept = StateMatrix::Identity() + 0.02 * StateMatrix::Random();
    model.correct(kept);
    dense.propagate(kept);

    GroupedMeasurements scan =
        scanOn({1, 1, 1, 1, 1, 1, newest, newest, newest, newest, newest, newest});
    scan.information = randomCovariance(kScanInformation);
    scan.shared_noise = randomCovariance(1e-3 * kScanInformation);
    scan.persistence = 0.7;
    for (std::size_t k = 0; k < scan.groups.size(); ++k)
    {
      // Both insertions show each direction equally well.
      scan.groups[k].g = k < 6 ? Vector6(100.0 * Vector6::Random()) : scan.groups[k - 6].g;
      scan.groups[k].shared_variance = 1e-6;
    }
    LinearizedUpdate update;
    update.gain = 0.2 / kScanInformation * ScanGain::Random();
    update.gain.bottomRows<kCalibrationDim>().setZero();
    const Matrix6 beam_errors = randomCovariance(1e-4 * kScanInformation);
    model.update(update, scan, beam_errors);
    dense.update(update, scan, creating, creating_by_beams, beam_errors);
    const StateMatrix expected = dense.addition();
    ASSERT_GT(expected.norm(), 0.0);
    EXPECT_LT((model.addition() - expected).norm(), 1e-9 * expected.norm()) << "update " << i;
  }
}

}  // namespace
}  // namespace fastlio::testing
