// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "settings_rows.h"

namespace fastlio
{
namespace
{
OptionTable<GnssSettings> gnssRows()
{
  return {
      {"gnss.rate", "Hz", number(&GnssSettings::rate, 0.0, 100.0),
       "fixes of a GNSS receiver per second (label gnss); 0: none"},
      {"gnss.noise", "m", number(&GnssSettings::noise, 0.0, 1000.0),
       "standard deviation of a fix east and north; twice that up"},
      {"gnss.correlation_time", "s", number(&GnssSettings::correlation_time, 0.0, 36000.0),
       "of half of the variance of a fix; 0: all noise is white"},
      {"gnss.outage_interval", "s", number(&GnssSettings::outage_interval, 0.0, 36000.0),
       "one outage of the receiver per so much time, at a random time of it; 0: none"},
      {"gnss.outage_length", "s", number(&GnssSettings::outage_length, 0.0, 36000.0),
       "for so long the receiver knows no position then"},
      {"gnss.multipath", "", number(&GnssSettings::multipath, 0.0, 0.9),
       "fraction of fixes that are 5 to 30 m off, for 2 to 8 s at a time"},
      {"gnss.lever_arm", "m", valueAs<VectorValue>(&GnssSettings::lever_arm),
       "antenna in the IMU frame: x,y,z"},
      {"gnss.latitude", "deg", number(&GnssSettings::latitude, -89.0, 89.0),
       "of the world's origin; x points east, y north"},
      {"gnss.longitude", "deg", number(&GnssSettings::longitude, -180.0, 180.0),
       "of the world's origin"},
      {"gnss.height", "m", number(&GnssSettings::height, -1000.0, 10000.0),
       "of the world's origin above the ellipsoid WGS84"},
      {"gnss.geoid", "m", number(&GnssSettings::geoid, -200.0, 200.0),
       "height of the geoid above the ellipsoid"},
  };
}

OptionTable<WheelSettings> wheelRows()
{
  return {
      {"wheels.rate", "Hz", number(&WheelSettings::rate, 0.0, 1000.0),
       "readings of wheel odometry per second (label wheels); 0: none"},
      {"wheels.scale_error", "", number(&WheelSettings::scale_error, -0.5, 0.5),
       "distances are measured too long by this fraction"},
      {"wheels.noise", "m/sqrt(m)", number(&WheelSettings::noise, 0.0, 1.0),
       "standard deviation of each wheel's distance after 1 m; the wheels are 1 m apart"},
  };
}
}  // namespace

OptionTable<SimulationSettings> aidRows()
{
  using S = SimulationSettings;
  return joinedRows<S>({rowsOf(gnssRows(), &S::gnss), rowsOf(wheelRows(), &S::wheels)});
}

}  // namespace fastlio
