// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/gnss_covariance.h>
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/simulation/observations.h>

#include <mrpt/topography/conversions.h>

#include <cmath>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservationGPS;
using mrpt::obs::gnss::Message_NMEA_GGA;
using mrpt::topography::TGeodeticCoords;

/** Latitude [deg], longitude [deg] and height [m] of a place in the world. */
Vec3 geodeticOf(const Vec3& world, const GnssSettings& settings)
{
  // MRPT's inverse is off by a centimetre; its forward conversion is exact.
  constexpr double kEarth = 6.371e6, kClose = 1e-6;  // [m]
  constexpr int kMostSteps = 30;
  const TGeodeticCoords datum(settings.latitude, settings.longitude, settings.height);
  const double per_metre = kDegPerRad / kEarth;
  Vec3 place(settings.latitude, settings.longitude, settings.height);
  for (int step = 0; step < kMostSteps; ++step)
  {
    mrpt::math::TPoint3D enu;
    mrpt::topography::geodeticToENU_WGS84({place.x(), place.y(), place.z()}, enu, datum);
    const Vec3 missing = world - Vec3(enu.x, enu.y, enu.z);
    if (missing.norm() < kClose) break;
    place.x() += per_metre * missing.y();
    place.y() += per_metre * missing.x() / std::cos(place.x() * kRadPerDeg);
    place.z() += missing.z();
  }
  place.y() = std::remainder(place.y(), 360.0);
  return place;
}

mrpt::obs::gnss::UTC_time timeOfDay(std::int64_t stamp_ns)
{
  constexpr std::int64_t kMinute = 60'000'000'000, kHour = 60 * kMinute;
  mrpt::obs::gnss::UTC_time time;
  time.hour = static_cast<std::uint8_t>(stamp_ns / kHour % 24);
  time.minute = static_cast<std::uint8_t>(stamp_ns / kMinute % 60);
  time.sec = toSeconds(stamp_ns % kMinute);
  return time;
}

std::uint8_t qualityFor(double noise)
{
  constexpr std::uint8_t kStandard = 1, kDifferential = 2, kRealTimeKinematic = 4;
  return noise < 0.1 ? kRealTimeKinematic : noise < 0.6 ? kDifferential : kStandard;
}

Message_NMEA_GGA messageOf(const SimulatedFix& fix, const GnssSettings& settings)
{
  Message_NMEA_GGA message;
  auto& f = message.fields;
  f.UTCTime = timeOfDay(fix.stamp_ns);
  f.thereis_HDOP = true;
  f.HDOP = 99.9F;
  if (!fix.known) return message;
  const Vec3 at = geodeticOf(fix.antenna, settings);
  f.latitude_degrees = at.x();
  f.longitude_degrees = at.y();
  f.altitude_meters = at.z() - settings.geoid;
  f.geoidal_distance = settings.geoid;
  f.orthometric_altitude = at.z();  // MRPT's name of the sum of both
  f.corrected_orthometric_altitude = at.z();
  f.fix_quality = qualityFor(settings.noise);
  f.satellitesUsed = 12;
  f.HDOP = 0.8F;
  return message;
}

}  // namespace

CObservationGPS::Ptr toGnssObservation(const SimulatedFix& fix, const GnssSettings& settings)
{
  auto observation = CObservationGPS::Create();
  observation->sensorLabel = kGnssLabel;
  observation->timestamp = toMrptTime(fix.stamp_ns);
  observation->originalReceivedTimestamp = observation->timestamp;
  observation->has_satellite_timestamp = true;
  observation->sensorPose = toMrptPose({Mat3::Identity(), settings.lever_arm});
  observation->setMsg(messageOf(fix, settings));
  const double h2 = settings.noise * settings.noise;
  if (fix.known) setEnuCovariance(*observation, {h2, 0, 0, 0, h2, 0, 0, 0, 4.0 * h2});
  return observation;
}

}  // namespace fastlio
