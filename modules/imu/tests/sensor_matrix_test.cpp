// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/imu/imu_conditioner.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fastlio
{
namespace
{
constexpr double kGravityLength = 9.81;

std::vector<ImuSample> turning()
{
  std::vector<ImuSample> samples;
  for (int i = 0; i < 400; ++i)
  {
    const double t = 0.005 * i;
    samples.push_back(
        {1'700'000'000'000'000'000 + i * 5'000'000LL, Vec3(std::cos(2.0 * t), 0.1, -0.2),
         Vec3(0.1, 0.2 * std::sin(t), kGravityLength)});
  }
  return samples;
}

ImuOptions withMatrices()
{
  ImuOptions options;
  options.gyro_matrix = {1.01, 0.002, 0.0, 0.0, 1.0, 0.003, 0.0, 0.0, 0.99};
  options.accel_matrix = {1.0, 0.0, 0.004, 0.0, 1.0, 0.0, 0.0, 0.0, 1.005};
  return options;
}

std::vector<ImuSample> measured(std::vector<ImuSample> samples, const ImuOptions& options)
{
  for (ImuSample& sample : samples)
  {
    sample.gyro = (sensorMatrix(options.gyro_matrix) * sample.gyro).eval();
    sample.accel = (sensorMatrix(options.accel_matrix) * sample.accel).eval();
  }
  return samples;
}

TEST(SensorMatrix, IsTakenOffTheReadings)
{
  const std::vector<ImuSample> truth = turning();
  ImuConditioner conditioner(withMatrices(), kGravityLength);
  std::vector<ImuSample> out;
  const auto append = [&out](const std::vector<ConditionedSample>& ready)
  {
    for (const ConditionedSample& conditioned : ready)
      out.push_back(conditioned.sample);
  };
  for (const ImuSample& sample : measured(truth, withMatrices()))
    append(conditioner.add(sample));
  append(conditioner.finish());
  ASSERT_EQ(out.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    EXPECT_LT((out[i].gyro - truth[i].gyro).norm(), 1e-12);
    EXPECT_LT((out[i].accel - truth[i].accel).norm(), 1e-11);
  }
}

// Clipping shows in the axes of the sensor: it must be found before the axes are mixed.
TEST(SensorMatrix, DoesNotHideClipping)
{
  ImuOptions options = withMatrices();
  options.gyro_range = 0.5;
  ImuConditioner conditioner(options, kGravityLength);
  for (ImuSample sample : measured(turning(), options))
  {
    sample.gyro[0] = std::min(sample.gyro[0], 0.5);
    (void)conditioner.add(sample);
  }
  EXPECT_GT(conditioner.report().saturated, 100U);
}

TEST(SensorMatrix, NothingIsTheIdentity)
{
  EXPECT_EQ(sensorMatrix({}), Mat3::Identity());
}
}  // namespace
}  // namespace fastlio
