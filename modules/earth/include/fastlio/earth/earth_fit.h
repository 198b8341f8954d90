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

/** What messages call the points, and what to do about them. */
struct EarthFitWords
{
  std::string points = "control points";
  std::string if_contradicting =
      "check the coordinates, or give larger standard deviations if the map has drifted";
  std::string if_close = "give points that lie further apart";
};

struct EarthFitOptions
{
  /** Standard deviation that the map's drift adds to each point [m]. */
  double map_std_m = 0;
  /** A heading that is less certain is refused [deg]. */
  double most_yaw_std_deg = 2.0;
  EarthFitWords words;
};

/** The residual at one point. */
struct EarthResidual
{
  std::string name;
  Vec3 residual_m = Vec3::Zero();  //!< where the fit puts the point, minus its enu: East, North, Up
  bool is_used = true;             //!< false: it contradicts the others and took no part
};

/** Where the map is. */
struct EarthFit
{
  Pose T_enu_map;  //!< turns about the vertical only: gravity has aligned the map's z axis
  std::vector<EarthResidual> residuals;  //!< in the order of the points
  double rms_m = 0;                      //!< of the lengths of the residuals of used points

  [[nodiscard]] std::size_t used() const;
};

/** Yaw and translation with the least sum of squared residuals, each divided by its variance: in
 * closed form (the planar case of Umeyama, PAMI 13(4), 1991, without scale). Points that contradict
 * the others are left out: the truncated sum of squares is minimised by graduated non-convexity
 * (Yang et al., RA-L 5(2), 2020) and, for up to 64 points, from each pair of them; the best is
 * taken.
 * \exception std::invalid_argument fewer than two points, or numbers that are not finite or no
 * standard deviations
 * \exception std::runtime_error the points do not show the heading: they are too close together; or
 * most of them contradict each other */
[[nodiscard]] EarthFit fitToEarth(
    const std::vector<Correspondence>& points, const EarthFitOptions& options = {});

}  // namespace fastlio
