// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/calibration_evidence.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fastlio
{
namespace
{
/** Scans whose innovations depend on theta in a random way. */
class RandomScans
{
 public:
  explicit RandomScans(unsigned seed) : random_(seed) {}

  /** \param noise standard deviations of the innovations over what the covariance says */
  void feed(
      CalibrationEvidence& evidence, const CalibrationErrorVector& theta, int scans, double noise)
  {
    for (int i = 0; i < scans; ++i)
    {
      const PoseByCalibration C =
          PoseByCalibration::NullaryExpr([this] { return normal_(random_); });
      const Matrix6 P = covariance(1e-3), S = covariance(1e3);
      const Eigen::Matrix<double, 6, 6> W_inverse = P + Eigen::Matrix<double, 6, 6>(S).inverse();
      const Vector6 unit = Vector6::NullaryExpr([this] { return normal_(random_); });
      const Vector6 y =
          -(C * theta) + noise * (Eigen::Matrix<double, 6, 6>(W_inverse.llt().matrixL()) * unit);
      FilterState predicted;
      predicted.P.topLeftCorner<6, 6>() = P;
      UpdateResult update;
      update.last.HtRinvH = S;
      StateVector correction = StateVector::Zero();
      correction.head<6>() = P * W_inverse.llt().solve(Eigen::Matrix<double, 6, 1>(y));
      update.posterior.x = boxplus(predicted.x, correction);
      evidence.add(C, bodyPoseJacobian(), predicted, update);
    }
  }

 private:
  Matrix6 covariance(double std)
  {
    const Matrix6 A = Matrix6::NullaryExpr([this] { return normal_(random_); });
    return std * std * (Matrix6::Identity() + 0.1 * A * A.transpose());
  }

  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

CalibrationErrorVector someError(double size)
{
  CalibrationErrorVector theta;
  for (int i = 0; i < kCalibrationErrorDim; ++i)
    theta[i] = size * std::sin(1.0 + i);
  return theta;
}

double deviations(const CalibrationEstimate& estimate, const CalibrationErrorVector& theta)
{
  const CalibrationErrorVector e = estimate.mean - theta;
  const Eigen::Matrix<double, kCalibrationErrorDim, kCalibrationErrorDim> P = estimate.covariance;
  return e.dot(P.llt().solve(Eigen::Matrix<double, kCalibrationErrorDim, 1>(e))) /
         kCalibrationErrorDim;
}

TEST(CalibrationEvidence, IsThePriorBeforeTheFirstScan)
{
  const CalibrationOptions options;
  const CalibrationEstimate estimate = CalibrationEvidence(options).estimate();
  EXPECT_EQ(estimate.mean.norm(), 0.0);
  EXPECT_EQ(estimate.innovation_scale, 1.0);
  EXPECT_NEAR(
      std::sqrt(estimate.second_moment(kExtrinsicError, kExtrinsicError)),
      options.extrinsic_rotation_std, 1e-12);
  EXPECT_NEAR(
      std::sqrt(estimate.covariance(kAccelMatrixError, kAccelMatrixError)), options.imu_scale_std,
      1e-12);
}

TEST(CalibrationEvidence, FindsWhatTheInnovationsDependOn)
{
  for (const unsigned seed : {1U, 2U, 3U})
  {
    CalibrationEvidence evidence(CalibrationOptions{});
    const CalibrationErrorVector theta = someError(0.003);
    RandomScans(seed).feed(evidence, theta, 200, 1.0);
    const CalibrationEstimate& estimate = evidence.estimate();
    EXPECT_LT((estimate.mean - theta).norm(), 0.05 * theta.norm());
    EXPECT_LT(deviations(estimate, theta), 2.2);  // chi-square of 24 degrees: 0.1 %
    EXPECT_GT(deviations(estimate, theta), 0.3);
    EXPECT_NEAR(estimate.innovation_scale, 1.0, 0.15);
  }
}

TEST(CalibrationEvidence, IsLessSureWhenTheInnovationsAreLargerThanTheirCovariance)
{
  CalibrationEvidence evidence(CalibrationOptions{});
  const CalibrationErrorVector theta = someError(0.003);
  RandomScans(4).feed(evidence, theta, 200, 3.0);
  EXPECT_NEAR(evidence.estimate().innovation_scale, 9.0, 1.5);
  EXPECT_LT(deviations(evidence.estimate(), theta), 2.2);
}

TEST(CalibrationEvidence, HasNoneForWhatIsKnownExactly)
{
  CalibrationOptions options;
  options.extrinsic_rotation_std = options.extrinsic_translation_std = 0.0;
  options.imu_scale_std = options.imu_misalignment_std = 0.0;
  CalibrationEvidence evidence(options);
  RandomScans(5).feed(evidence, someError(0.003), 50, 1.0);
  EXPECT_EQ(evidence.estimate().second_moment.norm(), 0.0);
}

TEST(CalibrationEvidence, LeavesTheExtrinsicToAFilterThatEstimatesIt)
{
  CalibrationOptions options;
  options.estimate_extrinsic = true;
  const CalibrationEvidence evidence(options);
  EXPECT_EQ((evidence.estimate().covariance.topLeftCorner<6, 6>().norm()), 0.0);
  EXPECT_GT(evidence.estimate().covariance.norm(), 0.0);
}
}  // namespace
}  // namespace fastlio
