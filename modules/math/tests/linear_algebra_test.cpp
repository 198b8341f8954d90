// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/linear_algebra.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace fastlio::testing
{
namespace
{
using Square25 = Eigen::Matrix<double, 25, 25>;
using By6 = Eigen::Matrix<double, 25, 6, Eigen::DontAlign>;

Matrix6 symmetricMatrix()
{
  const Matrix6 m = Matrix6::Random();
  return m * m.transpose() + Matrix6::Identity();
}
}  // namespace

TEST(LinearAlgebra, ProductsAreThoseOfEigen)
{
  const Square25 a = Square25::Random(), b = Square25::Random();
  const By6 c = By6::Random();
  EXPECT_EQ(product(a, b), Square25(a * b));
  EXPECT_EQ(product(a, c), By6(a * c));
  EXPECT_EQ(productByTransposed(c, c), Square25(c * c.transpose()));
  EXPECT_EQ(transformedCovariance(a, b), Square25(a * b * a.transpose()));
}

TEST(LinearAlgebra, EigensystemsTakeTheMatrixApart)
{
  const Matrix6 m = symmetricMatrix();
  const Eigensystem6 six = symmetricEigensystem(m);
  EXPECT_TRUE((six.vectors * six.values.asDiagonal() * six.vectors.transpose()).isApprox(m, 1e-12));
  EXPECT_TRUE(symmetricEigenvalues(m).isApprox(six.values, 1e-12));
  const Mat3 block = m.topLeftCorner<3, 3>();
  const Eigensystem3 three = symmetricEigensystem(block);
  EXPECT_TRUE(
      (three.vectors * three.values.asDiagonal() * three.vectors.transpose()).isApprox(block));
  EXPECT_LE(three.values[0], three.values[1]);
  EXPECT_LE(three.values[1], three.values[2]);
}

TEST(LinearAlgebra, ThePositivePartLeavesOutWhatIsNegative)
{
  const Matrix6 m = symmetricMatrix();
  const Matrix6 positive = positivePart(m), negative = positivePart(-m);
  EXPECT_TRUE((positive - negative).isApprox(m, 1e-12));
  EXPECT_GE(symmetricEigenvalues(positive).minCoeff(), -1e-12);
  EXPECT_LT((positive * negative).norm(), 1e-9);
}

TEST(LinearAlgebra, DistancesCountInStandardDeviations)
{
  const Mat3 turn = expSO3({0.3, -0.2, 0.9});
  const Mat3 covariance = turn * Vec3(0.04, 0.25, 9.0).asDiagonal() * turn.transpose();
  EXPECT_NEAR(squaredMahalanobis(turn * Vec3(0.4, 0.5, 0.0), covariance), 5.0, 1e-12);
}

TEST(LinearAlgebra, SolvesSymmetricSystems)
{
  const Matrix6 m = symmetricMatrix();
  const Vector6 x = Vector6::Random();
  EXPECT_TRUE(solveSymmetric(m, m * x).isApprox(x, 1e-9));
}

TEST(LinearAlgebra, OnlyThePositionOfACovarianceTurns)
{
  const Matrix6 P = symmetricMatrix();
  const Mat3 R = expSO3({0.3, -0.2, 0.9});
  const Matrix6 turned = withPositionTurned(R, P);
  const Mat3 attitude = P.topLeftCorner<3, 3>(), shared = P.topRightCorner<3, 3>(),
             position = P.bottomRightCorner<3, 3>();
  EXPECT_TRUE((turned.topLeftCorner<3, 3>().isApprox(attitude, 1e-12)));
  EXPECT_TRUE((turned.topRightCorner<3, 3>().isApprox(shared * R.transpose(), 1e-12)));
  EXPECT_TRUE((turned.bottomRightCorner<3, 3>().isApprox(R * position * R.transpose(), 1e-12)));
  EXPECT_TRUE(turned.isApprox(turned.transpose(), 1e-12));
}

TEST(LinearAlgebra, RotationBetweenIsThatOfEigen)
{
  for (int i = 0; i < 100; ++i)
  {
    const Vec3 a = Vec3::Random(), b = Vec3::Random();
    EXPECT_EQ(rotationBetween(a, b), Eigen::Quaterniond::FromTwoVectors(a, b).toRotationMatrix());
  }
}

TEST(LinearAlgebra, RotationBetweenOppositesTurnsByHalfACircle)
{
  for (const Vec3& a : {Vec3(0, 0, 9.81), Vec3(1, -2, 3), Vec3(0, -1, 0)})
  {
    const Mat3 R = rotationBetween(a, -a);
    EXPECT_TRUE(isRotation(R));
    EXPECT_TRUE((R * a).isApprox(-a, 1e-12));
  }
}

}  // namespace fastlio::testing
