// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "short_simulation.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/gravity.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{

/** The motion of shaking hands, felt by an IMU with no error but those that a test adds. */
SimulationSettings exactShake()
{
  return testing::withoutErrors(testing::shortSettings("shake", 14.0));
}

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat36 = Eigen::Matrix<double, 3, 6>;

/** Readings of a sensor as linear functions of the true rate and force, by least squares. */
struct Fit
{
  Mat36 gyro, accel;
};

Fit fitReadings(const ImuRecording& read, const ImuRecording& ideal)
{
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  Mat36 gyro = Mat36::Zero(), accel = Mat36::Zero();
  for (std::size_t i = 0; i < ideal.samples.size(); ++i)
  {
    Vec6 truth;
    truth << ideal.samples[i].gyro, ideal.samples[i].accel;
    squares += truth * truth.transpose();
    gyro += read.samples[i].gyro * truth.transpose();
    accel += read.samples[i].accel * truth.transpose();
  }
  const Eigen::Matrix<double, 6, 6> inverse = squares.inverse();
  return {gyro * inverse, accel * inverse};
}

TEST(ImuErrors, ReadingsShowTheMatricesThatTheRecordingCallsTrue)
{
  SimulationSettings settings = exactShake();
  const Simulation ideal(settings);
  settings.imu.errors.gyro_scale_std = 0.005;
  settings.imu.errors.accel_scale_std = 0.01;
  settings.imu.errors.gyro_misalignment_std = 0.2 * kRadPerDeg;
  settings.imu.errors.accel_misalignment_std = 0.4 * kRadPerDeg;
  settings.imu.errors.g_sensitivity_std = 0.05 * kRadPerDeg / kStandardGravity;
  const Simulation real(settings);
  const Fit fit = fitReadings(real.imu(), ideal.imu());
  const ImuErrors& truth = real.imu().errors;
  EXPECT_LT((fit.gyro.leftCols<3>() - truth.gyro).norm(), 1e-9);
  EXPECT_LT((fit.gyro.rightCols<3>() - truth.g_sensitivity).norm(), 1e-9);
  EXPECT_LT((fit.accel.rightCols<3>() - truth.accel).norm(), 1e-9);
  EXPECT_LT(fit.accel.leftCols<3>().norm(), 1e-9);
  EXPECT_GT((truth.gyro - Mat3::Identity()).norm(), 1e-3);
  EXPECT_GT((truth.accel - Mat3::Identity()).norm(), 1e-3);
  EXPECT_GT(truth.g_sensitivity.norm(), 1e-5);
}

/** Root mean square over all seeds of what a function gives for the drawn errors. */
template <typename Sum>
double scatterOverSeeds(SimulationSettings settings, Sum squares_of, int count_of_each)
{
  constexpr int kSeeds = 300;
  double sum = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed)
  {
    settings.seed = static_cast<std::uint64_t>(seed);
    sum += squares_of(drawImuErrors(settings));
  }
  return std::sqrt(sum / (kSeeds * count_of_each));
}

TEST(ImuErrors, ScatterOverSeedsAsTheSettingsSay)
{
  SimulationSettings settings;
  settings.imu.errors = {0.005, 0.008, 0.003, 0.004, 1e-4, 0};
  const Mat3 one = Mat3::Identity();
  const auto diagonal = [&](const Mat3& m) { return (m - one).diagonal().squaredNorm(); };
  const auto other = [&](const Mat3& m) { return (m - one).squaredNorm() - diagonal(m); };
  // 900 or more draws: 3 sigma of the root mean square is 7 %.
  const auto near = [](double value, double meant) { EXPECT_NEAR(value, meant, 0.07 * meant); };
  near(
      scatterOverSeeds(
          settings, [&](const ImuErrors& e) { return diagonal(e.gyro); }, 3),
      0.005);
  near(
      scatterOverSeeds(
          settings, [&](const ImuErrors& e) { return diagonal(e.accel); }, 3),
      0.008);
  near(
      scatterOverSeeds(
          settings, [&](const ImuErrors& e) { return other(e.gyro); }, 6),
      0.003);
  near(
      scatterOverSeeds(
          settings, [&](const ImuErrors& e) { return other(e.accel); }, 6),
      0.004);
  const auto g = [](const ImuErrors& e) { return e.g_sensitivity.squaredNorm(); };
  near(scatterOverSeeds(settings, g, 9), 1e-4);
}

