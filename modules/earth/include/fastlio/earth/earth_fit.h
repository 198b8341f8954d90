// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file earth_fit.h The place and the heading of a map on the earth, from points known in both. */
#pragma once

#include <fastlio/math/pose.h>

#include <string>
#include <vector>

namespace fastlio
{
/** One place in the map and on the earth. */
struct Correspondence
{
  Vec3 map = Vec3::Zero();  //!< in the frame of the map, z along gravity [m]
  Vec3 enu = Vec3::Zero();  //!< in the tangent frame, LocalFrame [m]
  double std_m = 0.05;      //!< of each coordinate of the difference, one standard deviation
  std::string name;         //!< for messages and reports
};

struct EarthFitOptions
{
  /** Whether points that contradict the others are found and left out. Without it all of them take
   * part. */
  bool robust = true;
  /** Standard deviation that the map's drift adds to each point [m]. */
  double map_std_m = 0;
  /** A point contradicts when its residual is longer than this many standard deviations; 4.03 is
   * passed by one good point in a thousand (chi square, 3 degrees of freedom). */
  double gate = 4.03;
  /** A heading that is less certain is refused [deg]. */
  double most_yaw_std_deg = 2.0;
};

/** The residual at one point. */
struct EarthResidual
{
  std::string name;
  Vec3 residual_m = Vec3::Zero();  //!< where the fit puts the point, minus its enu: East, North, Up
  double normalized = 0;           //!< its length in standard deviations
  bool is_used = true;             //!< false: it contradicts the others and took no part
};

/** Where the map is. */
struct EarthFit
{
  // Unaligned, so that size and alignment do not depend on compiler flags.
  using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;

  Pose T_enu_map;      //!< turns about the vertical only: gravity has aligned the map's z axis
  double yaw_rad = 0;  //!< of the map: from East to its x axis, counter-clockwise
  /** Of yaw [rad] and of the map's origin in East, North, Up [m]. */
  Matrix4 covariance = Matrix4::Zero();
  std::vector<EarthResidual> residuals;  //!< in the order of the points
  double rms_m = 0;                      //!< of the lengths of the residuals of used points
  /** Squared normalized residuals per spare equation (3 of each used point, less 4): about 1 when
   * the standard deviations are right. The covariance is that of the given ones, not scaled. */
  double variance_factor = 0;
  double horizontal_spread_m = 0;  //!< rms distance of used points from their centre, in the plane

  [[nodiscard]] std::size_t used() const;
};

/** Yaw and translation with the least sum of squared residuals, each divided by its variance: in
 * closed form (the planar case of Umeyama, PAMI 13(4), 1991, without scale). Robust: the truncated
 * sum of squares is minimised by graduated non-convexity (Yang et al., RA-L 5(2), 2020) and, for up
 * to 64 points, from each pair of them; the best is taken.
 * \exception std::invalid_argument fewer than two points, or numbers that are not finite or no
 * standard deviations
 * \exception std::runtime_error the points do not show the heading: they are too close together; or
 * most of them contradict each other */
[[nodiscard]] EarthFit fitToEarth(
    const std::vector<Correspondence>& points, const EarthFitOptions& options = {});

}  // namespace fastlio
