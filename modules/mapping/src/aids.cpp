// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mapping/aids.h>
#include <fastlio/run/recording_access.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/gnss_accuracy.h>

#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservationGPS;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::gnss::Message_NMEA_GGA;

// Vertical errors of satellite positions are about twice the horizontal ones.
constexpr double kVerticalOverHorizontal = 2.0;

/** Standard deviation of a fix by its quality: field 6 of GGA [m]. */
double stdOf(int quality)
{
  switch (quality)
  {
    case 2:
      return 0.7;  // with satellite-based corrections
    case 4:
      return 0.03;  // carrier phase, whole cycles
    case 5:
      return 0.3;  // carrier phase, no whole cycles
    default:
      return 2.0;
  }
}

GnssFix fixOf(const CObservationGPS& observation, const Pose& T_imu_vehicle)
{
  const auto& fields = observation.getMsgByClass<Message_NMEA_GGA>().fields;
  GnssFix fix;
  fix.stamp_ns = toNanoseconds(observation.timestamp);
  fix.place = {
      fields.latitude_degrees, fields.longitude_degrees,
      fields.altitude_meters + fields.geoidal_distance};
  const bool has_dilution = fields.thereis_HDOP && fields.HDOP > 0.0F;
  fix.horizontal_std = stdOf(fields.fix_quality) *
                       (has_dilution ? std::max(1.0, static_cast<double>(fields.HDOP)) : 1.0);
  fix.vertical_std = kVerticalOverHorizontal * fix.horizontal_std;
  if (const auto stated = statedStdOf(observation))
  {
    fix.usual = GnssStd{fix.horizontal_std, fix.vertical_std};
    fix.horizontal_std =
        std::max(kLeastGnssStd.horizontal, stated->head<2>().norm() / std::sqrt(2.0));
    fix.vertical_std = std::max(kLeastGnssStd.vertical, stated->z());
  }
  const auto& sensor = observation.sensorPose;
  fix.antenna = T_imu_vehicle * Vec3(sensor.x(), sensor.y(), sensor.z());
  return fix;
}

/** Takes observations as they come. */
class AidsReader
{
 public:
  explicit AidsReader(const Session& session)
      : name_(session.name()), T_imu_vehicle_(session.plan().T_vehicle_imu.inverse())
  {
  }

  void take(const mrpt::obs::CObservation& observation)
  {
    if (const auto* gps = dynamic_cast<const CObservationGPS*>(&observation)) take(*gps);
    if (const auto* wheels = dynamic_cast<const CObservationOdometry*>(&observation)) take(*wheels);
  }

  [[nodiscard]] Aids finish(std::vector<std::string>& problems)
  {
    const auto is_earlier = [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; };
    std::stable_sort(aids_.fixes.begin(), aids_.fixes.end(), is_earlier);
    std::stable_sort(aids_.wheels.begin(), aids_.wheels.end(), is_earlier);
    const auto report = [&](std::size_t count, const std::string& what)
    {
      if (count > 0) problems.push_back(name_ + ": " + std::to_string(count) + what);
    };
    report(without_fix_, " positions of GNSS have no fix");
    report(nowhere_, " positions of GNSS are no place on the earth");
    report(not_finite_, " readings of wheel odometry are no numbers");
    report(
        of_other_wheels_, " readings of wheel odometry are not '" + label_.value_or("") +
                              "', whose readings come first: they are not used");
    return std::move(aids_);
  }

 private:
  void take(const CObservationGPS& gps)
  {
    if (!gps.hasMsgClass<Message_NMEA_GGA>()) return;
    const int quality = gps.getMsgByClass<Message_NMEA_GGA>().fields.fix_quality;
    if (quality == 0 || quality > 5)
    {
      ++without_fix_;
      return;
    }
    const GnssFix fix = fixOf(gps, T_imu_vehicle_);
    if (problemOf(fix.place) == nullptr)
      aids_.fixes.push_back(fix);
    else
      ++nowhere_;
  }

  void take(const CObservationOdometry& wheels)
  {
    if (!label_) label_ = wheels.sensorLabel;
    const auto& pose = wheels.odometry;
    const bool is_finite =
        std::isfinite(pose.x()) && std::isfinite(pose.y()) && std::isfinite(pose.phi());
    if (wheels.sensorLabel != *label_)
      ++of_other_wheels_;
    else if (!is_finite)
      ++not_finite_;
    else
      aids_.wheels.push_back({toNanoseconds(wheels.timestamp), pose.x(), pose.y(), pose.phi()});
  }

  std::string name_;
  Pose T_imu_vehicle_;
  Aids aids_;
  std::optional<std::string> label_;
  std::size_t without_fix_ = 0, nowhere_ = 0, not_finite_ = 0, of_other_wheels_ = 0;
};
}  // namespace

Aids readAids(const Session& session, std::vector<std::string>& problems)
{
  AidsReader reader(session);
  forEachObservation(
      {session.files(), session.selection(), session.plan().bridge},
      [&](const mrpt::obs::CObservation::Ptr& observation)
      {
        reader.take(*observation);
        return true;
      });
  return reader.finish(problems);
}

}  // namespace fastlio