TEST(ImuErrors, ConverterRoundsToItsSteps)
{
  SimulationSettings settings = testing::shortSettings("office", 4.0);
  const Simulation exact(settings);
  settings.imu.errors.bits = 16;
  const Simulation rounded(settings);
  const double step = 2.0 * settings.imu.gyro_limit / 65536.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < exact.imu().samples.size(); ++i)
  {
    const Vec3& read = rounded.imu().samples[i].gyro;
    const Vec3 error = read - exact.imu().samples[i].gyro;
    EXPECT_LE(error.cwiseAbs().maxCoeff(), 0.5 * step * (1.0 + 1e-9));
    for (const double v : read)
      EXPECT_NEAR(v / step, std::round(v / step), 1e-6);
    squares += error.squaredNorm();
  }
  const double rms = std::sqrt(squares / (3.0 * static_cast<double>(exact.imu().samples.size())));
  EXPECT_NEAR(rms, step / std::sqrt(12.0), 0.03 * step);
}

/** Root mean square of the differences between two recordings of one motion, per axis. */
struct Difference
{
  double gyro = 0.0, accel = 0.0;
};

Difference differenceWhileMoving(const Simulation& a, const Simulation& b)
{
  Difference d;
  std::size_t n = 0;
  for (std::size_t i = 0; i < a.imu().samples.size(); ++i)
  {
    if (a.secondsSinceStart(a.imu().samples[i].stamp_ns) < 5.0) continue;  // rest and start
    d.gyro += (a.imu().samples[i].gyro - b.imu().samples[i].gyro).squaredNorm();
    d.accel += (a.imu().samples[i].accel - b.imu().samples[i].accel).squaredNorm();
    ++n;
  }
  const double count = 3.0 * static_cast<double>(n);
  return {std::sqrt(d.gyro / count), std::sqrt(d.accel / count)};
}

TEST(CarrierVibration, HasTheGivenPowerFrom20To200Hz)
{
  SimulationSettings settings = testing::withoutErrors(testing::shortSettings("campus", 25.0));
  const Simulation still(settings);
  settings.carrier.vibration_accel = 0.5;
  settings.carrier.vibration_gyro = 0.02;
  const Simulation shaken(settings);
  const Difference read = differenceWhileMoving(shaken, still);
  EXPECT_NEAR(read.accel, 0.5, 0.05);
  EXPECT_NEAR(read.gyro, 0.02, 0.002);
  // Acceleration over travel is the square of the frequency, of every tone.
  double travel = 0.0, accel = 0.0;
  for (double t = 6.0; t < 10.0; t += 0.0007)
  {
    const Kinematics a = shaken.motion().at(t), b = still.motion().at(t);
    travel += (a.T_world_imu.p - b.T_world_imu.p).squaredNorm();
    accel += (a.acceleration - b.acceleration).squaredNorm();
  }
  const double frequency = std::sqrt(std::sqrt(accel / travel)) / kTwoPi;
  EXPECT_GT(frequency, 20.0);
  EXPECT_LT(frequency, 200.0);
}

TEST(CarrierVibration, CarriesTheLidarToo)
{
  SimulationSettings settings = testing::withoutErrors(testing::shortSettings("campus", 8.0));
  const Simulation still(settings);
  settings.carrier.vibration_accel = 50.0;
  const Simulation shaken(settings);
  const PointColumns a = pointsOf(still.fire(70)), b = pointsOf(shaken.fire(70));
  ASSERT_EQ(a.size(), b.size());
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, static_cast<double>(std::abs(a.z[i] - b.z[i])));
  EXPECT_GT(most, 1e-4);
}

TEST(CarrierVibration, RestsWithThePlatform)
{
  SimulationSettings settings = testing::withoutErrors(testing::shortSettings("campus", 4.0));
  settings.carrier.vibration_accel = 50.0;
  const Kinematics k = Simulation(settings).motion().at(1.0);
  EXPECT_EQ(k.velocity.norm(), 0.0);
  EXPECT_EQ(k.acceleration.norm(), 0.0);
}
}  // namespace
}  // namespace fastlio
