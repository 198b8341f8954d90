// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/errormodel/side_errors.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace fastlio
{
namespace
{
constexpr double kSideWeight = 1.0 / 4e-4;  // of a range noise of 2 cm

/** Scans of a street: walls to the left and to the right, the ground below. */
class Street
{
 public:
  /** \param offsets of the ranges to the left wall, the right one, and the ground [m] */
  void scan(SideErrors& sides, const std::array<double, 3>& offsets)
  {
    sides.beginScan();
    for (int i = 0; i < 3000; ++i)
    {
      const auto surface = static_cast<std::size_t>(i % 3);
      const double ahead = uniform_(random_), cosine = 0.4 + 0.2 * uniform_(random_);
      BeamGeometry beam{5.0 * ahead, surface == 0 ? 6.0 : -6.0, cosine, surface == 2 ? 1.0 : 0.0};
      PointMeasurement point;
      point.weight = kSideWeight;
      point.weighted_h.setZero();
      point.weighted_h[4] = surface == 2 ? 0.0 : kSideWeight * (surface == 0 ? 1.0 : -1.0);
      point.weighted_h[5] = surface == 2 ? kSideWeight : 0.0;
      point.z = offsets[surface] * cosine + 0.02 * normal_(random_);
      sides.add(beam, point, cosine * point.weighted_h);
    }
    sides.learn();
  }

 private:
  std::mt19937 random_{5};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

TEST(SideErrors, AreNoneInNoise)
{
  Street street;
  SideErrors sides;
  EXPECT_EQ(sides.covariance().norm(), 0.0);
  for (int i = 0; i < 200; ++i)
    street.scan(sides, {0.0, 0.0, 0.0});
  EXPECT_LT(sides.rangeOffset(), 2e-3);
}

/** Four times what is left over in the residuals: pose and map have taken up the rest. */
TEST(SideErrors, AreLearntFromWhatTheSidesHaveInCommon)
{
  Street street;
  SideErrors sides;
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 0.002);
  for (int i = 0; i < 400; ++i)
    street.scan(sides, {normal(random), normal(random), normal(random)});
  EXPECT_NEAR(sides.rangeOffset(), 4 * 0.002, 1e-3);
}

TEST(SideErrors, AWallToTheLeftMovesTheScanSideways)
{
  Street street;
  SideErrors sides;
  for (int i = 0; i < 200; ++i)
    street.scan(sides, {0.003, 0.0, 0.0});
  const Matrix6 covariance = sides.covariance();
  EXPECT_GT(covariance(4, 4), 0.0);
  EXPECT_EQ(covariance(3, 3), 0.0);
  EXPECT_TRUE(covariance.isApprox(covariance.transpose()));
}

TEST(SideErrors, AFewOffsetsAreNotBelieved)
{
  Street street;
  SideErrors sides;
  for (int i = 0; i < 5; ++i)
    street.scan(sides, {0.01, -0.01, 0.0});
  EXPECT_EQ(sides.rangeOffset(), 0.0);
}
}  // namespace
}  // namespace fastlio
