// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file linear_algebra.h Products and decompositions that several modules need. Eigen's templates
 * take seconds per source file to compile; here each of them is compiled once. */
#pragma once

#include <fastlio/math/so3.h>

namespace fastlio
{
// Unaligned, so that size and alignment of public types do not depend on compiler flags.
using Vector6 = Eigen::Matrix<double, 6, 1, Eigen::DontAlign>;
using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::DontAlign>;

/** Eigenvalues in increasing order, and the unit eigenvectors as columns in the same order. */
struct Eigensystem3
{
  Vec3 values;
  Mat3 vectors;
};

struct Eigensystem6
{
  Vector6 values;
  Matrix6 vectors;
};

/** Of a symmetric matrix, whose lower triangle is read. */
[[nodiscard]] Eigensystem3 symmetricEigensystem(const Mat3& m);
[[nodiscard]] Eigensystem6 symmetricEigensystem(const Matrix6& m);
[[nodiscard]] Vector6 symmetricEigenvalues(const Matrix6& m);

/** The nearest matrix that is a covariance: the symmetric part of m without what is negative. */
[[nodiscard]] Matrix6 positivePart(const Matrix6& m);

/** x with m x = b for a symmetric positive semi-definite m. */
[[nodiscard]] Vector6 solveSymmetric(const Matrix6& m, const Vector6& b);

/** offset^T covariance^-1 offset. */
[[nodiscard]] double squaredMahalanobis(const Vec3& offset, const Mat3& covariance);

/** The covariance of a pose (attitude in its own frame, position in the world) in a world that R
 * turns: the attitude does not see that, the position turns. */
[[nodiscard]] Matrix6 withPositionTurned(const Mat3& R, const Matrix6& covariance);

/** The smallest rotation that turns the direction of a into that of b. */
[[nodiscard]] Mat3 rotationBetween(const Vec3& a, const Vec3& b);

namespace detail
{
/** c = a b, and c = a b^T; all are stored by columns. a is rows x inner, c is rows x columns. */
void multiply(const double* a, const double* b, double* c, int rows, int inner, int columns);
void multiplyByTransposed(
    const double* a, const double* b, double* c, int rows, int inner, int columns);
}  // namespace detail

/** A B, for matrices with tens of rows or columns; the product of small ones is better inline. */
template <int Rows, int Inner, int Columns, int OptionsA, int OptionsB>
[[nodiscard]] Eigen::Matrix<double, Rows, Columns> product(
    const Eigen::Matrix<double, Rows, Inner, OptionsA>& a,
    const Eigen::Matrix<double, Inner, Columns, OptionsB>& b)
{
  static_assert(((OptionsA | OptionsB) & Eigen::RowMajorBit) == 0, "stored by columns");
  Eigen::Matrix<double, Rows, Columns> c;
  detail::multiply(a.data(), b.data(), c.data(), Rows, Inner, Columns);
  return c;
}

/** A B^T, likewise. */
template <int Rows, int Inner, int Columns, int OptionsA, int OptionsB>
[[nodiscard]] Eigen::Matrix<double, Rows, Columns> productByTransposed(
    const Eigen::Matrix<double, Rows, Inner, OptionsA>& a,
    const Eigen::Matrix<double, Columns, Inner, OptionsB>& b)
{
  static_assert(((OptionsA | OptionsB) & Eigen::RowMajorBit) == 0, "stored by columns");
  Eigen::Matrix<double, Rows, Columns> c;
  detail::multiplyByTransposed(a.data(), b.data(), c.data(), Rows, Inner, Columns);
  return c;
}

/** T P T^T: the covariance P of x as that of T x. */
template <int Size, int OptionsT, int OptionsP>
[[nodiscard]] Eigen::Matrix<double, Size, Size> transformedCovariance(
    const Eigen::Matrix<double, Size, Size, OptionsT>& T,
    const Eigen::Matrix<double, Size, Size, OptionsP>& P)
{
  return productByTransposed(product(T, P), T);
}

}  // namespace fastlio
