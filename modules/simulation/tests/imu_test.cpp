// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "short_simulation.h"
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
/** A motionless IMU without any error. */
SimulationSettings quiet(double duration)
{
  return testing::withoutErrors(testing::shortSettings("rest", duration));
}

/** Standard deviation of all components around the ideal reading at rest. */
struct Scatter
{
  double gyro = 0.0, accel = 0.0;
};

Scatter scatterAtRest(const ImuRecording& imu, const Vec3& specific_force)
{
  double gyro = 0.0, accel = 0.0;
  for (const auto& sample : imu.samples)
  {
    gyro += sample.gyro.squaredNorm();
    accel += (sample.accel - specific_force).squaredNorm();
  }
  const double n = 3.0 * static_cast<double>(imu.samples.size());
  return {std::sqrt(gyro / n), std::sqrt(accel / n)};
}

Vec3 forceAtRest(const Simulation& simulation)
{
  return specificForce(simulation.motion().at(0.0), {0, 0, -simulation.settings().gravity});
}

TEST(ImuModel, FeelsGravityUpwardsAtRest)
{
  const Simulation simulation(quiet(3.0));
  const Pose pose = simulation.motion().pose(0.0);
  for (const auto& sample : simulation.imu().samples)
  {
    EXPECT_LT((pose.R * sample.accel - Vec3(0, 0, 9.81)).norm(), 1e-12);
    EXPECT_LT(sample.gyro.norm(), 1e-15);
  }
}

TEST(ImuModel, SamplesComeAtTheRateWithExactStamps)
{
  for (const double rate : {100.0, 150.0, 200.0, 400.0})
  {
    SimulationSettings settings = quiet(3.0);
    settings.imu.rate = rate;
    const ImuRecording imu = Simulation(settings).imu();
    ASSERT_EQ(imu.samples.size(), static_cast<std::size_t>(3.0 * rate) + 1);
    for (std::size_t i = 0; i < imu.samples.size(); ++i)
    {
      const auto elapsed = static_cast<double>(imu.samples[i].stamp_ns - settings.start_ns);
      EXPECT_NEAR(elapsed, 1e9 * static_cast<double>(i) / rate, 50.0);
      EXPECT_EQ(imu.samples[i].stamp_ns % 100, 0);
    }
  }
}

TEST(ImuModel, WhiteNoiseHasDensityTimesRootRate)
{
  SimulationSettings settings = quiet(100.0);
  settings.imu.noise.gyro_noise_density = 3e-4;
  settings.imu.noise.accel_noise_density = 2e-3;
  const Simulation simulation(settings);
  const Scatter scatter = scatterAtRest(simulation.imu(), forceAtRest(simulation));
  EXPECT_NEAR(scatter.gyro, 3e-4 * std::sqrt(200.0), 0.02 * 3e-4 * std::sqrt(200.0));
  EXPECT_NEAR(scatter.accel, 2e-3 * std::sqrt(200.0), 0.02 * 2e-3 * std::sqrt(200.0));
}

TEST(ImuModel, BiasesWalkWithTheRootOfTime)
{
  constexpr int kSeeds = 60;
  constexpr double kDuration = 9.0;
  double gyro = 0.0, accel = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed)
  {
    SimulationSettings settings = quiet(kDuration);
    settings.seed = static_cast<std::uint64_t>(seed);
    settings.imu.noise.gyro_bias_walk = 2e-4;
    settings.imu.noise.accel_bias_walk = 5e-3;
    const Simulation simulation(settings);
    const auto& bias = simulation.imu().true_bias;
    gyro += (bias.back().gyro - bias.front().gyro).squaredNorm();
    accel += (bias.back().accel - bias.front().accel).squaredNorm();
    EXPECT_LT((simulation.imu().samples.back().gyro - bias.back().gyro).norm(), 1e-12);
  }
  // Chi-square with 180 degrees of freedom: the root of the mean lies within 16 % at 3 sigma.
  EXPECT_NEAR(std::sqrt(gyro / (3 * kSeeds)), 2e-4 * 3.0, 0.16 * 2e-4 * 3.0);
  EXPECT_NEAR(std::sqrt(accel / (3 * kSeeds)), 5e-3 * 3.0, 0.16 * 5e-3 * 3.0);
}

TEST(ImuModel, InitialBiasIsMeanPlusScatterOverSeeds)
{
  Vec3 sum = Vec3::Zero();
  double squares = 0.0;
  constexpr int kSeeds = 200;
  const Vec3 mean(0.1, -0.2, 0.05);
  for (int seed = 1; seed <= kSeeds; ++seed)
  {
    SimulationSettings settings = quiet(0.02);
    settings.seed = static_cast<std::uint64_t>(seed);
    settings.imu.gyro_bias = mean;
    settings.imu.gyro_bias_std = 0.01;
    const Vec3 bias = Simulation(settings).imu().true_bias.front().gyro;
    sum += bias;
    squares += (bias - mean).squaredNorm();
  }
  EXPECT_LT((sum / kSeeds - mean).cwiseAbs().maxCoeff(), 0.003);
  EXPECT_NEAR(std::sqrt(squares / (3 * kSeeds)), 0.01, 0.0012);
}

