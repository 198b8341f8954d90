// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/so3.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>

namespace fastlio
{
namespace
{
// Below this squared angle the closed forms lose digits to cancellation, while six terms of the
// series are exact to rounding; they also spare the trigonometric functions in the usual case.
constexpr double kSeriesBelow = 0.0625;

/** Even functions of the angle t, given its square x. */
struct AngleFunctions
{
  double sinc;   //!< sin(t) / t
  double cosc;   //!< (1 - cos(t)) / t^2
  double sincc;  //!< (t - sin(t)) / t^3
};

AngleFunctions angleFunctionsBySeries(double x)
{
  const auto series = [x](double c0, double c1, double c2, double c3, double c4, double c5)
  { return c0 + x * (c1 + x * (c2 + x * (c3 + x * (c4 + x * c5)))); };
  return {
      series(1.0, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800),
      series(1.0 / 2, -1.0 / 24, 1.0 / 720, -1.0 / 40320, 1.0 / 3628800, -1.0 / 479001600),
      series(1.0 / 6, -1.0 / 120, 1.0 / 5040, -1.0 / 362880, 1.0 / 39916800, -1.0 / 6227020800)};
}

AngleFunctions angleFunctions(double x)
{
  if (x < kSeriesBelow) return angleFunctionsBySeries(x);
  const double t = std::sqrt(x);
  const double s = std::sin(t);
  return {s / t, (1.0 - std::cos(t)) / x, (t - s) / (x * t)};
}

/** I + a [u]x + b [u]x^2, the form that all of SO(3)'s functions of u share. */
Mat3 polynomialOfSkew(const Vec3& u, double a, double b)
{
  // [u]x^2 = u u^T - |u|^2 I
  Mat3 m = b * u * u.transpose();
  m.diagonal().array() += 1.0 - b * u.squaredNorm();
  return m + skew(a * u);
}
}  // namespace

bool isRotation(const Mat3& R)
{
  constexpr double kTolerance = 1e-3;
  return (R.transpose() * R).isIdentity(kTolerance) && R.determinant() > 0.0;
}

Mat3 skew(const Vec3& a)
{
  Mat3 m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

Mat3 expSO3(const Vec3& rotation_vector)
{
  const AngleFunctions f = angleFunctions(rotation_vector.squaredNorm());
  return polynomialOfSkew(rotation_vector, f.sinc, f.cosc);
}

Vec3 logSO3(const Mat3& R)
{
  // The unit quaternion (cos(t/2), n sin(t/2)) is well conditioned at every angle, the trace and
  // the skew part of R are not near pi.
  const Eigen::Quaterniond q(R);
  const Vec3 n = q.w() < 0.0 ? Vec3(-q.vec()) : Vec3(q.vec());
  const double c = std::abs(q.w());
  const double s = n.norm();
  // 2 atan2(s, c) / s, whose limit at s = 0 is 2 / c.
  const double scale = s < 1e-9 ? 2.0 / c : 2.0 * std::atan2(s, c) / s;
  return scale * n;
}

Mat3 leftJacobianSO3(const Vec3& u)
{
  const AngleFunctions f = angleFunctions(u.squaredNorm());
  return polynomialOfSkew(u, f.cosc, f.sincc);
}

Mat3 normalizeRotation(const Mat3& R)
{
  if (!R.allFinite()) return R;  // nothing is nearest; callers test for finiteness
  const Eigen::JacobiSVD<Mat3> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // Orthogonal Procrustes: U diag(1, 1, +-1) V^T with the sign that makes a proper rotation.
  Vec3 signs = Vec3::Ones();
  signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace fastlio
