// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "random_matching.h"
#include <fastlio/matching/degeneracy.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace fastlio
{
namespace
{
/** Points on planes, and the planes that the map knows there. */
struct MatchedScan
{
  BodyPoints body;
  std::vector<PlaneMatch> matches;
};

void addPoint(MatchedScan& scan, const Vec3& p, const Vec3& normal, double normal_std)
{
  const std::size_t n = scan.body.size();
  scan.body.resize(n + 1);
  const Vec3 beam = p.normalized();
  scan.body.x[n] = static_cast<float>(p.x());
  scan.body.y[n] = static_cast<float>(p.y());
  scan.body.z[n] = static_cast<float>(p.z());
  scan.body.ux[n] = static_cast<float>(beam.x());
  scan.body.uy[n] = static_cast<float>(beam.y());
  scan.body.uz[n] = static_cast<float>(beam.z());
  PlaneMatch match;
  match.nx = static_cast<float>(normal.x());
  match.ny = static_cast<float>(normal.y());
  match.nz = static_cast<float>(normal.z());
  match.d = static_cast<float>(-normal.dot(p));
  match.variance = 1e-4F;
  match.normal_variance = static_cast<float>(2.0 * normal_std * normal_std);
  match.plane = static_cast<std::uint32_t>(n / 5);
  scan.matches.push_back(match);
}

/** A tunnel along x: walls, floor and ceiling with normals that are off by normal_std [rad], and
 * \a end_points on a wall across at its end. */
MatchedScan tunnel(double normal_std, int end_points)
{
  std::mt19937_64 random(5);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> along(-15.0, 15.0), across(-2.0, 2.0);
  MatchedScan scan;
  const auto noisy = [&](const Vec3& n)
  {
    const Vec3 tilt(gauss(random), gauss(random), gauss(random));
    return (n + normal_std * (tilt - n * n.dot(tilt))).normalized().eval();
  };
  for (int i = 0; i < 500; ++i)
  {
    const double side = i % 2 == 0 ? 2.0 : -2.0;
    addPoint(scan, {along(random), side, across(random)}, noisy(Vec3::UnitY()), normal_std);
    addPoint(scan, {along(random), across(random), side}, noisy(Vec3::UnitZ()), normal_std);
  }
  for (int i = 0; i < end_points; ++i)
    addPoint(scan, {15.0, across(random), across(random)}, noisy(Vec3::UnitX()), normal_std);
  return scan;
}

struct Analysis
{
  InformationSums sums;
  ScanConstraints constraints;
};

Matrix6 noiseOf(const MatchedScan& scan, const Pose& pose, const MeasuredScan& measured_scan)
{
  Matrix6 noise = Matrix6::Zero();
  for (std::size_t chunk = 0; chunk < measured_scan.chunks(); ++chunk)
    noise += normalNoiseInformation(pose.R, scan.body, scan.matches, measured_scan, chunk);
  return noise;
}

Analysis analyse(const MatchedScan& scan, double min_signal_to_noise = 10.0)
{
  ResidualModel model;
  model.gate = 1e9;
  const Pose pose;
  Analysis a;
  const MeasuredScan measured_scan = measured(pose, scan.body, scan.matches, model);
  a.sums = measured_scan.sums();
  const Matrix6 noise = noiseOf(scan, pose, measured_scan);
  StrongestPlanes strongest;
  strongest.look(measured_scan, scan.matches);
  a.constraints = informationByDirection(
      a.sums.HtRinvH, noise,
      strongest.unsupportedTranslations(measured_scan, a.sums.HtRinvH, noise, min_signal_to_noise));
  strongest.takeFromSupport(measured_scan, a.constraints);
  leaveOutUnconstrained(min_signal_to_noise, a.constraints);
  return a;
}

TEST(Degeneracy, TheAxisOfATunnelIsFound)
{
  const Analysis a = analyse(tunnel(0.01, 0));
  EXPECT_TRUE(mayBeDegenerate(a.sums.HtRinvH));
  ASSERT_EQ(a.constraints.unconstrained, 1);
  const auto motions = unconstrainedMotions(a.constraints);
  ASSERT_EQ(motions.size(), 1U);
  EXPECT_FALSE(motions[0].is_rotation);
  EXPECT_GT(std::abs(motions[0].axis.x()), 0.99);
}

TEST(Degeneracy, NoiseOfTheNormalsIsWhatThereIsAlongTheTunnel)
{
  // The information along the axis is a sum of squares of what the noise made of the normals.
  for (const double normal_std : {0.003, 0.01, 0.03})
  {
    const Analysis a = analyse(tunnel(normal_std, 0));
    const double variance = 2.0 * normal_std * normal_std;
    const double of_points = variance / (variance + kNormalVariance);
    EXPECT_NEAR(
        a.constraints.information[0] / (of_points * a.constraints.noise_information[0]), 1.0, 0.25)
        << normal_std;
  }
}

TEST(Degeneracy, NoiseIsTheSumOfTheRowsCovariances)
{
  const MatchedScan scan = tunnel(0.01, 20);
  const Pose pose{expSO3({0.3, -0.2, 1.1}), {1.0, -2.0, 0.5}};
  ResidualModel model;
  model.gate = 1e9;
  Matrix6 expected = Matrix6::Zero();
  for (std::size_t i = 0; i < scan.body.size(); ++i)
  {
    const PlaneMatch& match = scan.matches[i];
    const Vec3 n(match.nx, match.ny, match.nz), p(scan.body.x[i], scan.body.y[i], scan.body.z[i]);
    Eigen::Matrix<double, 6, 3> by_normal;
    by_normal << skew(p) * pose.R.transpose(), Mat3::Identity();
    const Mat3 covariance = 0.5 * (static_cast<double>(match.normal_variance) + kNormalVariance) *
                            (Mat3::Identity() - n * n.transpose());
    const double weight = 1.0 / planeMeasurement(pose, scan.body, i, match, model).variance;
    expected += weight * by_normal * covariance * by_normal.transpose();
  }
  const Matrix6 parts = noiseOf(scan, pose, measured(pose, scan.body, scan.matches, model));
  EXPECT_LT((parts - expected).norm(), 1e-6 * expected.norm());
}

// A voxel at an edge can fit a plane that stands across the tunnel: much information, and wrong.
TEST(Degeneracy, FewPlanesAcrossTheTunnelDoNotConstrainIt)
{
  MatchedScan scan = tunnel(0.01, 0);
  for (int i = 0; i < 30; ++i)
  {
    addPoint(scan, {3.0, 0.1 * i, 1.9}, Vec3::UnitX(), 0.01);
    scan.matches.back().plane = 10000U + static_cast<std::uint32_t>(i / 10);
  }
  const Analysis three = analyse(scan);
  EXPECT_GT(three.constraints.information[0], 50.0 * three.constraints.noise_information[0]);
  ASSERT_EQ(three.constraints.unconstrained, 1);
  EXPECT_GT(std::abs(unconstrainedMotions(three.constraints)[0].axis.x()), 0.99);

  for (std::size_t i = scan.matches.size() - 30; i < scan.matches.size(); ++i)
    scan.matches[i].plane = 10000U + static_cast<std::uint32_t>(i % 6);
  EXPECT_EQ(analyse(scan).constraints.unconstrained, 0) << "six planes agree";
}

// A short piece of a tunnel and one plane across it, beside the sensor. Turns about that plane are
// what the scan knows least, and the plane is not needed for these.
TEST(Degeneracy, OnePlaneAcrossDoesNotConstrainATunnelOfWhichLittleIsSeen)
{
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> along(-0.3, 0.3), across(-2.0, 2.0);
  MatchedScan scan;
  for (int i = 0; i < 500; ++i)
  {
    addPoint(scan, {along(random), i % 2 == 0 ? 2.0 : -2.0, across(random)}, Vec3::UnitY(), 0.005);
    addPoint(scan, {along(random), across(random), i % 2 == 0 ? 2.0 : -2.0}, Vec3::UnitZ(), 0.005);
  }
  for (int i = 0; i < 5; ++i)
  {
    addPoint(scan, {0.3, 1.9, across(random)}, Vec3::UnitX(), 0.005);
    scan.matches.back().plane = 10000;
  }
  const Analysis a = analyse(scan);
  ASSERT_EQ(a.constraints.unconstrained, 1);
  EXPECT_GT(std::abs(unconstrainedMotions(a.constraints)[0].axis.x()), 0.99);
  EXPECT_LT(a.constraints.directions.col(0).head<3>().norm(), 1e-9) << "no turn";
  // The other directions are known as before.
  EXPECT_NEAR(
      constrainedSums(a.sums, a.constraints).HtRinvH(4, 4) / a.sums.HtRinvH(4, 4), 1.0, 0.01);
}

TEST(Degeneracy, AWallAtTheEndConstrainsTheTunnel)
{
  const Analysis a = analyse(tunnel(0.01, 50));
  EXPECT_EQ(a.constraints.unconstrained, 0);
  EXPECT_EQ(a.constraints.projection, Matrix6::Identity());
}

/** Open ground of planes that lean by \a lean [rad], every \a step-th of them, while their normals
 * are known to 0.01 rad. */
MatchedScan roughGround(double lean, int step)
{
  constexpr double kNormalStd = 0.01;
  std::mt19937_64 random(6);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> around(-15.0, 15.0), near(-0.5, 0.5);
  MatchedScan scan;
  for (int plane = 0; plane < 300; ++plane)
  {
    const double std = std::hypot(plane % step == 0 ? lean : 0.0, kNormalStd);
    const Vec3 normal = Vec3(std * gauss(random), std * gauss(random), 1.0).normalized();
    const Vec3 middle(around(random), around(random), -2.0);
    for (int i = 0; i < 5; ++i)
    {
      const double x = near(random), y = near(random);
      const double z = -(normal.x() * x + normal.y() * y) / normal.z();
      addPoint(scan, middle + Vec3(x, y, z), normal, kNormalStd);
    }
  }
  return scan;
}

// A car on an open field was lost with perfect sensors: its ground has no tenfold signal.
TEST(Degeneracy, ManyPlanesThatLeanALittleConstrainAnOpenField)
{
  EXPECT_EQ(analyse(roughGround(0.03, 1)).constraints.unconstrained, 0);
  EXPECT_EQ(analyse(roughGround(0.0, 1)).constraints.unconstrained, 3) << "noise of the normals";
  EXPECT_EQ(analyse(roughGround(0.09, 12)).constraints.unconstrained, 3) << "of few planes";
}

TEST(Degeneracy, WhatIsLeftMovesTheOtherDirectionsOnly)
{
  const Analysis a = analyse(tunnel(0.01, 0));
  const InformationSums left = constrainedSums(a.sums, a.constraints);
  Vector6 axis = a.constraints.directions.col(0);
  axis.head<3>() /= a.constraints.lever_arm;
  EXPECT_LT((left.HtRinvH * axis).norm(), 1e-9 * left.HtRinvH.norm());
  EXPECT_LT(
      (a.constraints.projection * a.constraints.projection - a.constraints.projection).norm(),
      1e-9);
  const double across_before = a.sums.HtRinvH(4, 4), across_after = left.HtRinvH(4, 4);
  EXPECT_NEAR(across_after / across_before, 1.0, 0.01);
}

TEST(Degeneracy, NothingIsLeftAloneWhereItIsSwitchedOff)
{
  EXPECT_EQ(analyse(tunnel(0.01, 0), 0.0).constraints.unconstrained, 0);
}
}  // namespace
}  // namespace fastlio
