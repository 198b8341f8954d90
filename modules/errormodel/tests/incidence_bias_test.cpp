// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/incidence_bias.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace fastlio
{
namespace
{
constexpr double kPointWeight = 1.0 / 4e-4;  // of a noise of 2 cm

/** Passes planes, which are made of the points seen so far, with a bias and noise. */
class Walk
{
 public:
  /** \param nearest, farthest angle of incidence [rad] */
  BiasSums sums(double bias, double nearest, double farthest)
  {
    IncidenceBias learned;
    for (int scan = 0; scan < 100; ++scan)
    {
      Matrix6 information = Matrix6::Zero();
      for (std::uint32_t plane = 0; plane < kPlanes; ++plane)
      {
        const double progress = (scan + 0.5 * unit_(random_)) / 100.0;
        learned.add(
            plane, sign(plane) * std::cos(nearest + progress * (farthest - nearest)),
            point(plane, std::cos(nearest + progress * (farthest - nearest)), bias, information));
      }
      learned.finishScan(information);
    }
    return learned.sums();
  }

 private:
  static constexpr std::uint32_t kPlanes = 60;

  // Normals point to the sensor or away from it.
  static double sign(std::uint32_t plane) { return plane % 2 == 0 ? 1.0 : -1.0; }

  PointMeasurement point(std::uint32_t plane, double cosine, double bias, Matrix6& information)
  {
    Vector6 h;
    for (double& element : h.reshaped())
      element = unit_(random_);
    const double shift = bias * cosine * incidenceShape(cosine);
    double& mean = means_[plane];
    PointMeasurement point;
    point.weight = kPointWeight;
    point.weighted_h = kPointWeight * h;
    point.z = sign(plane) * (shift - mean + 0.02 * unit_(random_));
    information += kPointWeight * h * h.transpose();
    mean += (shift - mean) / ++counts_[plane];
    return point;
  }

  std::mt19937 random_{3};
  std::normal_distribution<double> unit_;
  std::vector<double> means_ = std::vector<double>(kPlanes), counts_ = means_;
};

double estimateOf(const BiasSums& sums)
{
  return sums.weighted / sums.information;
}

TEST(IncidenceBias, IsThatAtEightyDegrees)
{
  EXPECT_DOUBLE_EQ(incidenceShape(1.0), 0.0);
  EXPECT_DOUBLE_EQ(incidenceShape(std::cos(80.0 * M_PI / 180.0)), 1.0);
}

TEST(IncidenceBias, IsFoundOnPlanesThatAreSeenAtManyAngles)
{
  const BiasSums sums = Walk().sums(-0.02, 1.5, 0.3);
  EXPECT_NEAR(estimateOf(sums), -0.02, 4.0 / std::sqrt(sums.information));
  EXPECT_LT(1.0 / std::sqrt(sums.information), 0.004);
  const BiasSums none = Walk().sums(0.0, 1.5, 0.3);
  EXPECT_NEAR(estimateOf(none), 0.0, 4.0 / std::sqrt(none.information));
}

TEST(IncidenceBias, IsNotKnownFromASingleAngle)
{
  const BiasSums sums = Walk().sums(-0.02, 1.2, 1.2);
  EXPECT_GT(1.0 / std::sqrt(sums.information + 1e-30), 0.02);
}
}  // namespace
}  // namespace fastlio
