// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_error_recursion_test.cpp The map's error against the joint covariance of everything. */

#include "map_error_scans.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

namespace fastlio::testing
{
namespace
{
Matrix6 squareRoot(const Matrix6& m)
{
  return m.llt().matrixL();
}

/** The joint covariance of the state's error, eta_b, eta_p and the errors of all creating poses as
 * one dense matrix, and that of the noise that the filter counts. */
class DenseRecursion
{
 public:
  void propagate(const NavigationMatrix& Phi)
  {
    Eigen::MatrixXd T = identity();
    T.topLeftCorner<kNavigationDim, kNavigationDim>() = Phi;
    joint_ = T * joint_ * T.transpose();
  }

  void insert(const StateMatrix& filter)
  {
    const Eigen::Index n = joint_.rows();
    Eigen::MatrixXd T(n + 6, n);
    T << identity(), identity().topRows(6);
    Eigen::MatrixXd with_filter = joint_;
    with_filter.topLeftCorner<kNavigationDim, kNavigationDim>() +=
        filter.topLeftCorner<kNavigationDim, kNavigationDim>();
    const Eigen::MatrixXd addition = joint_.topLeftCorner<kNavigationDim, kNavigationDim>();
    joint_ = T * with_filter * T.transpose();
    joint_.topLeftCorner<kNavigationDim, kNavigationDim>() = addition;
  }

  /** \param R of eta_p <- R eta_p + what is new
   * \param parts of the planes by insertion, in all directions alike */
  void update(
      const LinearizedUpdate& update, const GroupedMeasurements& scan, const Matrix6& R,
      const std::vector<double>& parts, const BeamPulls& beams)
  {
    // eta_p is partly new: what it has in common with all others fades.
    Eigen::MatrixXd fade = identity();
    fade.block<6, 6>(kPlanes, kPlanes) = R;
    joint_ = fade * joint_ * fade.transpose();
    joint_.block<6, 6>(kPlanes, kPlanes) += Matrix6::Identity() - R * R.transpose();

    const Matrix6 M = scan.information;
    const Eigen::Matrix<double, kNavigationDim, 6> G = update.gain.topRows<kNavigationDim>();
    Eigen::MatrixXd T = identity();
    T.topLeftCorner(kNavigationDim, 6) -= G * M;
    T.block(0, kBeams, kNavigationDim, kBeamErrors) = G * beams;
    T.block(0, kPlanes, kNavigationDim, 6) = G * squareRoot(scan.plane_errors);
    for (std::size_t i = 0; i < parts.size(); ++i)
      T.block(0, kPoses + 6 * static_cast<Eigen::Index>(i), kNavigationDim, 6) = parts[i] * G * M;
    joint_ = T * joint_ * T.transpose();
    joint_.topLeftCorner<kNavigationDim, kNavigationDim>() -= G * scan.shared_noise * G.transpose();
  }

  [[nodiscard]] Eigen::MatrixXd addition() const
  {
    return joint_.topLeftCorner<kNavigationDim, kNavigationDim>();
  }

 private:
  static constexpr int kBeams = kNavigationDim, kPlanes = kBeams + kBeamErrors;
  static constexpr int kPoses = kPlanes + 6;

  [[nodiscard]] Eigen::MatrixXd identity() const
  {
    return Eigen::MatrixXd::Identity(joint_.rows(), joint_.rows());
  }
  static Eigen::MatrixXd start()
  {
    Eigen::MatrixXd joint = Eigen::MatrixXd::Identity(kPoses, kPoses);
    joint.topLeftCorner<kNavigationDim, kNavigationDim>().setZero();
    return joint;
  }

  Eigen::MatrixXd joint_ = start();
};

Matrix6 randomCovariance(double scale)
{
  const Matrix6 m = Matrix6::Random();
  return scale * (m * m.transpose() + 0.1 * Matrix6::Identity());
}

StateMatrix randomFilterCovariance()
{
  const StateMatrix m = StateMatrix::Random();
  StateMatrix filter = 1e-7 * m * m.transpose();
  filter.bottomRows<kCalibrationDim>().setZero();
  filter.rightCols<kCalibrationDim>().setZero();
  return filter;
}

/** Half of the weight on planes of each insertion, which show all directions alike. */
GroupedMeasurements randomScan(std::uint32_t newest)
{
  GroupedMeasurements scan =
      scanOn({1, 1, 1, 1, 1, 1, newest, newest, newest, newest, newest, newest});
  scan.information = randomCovariance(kScanInformation);
  scan.shared_noise = randomCovariance(1e-3 * kScanInformation);
  scan.plane_errors = randomCovariance(1e-6 * kScanInformation);
  for (std::size_t k = 0; k < 6; ++k)
  {
    const Vector6 axis = Vector6::Unit(static_cast<Eigen::Index>(k));
    scan.groups[k].g = scan.groups[k + 6].g = 100.0 * (axis + 0.1 * Vector6::Random());
  }
  return scan;
}

TEST(MapError, IsTheRecursionWithDenseMatrices)
{
  std::srand(1);  // of Eigen's random matrices
  MapErrorModel model;
  DenseRecursion dense;
  std::vector<double> parts = {1.0};
  Matrix6 before = Matrix6::Zero();  // of the planes of the scan before
  const auto insert = [&](std::uint32_t number)
  {
    InsertionError error;
    error.filter = randomFilterCovariance();
    model.recordInsertion(number, error, {});
    dense.insert(error.filter);
  };
  insert(1);
  for (int i = 0; i < 30; ++i)
  {
    if (i == 15)
    {
      ASSERT_GT(model.poseByBeams().norm(), 0.0);  // the second insertion has errors of the beams
      insert(2);
      parts = {0.5, 0.5};
    }
    ErrorTransition transition;
    transition.by_state.leftCols<kNavigationDim>() +=
        0.02 * Eigen::Matrix<double, kMotionDim, kNavigationDim>::Random();
    NavigationMatrix Phi = NavigationMatrix::Identity();
    Phi.topRows<kMotionDim>() = transition.by_state.leftCols<kNavigationDim>();
    model.propagate(transition);
    dense.propagate(Phi);
    const MotionGain K = 0.02 * MotionGain::Random();
    model.correct(K);
    NavigationMatrix kept = NavigationMatrix::Identity();
    kept.middleCols<6>(kVelocity) -= K.topRows<kNavigationDim>();
    dense.propagate(kept);

    GroupedMeasurements scan = randomScan(i < 15 ? 1 : 2);
    const Matrix6 root = squareRoot(scan.plane_errors);
    const Matrix6 R = i == 0 ? Matrix6(Matrix6::Zero()) : Matrix6(0.3 * Matrix6::Random());
    scan.plane_errors_before = root * R * before.transpose();
    before = root;
    LinearizedUpdate update;
    update.gain = 0.2 / kScanInformation * ScanGain::Random();
    update.gain.bottomRows<kCalibrationDim>().setZero();
    const BeamPulls beams = 1e-2 * std::sqrt(kScanInformation) * BeamPulls::Random();
    model.update(update, scan, beams);
    dense.update(update, scan, R, parts, beams);
    const Eigen::MatrixXd expected = dense.addition();
    ASSERT_GT(expected.norm(), 0.0);
    const NavigationMatrix added = model.addition().topLeftCorner<kNavigationDim, kNavigationDim>();
    EXPECT_LT((added - expected).norm(), 1e-9 * expected.norm()) << "update " << i;
  }
}

}  // namespace
}  // namespace fastlio::testing
