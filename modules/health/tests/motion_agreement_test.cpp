// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/health/motion_agreement.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/so3.h>

#include <gtest/gtest.h>

#include <random>

namespace fastlio
{
namespace
{
/** A platform that turns about changing axes; scans correct predictions whose errors are as their
 * covariance says, times a factor. */
class TurningPlatform
{
 public:
  TurningPlatform(
      const Mat3& R_true_given, double factor, double std = 3e-4, double gyro_scale = 1.0)
      : R_true_given_(R_true_given), factor_(factor), std_(std), gyro_scale_(gyro_scale)
  {
  }

  void addTo(MotionAgreement& agreement, int scans)
  {
    for (int i = 0; i < scans; ++i)
    {
      const FilterState predicted = predict(i);
      agreement.add(before_, 0.1, predicted, correct(), Matrix6::Zero());
    }
  }

  void setFactor(double factor) { factor_ = factor; }
  /** Mean z^2/r of the points of the scans. */
  void setResiduals(double residuals) { residuals_ = residuals; }

 private:
  Vec3 noise(double std) { return std * Vec3(gauss_(random_), gauss_(random_), gauss_(random_)); }

  FilterState predict(int i)
  {
    const Vec3 turn = 0.05 * Vec3(std::sin(0.3 * i), std::cos(0.2 * i), 1.0 + std::sin(0.1 * i));
    before_ = state_.x;
    // The motion that the scans see, brought to the IMU by the mounting in use.
    const Vec3 seen = R_true_given_.transpose() * turn;
    truth_ = before_.R * expSO3(seen);
    state_.x.R = before_.R * expSO3(gyro_scale_ * turn) * expSO3(factor_ * noise(std_));
    state_.P.diagonal().head<6>().setConstant(std_ * std_);
    return state_;
  }

  /** Of a scan that is ten times as good as the prediction. */
  UpdateResult correct()
  {
    UpdateResult update;
    update.last.count = 100;
    update.last.weighted_squares = 100 * residuals_;
    FilterState& posterior = update.posterior;
    posterior = state_;
    const double gain = 1.0 / 1.01;
    const Vec3 measured = logSO3(state_.x.R.transpose() * truth_) + noise(0.1 * std_);
    posterior.x.R = state_.x.R * expSO3(gain * measured);
    posterior.x.p = state_.x.p + gain * factor_ * noise(std_);
    posterior.P.diagonal().head<6>() *= 1.0 - gain;
    state_.x = posterior.x;
    return update;
  }

