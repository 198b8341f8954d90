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

  /** \param noise standard deviations of the innovations over what the covariance says
   * \param map_mismatch standard deviation that the evidence is told of the map's own errors */
  /** \return the mean surprise of the scans */
  double feed(
      CalibrationEvidence& evidence, const CalibrationErrorVector& theta, int scans, double noise,
      double map_mismatch = 0.0)
  {
    double surprise = 0.0;
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
      surprise += evidence.add(
          C, bodyPoseJacobian(), predicted, update,
          map_mismatch * map_mismatch * Matrix6::Identity());
    }
    return surprise / scans;
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

// Innovations of 100 standard deviations are a step of the inertial sensor, unless the map explains
// them: where it goes back to an old place, the prediction has drifted.
TEST(CalibrationEvidence, TakesNoReturnToAnOldPlaceForAStepOfTheSensor)
{
  const CalibrationErrorVector none = CalibrationErrorVector::Zero();
  CalibrationEvidence ahead(CalibrationOptions{}), back(CalibrationOptions{});
  RandomScans(1).feed(ahead, none, 3, 100.0);
  RandomScans(1).feed(back, none, 3, 100.0, 100.0 * 1.5e-3);
  EXPECT_TRUE(ahead.takeStep());
  EXPECT_FALSE(back.takeStep());
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

TEST(CalibrationEvidence, IsSurprisedByWhatNeitherNoiseNorCalibrationExplains)
{
  constexpr int kRuns = 100;  // 600 elements: the standard deviation of their mean square is 6 %
  const CalibrationErrorVector theta = someError(0.003);
  double usual = 0.0, large = 0.0;
  for (unsigned run = 0; run < kRuns; ++run)
  {
    CalibrationEvidence evidence(CalibrationOptions{});
    RandomScans scans(run);
    usual += scans.feed(evidence, theta, 40, 1.0) / kRuns;
    large += scans.feed(evidence, theta, 1, 5.0) / kRuns;
  }
  EXPECT_NEAR(usual, 1.0, 0.2);
  EXPECT_NEAR(large, 25.0, 8.0);
}

// Of a pose that was lost for long. The covariance of all scans after it would be no number.
TEST(CalibrationEvidence, LeavesOutAScanWhoseNumbersOverflow)
{
  CalibrationEvidence evidence(CalibrationOptions{});
  RandomScans(6).feed(evidence, someError(0.003), 20, 1.0);
  const CalibrationErrorMatrix before = evidence.estimate().second_moment;
  FilterState predicted;
  predicted.P.setIdentity();
  UpdateResult update;
  update.last.HtRinvH.setIdentity();
  for (int i = 0; i < 10; ++i)
    evidence.add(
        PoseByCalibration::Constant(1e200), bodyPoseJacobian(), predicted, update, Matrix6::Zero());
  EXPECT_TRUE(evidence.estimate().second_moment.allFinite());
  EXPECT_EQ((evidence.estimate().second_moment - before).norm(), 0.0);
}

/** calibration.estimate_extrinsic, after a first scan at 1 s. */
CalibrationEvidence estimatingEvidence()
{
  CalibrationOptions options;
  options.estimate_extrinsic = true;
  CalibrationEvidence evidence(options);
  EXPECT_FALSE(evidence.dueCorrection(1'000'000'000));
  return evidence;
}

constexpr std::int64_t kSoonNs = 5'000'000'000, kLaterNs = 11'000'000'000;

TEST(CalibrationEvidence, TakesALargeErrorOffTheExtrinsicAfterAWhile)
{
  CalibrationEvidence evidence = estimatingEvidence();
  const CalibrationErrorVector theta = someError(0.01);
  RandomScans(6).feed(evidence, theta, 200, 1.0);
  EXPECT_FALSE(evidence.dueCorrection(kSoonNs)) << "too early";
  const auto error = evidence.dueCorrection(kLaterNs);
  ASSERT_TRUE(error);
  EXPECT_LT((*error - theta.head<6>()).norm(), 0.1 * theta.head<6>().norm());
  EXPECT_FALSE(evidence.dueCorrection(kLaterNs + 1)) << "the next one waits longer";
  evidence.takeOff(*error);
  CalibrationErrorVector left = theta;
  left.head<6>() -= *error;
  EXPECT_LT((evidence.estimate().mean - left).norm(), 0.05 * theta.norm());
  EXPECT_FALSE(evidence.dueCorrection(10 * kLaterNs)) << "there is nothing left";
  // The evidence on the extrinsic in use adds to that on the one before.
  RandomScans(7).feed(evidence, left, 200, 1.0);
  EXPECT_LT((evidence.estimate().mean - left).norm(), 0.05 * theta.norm());
  EXPECT_NEAR(evidence.estimate().innovation_scale, 1.0, 0.15);
}

TEST(CalibrationEvidence, LeavesTheExtrinsicWhereNoErrorShows)
{
  CalibrationEvidence right = estimatingEvidence();
  RandomScans(8).feed(right, someError(0.0), 200, 1.0);
  EXPECT_FALSE(right.dueCorrection(kLaterNs));
  CalibrationEvidence not_asked{CalibrationOptions{}};
  RandomScans(6).feed(not_asked, someError(0.01), 200, 1.0);
  EXPECT_FALSE(not_asked.dueCorrection(1'000'000'000));
  EXPECT_FALSE(not_asked.dueCorrection(kLaterNs));
}
}  // namespace
}  // namespace fastlio
