// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/math/so3.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace fastlio
{
namespace
{
class So3 : public ::testing::Test
{
 protected:
  Vec3 randomVector() { return {normal_(rng_), normal_(rng_), normal_(rng_)}; }
  Vec3 randomAxis() { return randomVector().normalized(); }

 private:
  std::mt19937 rng_{20210707};
  std::normal_distribution<double> normal_;
};

/** Angles in [0, pi): zero, tiny, around the switch between series and closed form, near pi. */
const std::vector<double>& angles()
{
  static const std::vector<double> values = {
      0.0,       1e-300,     1e-12,      1e-10,      1e-9,        1e-8,       1e-5, 1e-3,
      0.1,       0.24,       0.25,       0.26,       1.0,         kPi / 2,    2.0,  3.0,
      kPi - 0.1, kPi - 1e-4, kPi - 1e-6, kPi - 1e-8, kPi - 1e-10, kPi - 1e-12};
  return values;
}

double distanceFromRotation(const Mat3& R)
{
  return (R * R.transpose() - Mat3::Identity()).norm() + std::abs(R.determinant() - 1.0);
}

TEST_F(So3, SkewIsTheCrossProduct)
{
  for (int i = 0; i < 100; ++i)
  {
    const Vec3 a = randomVector();
    const Vec3 b = randomVector();
    EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-14);
    EXPECT_EQ((skew(a) + skew(a).transpose()).norm(), 0.0);
    const Mat3 R = expSO3(randomVector());
    EXPECT_LT((R * skew(a) * R.transpose() - skew(R * a)).norm(), 1e-13);
  }
}

TEST_F(So3, ExpIsTheRotationAboutTheAxis)
{
  for (const double angle : angles())
  {
    const Vec3 axis = randomAxis();
    const Mat3 R = expSO3(angle * axis);
    const Mat3 expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    EXPECT_LT((R - expected).norm(), 2e-15) << angle;
    EXPECT_LT(distanceFromRotation(R), 5e-15) << angle;
  }
  EXPECT_EQ(expSO3(Vec3::Zero()), Mat3::Identity());
}

TEST_F(So3, ExpOfManyTurnsIsStillARotation)
{
  for (const double angle : {4.0, 7.0, 100.0})
  {
    const Vec3 axis = randomAxis();
    const Mat3 expected = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    EXPECT_LT((expSO3(angle * axis) - expected).norm(), 1e-13) << angle;
  }
}

TEST_F(So3, LogInvertsExpAtEveryAngle)
{
  for (const double angle : angles())
  {
    for (int i = 0; i < 20; ++i)
    {
      const Vec3 u = angle * randomAxis();
      EXPECT_LT((logSO3(expSO3(u)) - u).norm(), 1e-15 + 4e-15 * angle) << angle;
    }
  }
}

TEST_F(So3, LogKeepsTheRelativePrecisionOfTinyAngles)
{
  for (const double angle : {1e-12, 1e-10, 1e-9, 1e-8})
  {
    const Vec3 u = angle * randomAxis();
    EXPECT_LT((logSO3(expSO3(u)) - u).norm() / angle, 1e-14) << angle;
  }
}

TEST_F(So3, LogAtExactlyPi)
{
  std::vector<Vec3> axes = {
      Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), Vec3(1, 1, 0).normalized(),
      Vec3(0, 1, -1).normalized()};
  for (int i = 0; i < 50; ++i)
    axes.push_back(randomAxis());
  for (const Vec3& n : axes)
  {
    const Mat3 half_turn = 2.0 * n * n.transpose() - Mat3::Identity();
    const Vec3 u = logSO3(half_turn);
    EXPECT_NEAR(u.norm(), kPi, 1e-14);
    EXPECT_LT((expSO3(u) - half_turn).norm(), 1e-14);
  }
}

TEST_F(So3, LogIsNeverLongerThanPi)
{
  for (int i = 0; i < 1000; ++i)
  {
    const Mat3 R = expSO3(5.0 * randomVector());
    const Vec3 u = logSO3(R);
    EXPECT_LE(u.norm(), kPi + 1e-15);
    EXPECT_LT((expSO3(u) - R).norm(), 1e-13);
  }
}

TEST_F(So3, LeftJacobianTimesTheInverseOfThePaperIsIdentity)
{
  for (const double m : {0.2, 0.24, 0.26, 1.0, 2.0, 3.0, kPi})
  {
    const Vec3 u = m * randomAxis();
    const double alpha = m / 2.0 / std::tan(m / 2.0);
    const Mat3 inverse =
        Mat3::Identity() - skew(u) / 2.0 + (1.0 - alpha) * skew(u) * skew(u) / (m * m);
    EXPECT_LT((leftJacobianSO3(u) * inverse - Mat3::Identity()).norm(), 1e-13) << m;
  }
  EXPECT_EQ(leftJacobianSO3(Vec3::Zero()), Mat3::Identity());
}

TEST_F(So3, LeftJacobianIsTheDerivativeOfExp)
{
  // Exp(u + e) = Exp(A(u) e) Exp(u) to first order in e; central differences.
  constexpr double kStep = 1e-5;
  for (const double angle : {0.0, 1e-9, 1e-4, 0.1, 0.25, 1.0, 2.0, 3.0, kPi - 1e-6})
  {
    const Vec3 u = angle * randomAxis();
    const Mat3 back = expSO3(u).transpose();
    Mat3 numeric;
    for (int c = 0; c < 3; ++c)
    {
      const Vec3 e = kStep * Vec3::Unit(c);
      numeric.col(c) =
          (logSO3(expSO3(u + e) * back) - logSO3(expSO3(u - e) * back)) / (2.0 * kStep);
    }
    EXPECT_LT((leftJacobianSO3(u) - numeric).norm(), 1e-9) << angle;
    EXPECT_LT((leftJacobianSO3(-u) - leftJacobianSO3(u).transpose()).norm(), 1e-15) << angle;
  }
}

TEST_F(So3, JacobianLeavesItsOwnAxis)
{
  for (const double angle : angles())
  {
    const Vec3 u = angle * randomAxis();
    EXPECT_LT((leftJacobianSO3(u).transpose() * u - u).norm(), 1e-14) << angle;
  }
}

TEST_F(So3, NormalizeRotationRemovesDriftAndKeepsRotations)
{
  for (int i = 0; i < 100; ++i)
  {
    const Mat3 R = expSO3(3.0 * randomVector());
    EXPECT_LT((normalizeRotation(R) - R).norm(), 1e-14);
    const Mat3 stretch =
        Mat3::Identity() + 1e-3 * Vec3(randomVector()).asDiagonal().toDenseMatrix();
    // A symmetric positive factor is exactly what the polar decomposition takes away.
    EXPECT_LT((normalizeRotation(R * stretch) - R).norm(), 1e-14);
    EXPECT_LT(distanceFromRotation(normalizeRotation(R + 1e-2 * skew(randomVector()))), 1e-14);
  }
}

TEST_F(So3, NormalizeRotationPassesNonFiniteNumbersOn)
{
  Mat3 bad = Mat3::Identity();
  bad(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(normalizeRotation(bad).allFinite());
}
}  // namespace
}  // namespace fastlio
