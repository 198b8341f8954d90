// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/earth/local_frame.h>
#include <fastlio/math/angles.h>
#include <fastlio/options/number_text.h>

#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>
#include <string>

namespace fastlio
{
namespace
{
// WGS84: the semi-major axis and the flattening define the ellipsoid.
constexpr double kSemiMajor = 6378137.0;  // [m]
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kSemiMinor = kSemiMajor * (1.0 - kFlattening);
constexpr double kSquaredEccentricity = kFlattening * (2.0 - kFlattening);
constexpr double kSecondSquaredEccentricity = kSquaredEccentricity / (1.0 - kSquaredEccentricity);

constexpr double kLowest = -12e3, kHighest = 100e3;  // [m]
constexpr int kMostIterations = 5;                   // two are enough near the ground

/** The radius of curvature in the prime vertical [m]. */
double primeVerticalRadius(double sin_latitude)
{
  return kSemiMajor / std::sqrt(1.0 - kSquaredEccentricity * sin_latitude * sin_latitude);
}

/** The direction (cosine, sine) of the geodetic latitude of a point at the distance \a p from the
 * axis and at \a z. */
Eigen::Vector2d latitudeDirection(double p, double z)
{
  // Parametric latitude: exact for points on the ellipsoid.
  Eigen::Vector2d beta = Eigen::Vector2d(p * kSemiMinor, z * kSemiMajor).normalized();
  Eigen::Vector2d phi = beta;
  for (int i = 0; i < kMostIterations; ++i)
  {
    const double cos_beta = beta.x(), sin_beta = beta.y();
    const Eigen::Vector2d next =
        Eigen::Vector2d(
            p - kSquaredEccentricity * kSemiMajor * cos_beta * cos_beta * cos_beta,
            z + kSecondSquaredEccentricity * kSemiMinor * sin_beta * sin_beta * sin_beta)
            .normalized();
    const bool settled = (next - phi).squaredNorm() < 1e-32;
    phi = next;
    if (settled) break;
    beta = Eigen::Vector2d(phi.x(), (1.0 - kFlattening) * phi.y()).normalized();
  }
  return phi;
}
}  // namespace

const char* problemOf(const GeodeticPoint& point)
{
  // Written so that not-a-number is a problem.
  if (!(std::abs(point.latitude_deg) <= 90.0))
    return "the latitude is not within -90 to 90 degrees";
  if (!(std::abs(point.longitude_deg) <= 180.0))
    return "the longitude is not within -180 to 180 degrees";
  if (!(point.height_m >= kLowest && point.height_m <= kHighest))
    return "the height is not within -12 km to 100 km";
  return nullptr;
}

Vec3 geocentricOf(const GeodeticPoint& point)
{
  const double latitude = point.latitude_deg * kRadPerDeg;
  const double longitude = point.longitude_deg * kRadPerDeg;
  const double sin_latitude = std::sin(latitude);
  const double n = primeVerticalRadius(sin_latitude);
  const double from_axis = (n + point.height_m) * std::cos(latitude);
  return {
      from_axis * std::cos(longitude), from_axis * std::sin(longitude),
      (n * (1.0 - kSquaredEccentricity) + point.height_m) * sin_latitude};
}

GeodeticPoint geodeticOf(const Vec3& geocentric)
{
  const double p = std::hypot(geocentric.x(), geocentric.y());
  const Eigen::Vector2d phi = latitudeDirection(p, geocentric.z());
  const double on_ellipsoid =
      kSemiMajor * std::sqrt(1.0 - kSquaredEccentricity * phi.y() * phi.y());
  return {
      std::atan2(phi.y(), phi.x()) * kDegPerRad,
      std::atan2(geocentric.y(), geocentric.x()) * kDegPerRad,
      p * phi.x() + geocentric.z() * phi.y() - on_ellipsoid};
}

LocalFrame::LocalFrame(const GeodeticPoint& datum) : datum_(datum)
{
  if (const char* problem = problemOf(datum))
    throw std::invalid_argument(
        "the datum (latitude " + shortestText(datum.latitude_deg) + ", longitude " +
        shortestText(datum.longitude_deg) + ", height " + shortestText(datum.height_m) +
        ") is no place on the earth: " + problem);
  origin_ = geocentricOf(datum);
  const double latitude = datum.latitude_deg * kRadPerDeg;
  const double longitude = datum.longitude_deg * kRadPerDeg;
  const Vec3 up(
      std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
      std::sin(latitude));
  const Vec3 east(-std::sin(longitude), std::cos(longitude), 0.0);
  R_geocentric_enu_ << east, up.cross(east), up;
}

Vec3 LocalFrame::enuOf(const GeodeticPoint& point) const
{
  return R_geocentric_enu_.transpose() * (geocentricOf(point) - origin_);
}

GeodeticPoint LocalFrame::geodeticOf(const Vec3& enu) const
{
  return fastlio::geodeticOf(R_geocentric_enu_ * enu + origin_);
}

}  // namespace fastlio