  Mat3 R_true_given_, truth_ = Mat3::Identity();
  double factor_, std_;  // of the predictions: [rad], [m]
  double gyro_scale_, residuals_ = 1.0;
  NavState before_;
  FilterState state_;
  std::mt19937_64 random_{3};
  std::normal_distribution<double> gauss_;
};

TEST(MotionAgreement, InnovationIsAboutOneWhenTheCovarianceIsRight)
{
  MotionAgreement agreement;
  TurningPlatform platform(Mat3::Identity(), 1.0, 1e-2);
  platform.addTo(agreement, MotionAgreement::kWindow - 1);
  EXPECT_EQ(agreement.innovation(), 0.0) << "too few scans";
  platform.addTo(agreement, 50);
  EXPECT_GT(agreement.innovation(), 0.4);
  EXPECT_LT(agreement.innovation(), 2.0);
}

TEST(MotionAgreement, InnovationGrowsWithTheSquareOfTheErrors)
{
  MotionAgreement agreement;
  TurningPlatform(Mat3::Identity(), 10.0, 1e-2).addTo(agreement, 50);
  EXPECT_GT(agreement.innovation(), 40.0);
  EXPECT_LT(agreement.innovation(), 200.0);
}

// A filter that is sure to a tenth of a milliradian is not to be blamed for vibration.
TEST(MotionAgreement, VibrationIsNoDisagreement)
{
  MotionAgreement agreement;
  TurningPlatform(Mat3::Identity(), 10.0, 1e-4).addTo(agreement, 50);
  EXPECT_GT(agreement.innovation(), 0.5);
  EXPECT_LT(agreement.innovation(), 6.0);
}

TEST(MotionAgreement, AScanThatIsOffAloneDoesNotCount)
{
  MotionAgreement agreement;
  TurningPlatform platform(Mat3::Identity(), 1.0);
  platform.addTo(agreement, 50);
  platform.setFactor(100.0);
  platform.addTo(agreement, 3);
  EXPECT_LT(agreement.innovation(), 3.0);
}

TEST(MotionAgreement, ARightMountingHasNoError)
{
  MotionAgreement agreement;
  TurningPlatform(Mat3::Identity(), 1.0).addTo(agreement, 200);
  ASSERT_TRUE(agreement.mountingError().has_value());
  EXPECT_LT(kDegPerRad * agreement.mountingError()->angle, 0.1);
}

TEST(MotionAgreement, TheErrorOfTheMountingIsTheRotationThatBringsItRight)
{
  for (const Vec3& degrees : {Vec3(0, 0, 2), Vec3(-5, 0, 0), Vec3(3, -8, 12)})
  {
    MotionAgreement agreement;
    const Mat3 R = expSO3(degrees / kDegPerRad);
    TurningPlatform(R, 1.0).addTo(agreement, 200);
    const auto error = agreement.mountingError();
    ASSERT_TRUE(error.has_value());
    EXPECT_NEAR(kDegPerRad * error->angle, degrees.norm(), 0.2);
    EXPECT_LT(kDegPerRad * logSO3(error->R_true_given.transpose() * R).norm(), 0.2);
    EXPECT_LT(std::abs(error->angle - degrees.norm() / kDegPerRad), 4.0 * error->std);
    EXPECT_LT(kDegPerRad * error->std, 0.1);
    EXPECT_GT(agreement.innovation(), 2.5) << degrees.transpose();
  }
}

// Wahba's problem always has a solution; what noise makes of it is within its standard deviation.
TEST(MotionAgreement, NoiseAloneIsNoWrongMounting)
{
  MotionAgreement agreement;
  TurningPlatform(Mat3::Identity(), 30.0).addTo(agreement, 120);
  const auto error = agreement.mountingError();
  ASSERT_TRUE(error.has_value());
  EXPECT_GT(kDegPerRad * error->angle, 0.1);
  EXPECT_LT(error->angle, 4.0 * error->std);
  EXPECT_LT(kDegPerRad * error->leastAngle(), 0.5);
}

TEST(MotionAgreement, TheScaleOfTheGyroIsFoundWithItsStandardDeviation)
{
  for (const double scale : {0.9, 1.0, 1.05})
  {
    MotionAgreement agreement;
    TurningPlatform(Mat3::Identity(), 1.0, 3e-4, scale).addTo(agreement, 200);
    ASSERT_TRUE(agreement.gyroScale().has_value());
    const GyroScale found = *agreement.gyroScale();
    EXPECT_NEAR(found.scale(), scale, 0.002);
    EXPECT_LT(std::abs(found.scale() - scale), 5.0 * found.std);
    EXPECT_EQ(found.leastError() > 0.02, scale != 1.0) << scale;
  }
}

/** A platform that goes straight for ten seconds and then turns faster and faster; the scans see
 * each turn later. */
GyroScale scaleWithALag(double lag_s, int turning_scans)
{
  const auto heading = [](double t) { return t < 10.0 ? 0.0 : 0.5 * std::pow(t - 10.0, 3); };
  MotionAgreement agreement;
  NavState last;
  for (int i = 1; i <= 100 + turning_scans; ++i)
  {
    const double t = 0.1 * i;
    FilterState predicted;
    predicted.x.R = expSO3({0.0, 0.0, heading(t)});
    predicted.P.diagonal().head<6>().setConstant(1e-8);
    UpdateResult update;
    update.last.count = 100;
    update.last.weighted_squares = 100.0;
    update.posterior = predicted;
    update.posterior.x.R = expSO3({0.0, 0.0, heading(t - lag_s)});
    update.posterior.P.diagonal().head<6>() *= 0.01;
    agreement.add(last, 0.1, predicted, update, Matrix6::Zero());
    last = predicted.x;
  }
  return agreement.gyroScale().value_or(GyroScale());
}

// A car turned off its straight way for the first time: clocks 5 ms apart counted as a gyro that
// sees 1.036 +- 0.002 times the turns, and the run ended degraded.
TEST(MotionAgreement, ATurnThatBeginsShowsNoScaleWhereTheClocksAreApart)
{
  const GyroScale found = scaleWithALag(0.005, 12);
  EXPECT_GT(std::abs(found.scale() - 1.0), 0.005);
  EXPECT_LT(found.leastError(), 0.005);
}

TEST(MotionAgreement, FewTurnsTellNothing)
{
  MotionAgreement agreement;
  TurningPlatform(expSO3({0.1, 0, 0}), 1.0).addTo(agreement, 60);
  EXPECT_FALSE(agreement.mountingError().has_value());
}

TEST(MotionAgreement, ScansThatDoNotFitTheMapContradictLess)
{
  // Errors five times as large as the covariance says.
  MotionAgreement fitting, among_trees;
  TurningPlatform platform(Mat3::Identity(), 5.0, 1e-2), in_park = platform;
  in_park.setResiduals(2.5);
  platform.addTo(fitting, 100);
  in_park.addTo(among_trees, 100);
  EXPECT_GT(fitting.unexplainedInnovation(), 12.0);
  EXPECT_NEAR(among_trees.unexplainedInnovation(), fitting.unexplainedInnovation() / 2.5, 1e-6);
}

TEST(MotionAgreement, NoTurnsTellNothing)
{
  MotionAgreement agreement;
  FilterState predicted;
  UpdateResult update;
  predicted.P.diagonal().setConstant(2e-6);
  update.posterior.P.diagonal().setConstant(1e-6);
  for (int i = 0; i < 300; ++i)
    agreement.add(NavState{}, 0.1, predicted, update, Matrix6::Zero());
  EXPECT_FALSE(agreement.mountingError().has_value());
  EXPECT_EQ(agreement.innovation(), 0.0);
}

}  // namespace
}  // namespace fastlio
