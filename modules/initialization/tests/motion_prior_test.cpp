// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/filter/propagation.h>
#include <fastlio/initialization/motion_prior.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
TEST(PropagatedBack, IsTheInverseOfThePropagation)
{
  constexpr std::int64_t kStepNs = 10'000'000;
  Inputs inputs;
  for (int i = 0; i < 10; ++i)
  {
    const double t = 0.01 * i;
    inputs.samples.push_back(
        {i * kStepNs, Vec3(5.0 - t, 2.0, -3.0 + 4.0 * t), Vec3(1.0, 9.0 * t, 9.81)});
  }
  inputs.end_ns = 10 * kStepNs;
  NavState begin;
  begin.R = expSO3({0.3, -0.2, 1.1});
  begin.p = Vec3(1.0, 2.0, 3.0);
  begin.v = Vec3(-4.0, 5.0, 0.5);
  begin.gyro_bias = Vec3(0.01, -0.02, 0.03);
  begin.accel_bias = Vec3(0.1, 0.2, -0.1);
  NavState end = begin;
  for (std::size_t i = 0; i < inputs.samples.size(); ++i)
    end = propagateMean(end, inputs.samples[i].gyro, inputs.samples[i].accel, inputs.duration(i));
  const NavState back = propagatedBack(end, inputs);
  EXPECT_LT((back.R - begin.R).norm(), 1e-12);
  EXPECT_LT((back.v - begin.v).norm(), 1e-12);
  EXPECT_LT((back.p - begin.p).norm(), 1e-12);
}
}  // namespace
}  // namespace fastlio
