// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file local_frame.h A plane frame that touches the earth: East, North, Up at a datum. */
#pragma once

#include <fastlio/math/so3.h>

namespace fastlio
{
/** A place on the WGS84 ellipsoid. Heights count from the ellipsoid, as GNSS receivers compute
 * them; heights above the sea differ by the undulation of the geoid (-107 m to +86 m). */
struct GeodeticPoint
{
  double latitude_deg = 0;   //!< -90 to 90, north is positive
  double longitude_deg = 0;  //!< -180 to 180, east is positive
  double height_m = 0;       //!< above the ellipsoid
};

/** Why \a point is no place on the earth or near it, or nullptr: latitude, longitude, a height from
 * -12 km to 100 km, all finite. */
[[nodiscard]] const char* problemOf(const GeodeticPoint& point);

/** Earth-centred, earth-fixed Cartesian coordinates [m]: z towards the north pole, x through
 * latitude and longitude 0 (Hofmann-Wellenhof et al., GNSS, 2008, eq. 8.6). */
[[nodiscard]] Vec3 geocentricOf(const GeodeticPoint& point);

/** The inverse, by Bowring's iteration of the parametric latitude (Survey Review 23, 1976) and his
 * formula of the height, which is well conditioned at the poles, too (Survey Review 28, 1985). Good
 * to a micrometre from -12 km to 100 km of height. The longitude at a pole is 0. */
[[nodiscard]] GeodeticPoint geodeticOf(const Vec3& geocentric);

/** The tangent frame "enu" at a datum: x East, y North, z Up along the normal of the ellipsoid, in
 * metres. The earth curves away from its plane: by 0.08 m in 1 km, 196 m in 50 km; z is
 * no height then. */
class LocalFrame
{
 public:
  /** \exception std::invalid_argument the datum is no place on the earth */
  explicit LocalFrame(const GeodeticPoint& datum);

  [[nodiscard]] Vec3 enuOf(const GeodeticPoint& point) const;
  [[nodiscard]] GeodeticPoint geodeticOf(const Vec3& enu) const;

  [[nodiscard]] const GeodeticPoint& datum() const { return datum_; }

 private:
  GeodeticPoint datum_;
  Vec3 origin_;            //!< of the datum, geocentric
  Mat3 R_geocentric_enu_;  //!< columns: East, North, Up
};

}  // namespace fastlio
