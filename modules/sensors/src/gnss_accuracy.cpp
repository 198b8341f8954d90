// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/sensors/gnss_accuracy.h>

#include <mrpt/obs/gnss_messages_novatel.h>

#include <cmath>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservationGPS;
using mrpt::obs::gnss::Message_NMEA_GGA;
using mrpt::obs::gnss::Message_NV_OEM6_BESTPOS;

constexpr double kMostStd = 1e4;  // what is less certain is no position [m]

std::optional<Vec3> checked(const Vec3& std)
{
  for (int i = 0; i < 3; ++i)
    if (!(std[i] > 0.0 && std[i] <= kMostStd)) return std::nullopt;
  return std;
}

std::optional<Vec3> stdOfCovariance(const EnuCovariance& covariance)
{
  // The root of a negative number is none, and checked() takes it for that.
  return checked({std::sqrt(covariance[0]), std::sqrt(covariance[4]), std::sqrt(covariance[8])});
}

/** NovAtel's word for the quality of a GGA message. */
mrpt::obs::gnss::nv_oem6_position_type::nv_position_type_t positionTypeOf(int quality)
{
  using namespace mrpt::obs::gnss::nv_oem6_position_type;
  switch (quality)
  {
    case 1:
      return SINGLE;
    case 2:
      return WAAS;
    case 4:
      return NARROW_INT;
    case 5:
      return NARROW_FLOAT;
    default:
      return NONE;
  }
}

Message_NV_OEM6_BESTPOS messageWith(const Vec3& std, const Message_NMEA_GGA& gga)
{
  constexpr std::uint32_t kWgs84 = 61;  // in NovAtel's table of datums
  Message_NV_OEM6_BESTPOS message;
  auto& fields = message.fields;
  fields.solution_stat = mrpt::obs::gnss::nv_oem6_solution_status::SOL_COMPUTED;
  fields.position_type = positionTypeOf(gga.fields.fix_quality);
  fields.lat = gga.fields.latitude_degrees;
  fields.lon = gga.fields.longitude_degrees;
  fields.hgt = gga.fields.altitude_meters;
  fields.undulation = static_cast<float>(gga.fields.geoidal_distance);
  fields.datum_id = kWgs84;
  fields.lon_sigma = static_cast<float>(std.x());
  fields.lat_sigma = static_cast<float>(std.y());
  fields.hgt_sigma = static_cast<float>(std.z());
  return message;
}
}  // namespace

void setStatedCovariance(CObservationGPS& observation, const EnuCovariance& covariance)
{
  const std::optional<Vec3> std = stdOfCovariance(covariance);
  if (!std) return;
  if constexpr (HasEnuCovariance<CObservationGPS>::value)
    setEnuCovariance(observation, covariance);
  else
    observation.setMsg(messageWith(*std, observation.getMsgByClass<Message_NMEA_GGA>()));
}

std::optional<Vec3> statedStdOf(const CObservationGPS& observation)
{
  if (const auto covariance = enuCovarianceOf(observation)) return stdOfCovariance(*covariance);
  if (!observation.hasMsgClass<Message_NV_OEM6_BESTPOS>()) return std::nullopt;
  const auto& fields = observation.getMsgByClass<Message_NV_OEM6_BESTPOS>().fields;
  if (fields.solution_stat != mrpt::obs::gnss::nv_oem6_solution_status::SOL_COMPUTED)
    return std::nullopt;
  return checked({fields.lon_sigma, fields.lat_sigma, fields.hgt_sigma});
}

}  // namespace fastlio
