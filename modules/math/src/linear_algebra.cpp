// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/linear_algebra.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>

namespace fastlio
{
namespace
{
using Aligned6 = Eigen::Matrix<double, 6, 6>;
using Solver6 = Eigen::SelfAdjointEigenSolver<Aligned6>;
}  // namespace

Eigensystem3 symmetricEigensystem(const Mat3& m)
{
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(m);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigensystem6 symmetricEigensystem(const Matrix6& m)
{
  const Solver6 solver{Aligned6(m)};
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Vector6 symmetricEigenvalues(const Matrix6& m)
{
  return Solver6(Aligned6(m), Eigen::EigenvaluesOnly).eigenvalues();
}

Matrix6 positivePart(const Matrix6& m)
{
  const Matrix6 symmetric = 0.5 * (m + m.transpose());
  const Eigensystem6 system = symmetricEigensystem(symmetric);
  const Aligned6 V = system.vectors;
  return V * system.values.cwiseMax(0.0).asDiagonal() * V.transpose();
}

Vector6 solveSymmetric(const Matrix6& m, const Vector6& b)
{
  return m.ldlt().solve(b);
}

double squaredMahalanobis(const Vec3& offset, const Mat3& covariance)
{
  const Eigen::LLT<Eigen::Matrix3d> S(covariance);
  const Vec3 weighted = S.solve(Eigen::Vector3d(offset)).eval();
  return offset.dot(weighted);
}

Matrix6 withPositionTurned(const Mat3& R, const Matrix6& covariance)
{
  Matrix6 J = Matrix6::Identity();
  J.bottomRightCorner<3, 3>() = R;
  return J * covariance * J.transpose();
}

Mat3 rotationBetween(const Vec3& a, const Vec3& b)
{
  // As Quaternion::FromTwoVectors(), whose singular value decomposition takes 4 s to compile.
  constexpr double kOpposite = -1.0 + 1e-12;
  const Vec3 from = a.normalized(), to = b.normalized();
  const double c = to.dot(from);
  Eigen::Quaterniond q;
  if (c < kOpposite)
  {
    q.w() = 0.0;
    q.vec() = from.unitOrthogonal();
  }
  else
  {
    const double s = std::sqrt((1.0 + c) * 2.0);
    q.vec() = from.cross(to) * (1.0 / s);
    q.w() = s * 0.5;
  }
  return q.toRotationMatrix();
}

namespace detail
{
using Dense = Eigen::Map<const Eigen::MatrixXd>;

void multiply(const double* a, const double* b, double* c, int rows, int inner, int columns)
{
  Eigen::Map<Eigen::MatrixXd>(c, rows, columns).noalias() =
      Dense(a, rows, inner) * Dense(b, inner, columns);
}

void multiplyByTransposed(
    const double* a, const double* b, double* c, int rows, int inner, int columns)
{
  Eigen::Map<Eigen::MatrixXd>(c, rows, columns).noalias() =
      Dense(a, rows, inner) * Dense(b, columns, inner).transpose();
}
}  // namespace detail

}  // namespace fastlio
