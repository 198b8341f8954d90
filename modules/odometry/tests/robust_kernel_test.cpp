// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/odometry/point_to_plane.h>
#include <fastlio/odometry/robust_kernel.h>

#include <gtest/gtest.h>

namespace fastlio
{
namespace
{
constexpr RobustKernel kKernels[] = {
    RobustKernel::Huber, RobustKernel::Cauchy, RobustKernel::GemanMcClure};

TEST(RobustKernel, weighsSmallResidualsFully)
{
  EXPECT_EQ(robustWeight(RobustKernel::None, 1e6, 2.0), 1.0);
  for (const RobustKernel kernel : kKernels)
  {
    EXPECT_EQ(robustWeight(kernel, 0.0, 2.0), 1.0);
    EXPECT_GT(robustWeight(kernel, 1e-4, 2.0), 0.999);
  }
}

TEST(RobustKernel, weighsLargerResidualsLess)
{
  for (const RobustKernel kernel : kKernels)
    for (double r = 2.5; r < 50.0; r *= 1.5)
      EXPECT_LT(robustWeight(kernel, 2.25 * r * r, 2.0), robustWeight(kernel, r * r, 2.0));
}

TEST(RobustKernel, isWhatItsNameSays)
{
  const double k = 2.0, r = 6.0;
  EXPECT_DOUBLE_EQ(robustWeight(RobustKernel::Huber, r * r, k) * r, k) << "constant force";
  EXPECT_DOUBLE_EQ(robustWeight(RobustKernel::Cauchy, r * r, k), 0.1);
  EXPECT_DOUBLE_EQ(robustWeight(RobustKernel::GemanMcClure, r * r, k), 0.01);
}

TEST(RobustKernel, makesTheWeightOfAMeasurement)
{
  PlaneMeasurement m;
  m.z = 0.06;
  m.variance = 1e-4;
  ResidualModel model;
  EXPECT_DOUBLE_EQ(weightOf(m, model), 1e4);
  model.kernel = RobustKernel::Cauchy;
  model.kernel_scale = 2.0;
  EXPECT_NEAR(weightOf(m, model), 1e3, 1e-9);
}
}  // namespace
}  // namespace fastlio