TEST(ImuModel, OneSourceOfNoiseLeavesTheOthersAsTheyWere)
{
  SimulationSettings settings = testing::shortSettings("office", 4.0);
  const Simulation base(settings);
  settings.imu.noise.accel_noise_density *= 5.0;
  settings.imu.stamp_jitter = 1e-4;
  const Simulation changed(settings);
  for (std::size_t i = 0; i < base.imu().samples.size(); ++i)
    ASSERT_EQ((base.imu().samples[i].gyro - changed.imu().samples[i].gyro).norm(), 0.0);
}

TEST(ImuModel, SaturatesAtItsLimits)
{
  SimulationSettings settings = testing::shortSettings("shake", 12.0);
  settings.imu.gyro_limit = 4.0;
  settings.imu.accel_limit = 9.0;
  std::size_t at_limit = 0;
  const Simulation simulation(settings);
  for (const auto& sample : simulation.imu().samples)
  {
    EXPECT_LE(sample.gyro.cwiseAbs().maxCoeff(), 4.0);
    EXPECT_LE(sample.accel.cwiseAbs().maxCoeff(), 9.0);
    at_limit += sample.gyro.cwiseAbs().maxCoeff() == 4.0 ? 1 : 0;
  }
  EXPECT_GT(at_limit, 100U);
}

TEST(ImuModel, JitterKeepsTheOrder)
{
  SimulationSettings settings = testing::shortSettings("office", 5.0);
  settings.imu.stamp_jitter = 0.004;
  const Simulation simulation(settings);
  const auto& samples = simulation.imu().samples;
  double squares = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i)
  {
    ASSERT_GT(samples[i].stamp_ns, samples[i - 1].stamp_ns);
    const double late =
        toSeconds(samples[i].stamp_ns - settings.start_ns) - 0.005 * static_cast<double>(i);
    squares += late * late;
  }
  const double rms = std::sqrt(squares / static_cast<double>(samples.size() - 1));
  EXPECT_GT(rms, 0.001);
  EXPECT_LE(rms, 0.45 * 0.005);
}

TEST(ImuModel, LosesSamplesAsAsked)
{
  SimulationSettings settings = testing::shortSettings("office", 20.0);
  settings.imu.dropout = 0.1;
  const Simulation dropping(settings);
  EXPECT_NEAR(static_cast<double>(dropping.imu().lost) / 4001.0, 0.1, 0.02);
  EXPECT_EQ(dropping.imu().lost + dropping.imu().samples.size(), 4001U);
  EXPECT_EQ(dropping.imu().true_bias.size(), dropping.imu().samples.size());

  settings.imu.dropout = 0.0;
  settings.imu.gap_interval = 5.0;
  settings.imu.gap_length = 0.3;
  const Simulation gaps(settings);
  const auto& samples = gaps.imu().samples;
  int longest = 0;
  for (std::size_t i = 1; i < samples.size(); ++i)
    longest += samples[i].stamp_ns - samples[i - 1].stamp_ns > 290'000'000 ? 1 : 0;
  EXPECT_EQ(longest, 3);  // 5, 10 and 15 s after the rest of 2.5 s
}

TEST(ImuModel, VibrationHasTheGivenPower)
{
  SimulationSettings settings = quiet(60.0);
  settings.imu.vibration_gyro = 0.05;
  settings.imu.vibration_accel = 2.0;
  const Simulation simulation(settings);
  const Scatter scatter = scatterAtRest(simulation.imu(), forceAtRest(simulation));
  EXPECT_NEAR(scatter.gyro, 0.05 / std::sqrt(2.0), 0.002);
  EXPECT_NEAR(scatter.accel, 2.0 / std::sqrt(2.0), 0.08);
}

TEST(ImuModel, AveragesAreIncrementsOfTheTruth)
{
  SimulationSettings settings = testing::withoutErrors(testing::shortSettings("office", 10.0));
  settings.imu.rate = 200.0;
  settings.imu.average = true;
  const Simulation simulation(settings);
  const auto& samples = simulation.imu().samples;
  for (std::size_t i = 1; i < samples.size(); ++i)
  {
    const Kinematics before = simulation.truth(samples[i - 1].stamp_ns);
    const Kinematics after = simulation.truth(samples[i].stamp_ns);
    // First order in the rotation within a period, hence the tolerances.
    const Vec3 turned = logSO3(before.T_world_imu.R.transpose() * after.T_world_imu.R);
    EXPECT_LT((turned / 0.005 - samples[i].gyro).norm(), 2e-5);
    const Vec3 mean_force =
        simulation.truth((samples[i - 1].stamp_ns + samples[i].stamp_ns) / 2).T_world_imu.R *
        samples[i].accel;
    const Vec3 gained = (after.velocity - before.velocity) / 0.005 - Vec3(0, 0, -9.81);
    EXPECT_LT((mean_force - gained).norm(), 2e-3);
  }
}
}  // namespace
}  // namespace fastlio
