// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plane_fit.h Least-squares planes and lines through a few points, for eq. 12-14.
 *
 * Both minimise the sum of squared orthogonal distances. The solution follows from the points'
 * covariance: the plane's normal is the eigenvector of its smallest eigenvalue, the line's
 * direction that of the largest one, and both pass through the centroid. */
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <optional>

namespace fastlio
{
/** First and second moments of a set of points. */
struct PointMoments
{
  std::size_t count = 0;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();    //!< [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  //!< sum (p - c)(p - c)^T / count [m^2]
};

/** A plane {p : normal . (p - centroid) = 0} and how well it is determined. */
struct PlaneFit
{
  std::size_t count = 0;                                  //!< points that it was fitted to
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();      //!< unit length; the sign is arbitrary
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();     //!< [m]
  Eigen::Vector3d eigenvalues = Eigen::Vector3d::Zero();  //!< of the covariance, ascending [m^2]
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();     //!< columns: eigenvectors, same order

  /** Signed distance of a point to the plane [m]. */
  [[nodiscard]] double distance(const Eigen::Vector3d& p) const { return normal.dot(p - centroid); }
};

/** A line {centroid + s direction} and how well it is determined. */
struct LineFit
{
  std::size_t count = 0;                                  //!< points that it was fitted to
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();   //!< unit length; the sign is arbitrary
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();     //!< [m]
  Eigen::Vector3d eigenvalues = Eigen::Vector3d::Zero();  //!< of the covariance, ascending [m^2]

  /** Distance of a point to the line [m]. */
  [[nodiscard]] double distance(const Eigen::Vector3d& p) const
  {
    return direction.cross(p - centroid).norm();
  }
};

/** Moments of \a count points in two passes, so that points far from the origin lose nothing. */
[[nodiscard]] PointMoments momentsOf(const Eigen::Vector3d* points, std::size_t count);

/** Plane through at least three points.
 * \param min_width_ratio least ratio of the middle to the largest eigenvalue: below it the points
 * are as good as on a line (or coincide) and any plane through that line fits alike
 * \return nothing for fewer than three points, points without extent, on a line, or not finite */
[[nodiscard]] std::optional<PlaneFit> fitPlane(
    const PointMoments& moments, double min_width_ratio = 1e-6);

/** Line through at least two points.
 * \param min_elongation least ratio of the largest to the middle eigenvalue: below it the points
 * have no preferred direction
 * \return nothing for fewer than two points, points without extent or direction, or not finite */
[[nodiscard]] std::optional<LineFit> fitLine(
    const PointMoments& moments, double min_elongation = 3.0);

/** Variance of the plane's offset along its normal at \a point [m^2], given that each fitted point
 * scatters about the true plane with variance \a point_variance [m^2].
 *
 * It is that of a linear regression's prediction: s^2 / n at the centroid, plus the leverage
 * s^2 t_i^2 / (n lambda_i) along each in-plane axis i, t_i being the point's coordinate on it.
 * Extrapolating far from the points, or across a narrow strip of them, is thereby worth little. */
[[nodiscard]] double planeOffsetVariance(
    const PlaneFit& fit, const Eigen::Vector3d& point, double point_variance);

}  // namespace fastlio
