// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/map_error.h>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>

namespace fastlio
{
namespace
{
constexpr double kScanInformation = 1e4;

/** Half of the weight on planes of each insertion; planes without errors of their own. */
GroupedMeasurements scanOn(std::initializer_list<std::uint32_t> insertions)
{
  GroupedMeasurements scan;
  scan.information = kScanInformation * Matrix6::Identity();
  for (const std::uint32_t insertion : insertions)
  {
    PlaneGroup& group = scan.groups.emplace_back();
    group.weight = 1.0;
    group.created_insertion = insertion;
  }
  return scan;
}

/** An update that puts the scan wherever the map says: K H = I on the pose. */
LinearizedUpdate fullTrust()
{
  LinearizedUpdate update;
  update.gain.topRows<6>() = Matrix6::Identity() / kScanInformation;
  return update;
}

InsertionError ownError(double variance)
{
  InsertionError error;
  error.own = variance * Matrix6::Identity();
  return error;
}

Matrix6 poseAddition(const MapErrorModel& model)
{
  return model.addition().topLeftCorner<6, 6>();
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
  InsertionError inherited;
  inherited.inherited = 4e-6 * Matrix6::Identity();
  MapErrorModel model;
  model.recordInsertion(1, inherited, {});
  model.update(fullTrust(), scanOn({1}));
  model.recordInsertion(2, inherited, {});
  model.update(fullTrust(), scanOn({1, 2}));
  EXPECT_LT((poseAddition(model) - 4e-6 * Matrix6::Identity()).norm(), 1e-12);
}

// Nine planes of ten are of a certain pose and do not show the height. The tenth shows it, and its
// pose was uncertain there.
TEST(MapError, AlongAWeakDirectionItIsThatOfThePlanesThatShowIt)
{
  MapErrorModel model;
  InsertionError certain, uncertain;
  certain.inherited = 1e-6 * Matrix6::Identity();
  uncertain.inherited = certain.inherited;
  uncertain.inherited(5, 5) = 0.09;
  model.recordInsertion(1, certain, {});
  model.recordInsertion(2, uncertain, {});
  GroupedMeasurements scan = scanOn({1, 1, 1, 1, 1, 1, 1, 1, 1, 2});
  for (std::size_t i = 0; i < scan.groups.size(); ++i)
    scan.groups[i].g[i < 9 ? 3 : 5] = 1.0;
  LinearizedUpdate update = fullTrust();
  update.constraints.directions = Matrix6::Identity().rowwise().reverse();
  update.constraints.information.setConstant(kScanInformation);
  update.constraints.information[0] = 0.01 * kScanInformation;
  model.update(update, scan);
  EXPECT_NEAR(poseAddition(model)(5, 5), 0.09, 1e-4);
  EXPECT_NEAR(poseAddition(model)(3, 3), 1e-6, 1e-9);
  EXPECT_LT(std::abs(poseAddition(model)(3, 5)), 1e-9);
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

/** Three scans that correct half of the error each, on planes that none of them shares with
 * another.
 * \param R_world_scan attitude of each scan
 * \return variance of the position along the sensor's x axis, by an error of the sensor [m^2] */
double varianceOfThreeScans(const std::array<Mat3, 3>& R_world_scan)
{
  MapErrorModel model;
  LinearizedUpdate update = fullTrust();
  update.gain *= 0.5;
  for (const Mat3& R : R_world_scan)
  {
    GroupedMeasurements scan = scanOn({1});
    scan.groups[0].shared_variance = 0.0;
    scan.persistence = 0.0;
    update.T_world_scan.R = R;
    const Vec3 forward = kScanInformation * R.col(0);
    Matrix6 beam_errors = Matrix6::Zero();
    beam_errors.bottomRightCorner<3, 3>() = 4e-6 * forward * forward.transpose();
    model.update(update, scan, beam_errors);
  }
  const Matrix6 added = poseAddition(model);
  const Vec3 forward = R_world_scan.back().col(0);
  return forward.dot(added.bottomRightCorner<3, 3>() * forward);
}

// Half of the error comes with each scan, and half of what was there stays: 0.5 + 0.25 + 0.125 of
// 2 mm when the scans share it. Independent ones would add up to 1.15 mm.
TEST(MapError, OfTheSensorStaysWhenThePlanesChange)
{
  const Mat3 ahead = Mat3::Identity();
  EXPECT_NEAR(std::sqrt(varianceOfThreeScans({ahead, ahead, ahead})), 0.875 * 2e-3, 1e-6);
}

// After a quarter of a turn, the error that moved the platform ahead moves it to the left: along
// the new direction, only the last two scans count.
TEST(MapError, OfTheSensorTurnsWithIt)
{
  const Mat3 ahead = Mat3::Identity(), left = expSO3(Vec3(0.0, 0.0, 0.5 * M_PI));
  EXPECT_NEAR(std::sqrt(varianceOfThreeScans({ahead, left, left})), 0.75 * 2e-3, 1e-6);
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

  void update(
      const LinearizedUpdate& update, const GroupedMeasurements& scan, const Matrix6& insertion,
      const Matrix6& beam_errors)
  {
    const StateBy6 G = update.gain;
    const StateMatrix keep =
        StateMatrix::Identity() - G * scan.information * Matrix6(update.constraints.projection) *
                                      Eigen::Matrix<double, 6, kStateDim>(update.by_state);
    Matrix6 planes = Matrix6::Zero();
    for (const PlaneGroup& group : scan.groups)
      planes += group.shared_variance * group.g * group.g.transpose();
    const StateBy6 in_planes = G * squareRoot(planes);
    const StateBy6 in_beams = G * squareRoot(beam_errors);
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
  for (int i = 0; i < 30; ++i)
  {
    ErrorTransition transition;
    transition.by_state += 0.02 * MotionRows::Random();
    StateMatrix Phi = StateMatrix::Identity();
    Phi.topRows<kMotionDim>() = transition.by_state;
    model.propagate(transition);
    dense.propagate(Phi);
    const StateMatrix kept = StateMatrix::Identity() + 0.02 * StateMatrix::Random();
    model.correct(kept);
    dense.propagate(kept);

    GroupedMeasurements scan = scanOn({1, 1, 1, 1, 1, 1, 1, 1});
    scan.information = randomCovariance(kScanInformation);
    scan.shared_noise = randomCovariance(1e-3 * kScanInformation);
    scan.persistence = 0.7;
    for (PlaneGroup& group : scan.groups)
    {
      group.g = 100.0 * Vector6::Random();
      group.shared_variance = 1e-6;
    }
    LinearizedUpdate update;
    update.gain = 0.2 / kScanInformation * ScanGain::Random();
    update.gain.bottomRows<kCalibrationDim>().setZero();
    const Matrix6 beam_errors = randomCovariance(1e-4 * kScanInformation);
    model.update(update, scan, beam_errors);
    dense.update(update, scan, insertion.inherited, beam_errors);
    const StateMatrix expected = dense.addition();
    ASSERT_GT(expected.norm(), 0.0);
    EXPECT_LT((model.addition() - expected).norm(), 1e-9 * expected.norm()) << "update " << i;
  }
}

}  // namespace
}  // namespace fastlio
