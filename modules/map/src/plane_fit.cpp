// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/map/plane_fit.h>

#include <Eigen/Eigenvalues>

namespace fastlio
{
namespace
{
/** Eigenvalues, ascending and not negative, and eigenvectors of a covariance. */
struct PrincipalAxes
{
  Eigen::Vector3d eigenvalues;
  Eigen::Matrix3d axes;
};

/** The closed-form solution is exact enough where it matters: its error in an eigenvalue is a few
 * epsilon of the largest one, and an eigenvector errs by that over the gap to the next eigenvalue.
 * Rayleigh quotients of the vectors, whose error is quadratic in the vectors', give the values. */
PrincipalAxes principalAxes(const Eigen::Matrix3d& covariance)
{
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  PrincipalAxes result{Eigen::Vector3d::Zero(), solver.eigenvectors()};
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d axis = result.axes.col(i);
    result.eigenvalues[i] = std::max(0.0, axis.dot(covariance * axis));
  }
  return result;
}

/** Below this ratio to the squared distance from the origin, the extent is rounding. */
constexpr double kRounding = 1e-24;

bool hasExtent(const PointMoments& moments)
{
  const double extent = moments.covariance.trace();
  return std::isfinite(extent) && extent > kRounding * moments.centroid.squaredNorm();
}
}  // namespace

PointMoments momentsOf(const Eigen::Vector3d* points, std::size_t count)
{
  PointMoments moments;
  moments.count = count;
  if (count == 0) return moments;
  const double weight = 1.0 / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i)
    moments.centroid += points[i];
  moments.centroid *= weight;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Eigen::Vector3d d = points[i] - moments.centroid;
    moments.covariance.noalias() += weight * d * d.transpose();
  }
  return moments;
}

std::optional<PlaneFit> fitPlane(const PointMoments& moments, double min_width_ratio)
{
  if (moments.count < 3 || !hasExtent(moments)) return std::nullopt;
  const PrincipalAxes p = principalAxes(moments.covariance);
  if (!(p.eigenvalues[1] > min_width_ratio * p.eigenvalues[2])) return std::nullopt;
  return PlaneFit{moments.count, p.axes.col(0), moments.centroid, p.eigenvalues, p.axes};
}

std::optional<LineFit> fitLine(const PointMoments& moments, double min_elongation)
{
  if (moments.count < 2 || !hasExtent(moments)) return std::nullopt;
  const PrincipalAxes p = principalAxes(moments.covariance);
  if (!(p.eigenvalues[2] > min_elongation * p.eigenvalues[1])) return std::nullopt;
  return LineFit{moments.count, p.axes.col(2), moments.centroid, p.eigenvalues};
}

double planeOffsetVariance(const PlaneFit& fit, const Eigen::Vector3d& point, double point_variance)
{
  const Eigen::Vector3d offset = fit.axes.transpose() * (point - fit.centroid);
  const double leverage =
      1.0 + offset[1] * offset[1] / fit.eigenvalues[1] + offset[2] * offset[2] / fit.eigenvalues[2];
  return point_variance * leverage / static_cast<double>(fit.count);
}

}  // namespace fastlio
