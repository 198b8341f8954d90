// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/earth/reference_system.h>
#include <fastlio/options/number_text.h>

#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr double kSouthEnd = -80, kNorthEnd = 84;  // of the grid [deg]
constexpr int kCodeNorth = 32600, kCodeSouth = 32700;
constexpr int kZones = 60;
constexpr double kZoneWidth = 6;

/** Zones of Svalbard are twice as wide, or missing. */
int svalbardZone(double longitude)
{
  if (longitude < 9) return 31;
  if (longitude < 21) return 33;
  return longitude < 33 ? 35 : 37;
}

int zoneAt(double latitude, double longitude)
{
  if (latitude >= 72 && longitude >= 0 && longitude < 42) return svalbardZone(longitude);
  // Southern Norway is in one zone.
  if (latitude >= 56 && latitude < 64 && longitude >= 3 && longitude < 12) return 32;
  return static_cast<int>(std::floor((longitude + 180.0) / kZoneWidth)) % kZones + 1;
}
}  // namespace

std::string utmCodeAt(const GeodeticPoint& point)
{
  const char* problem = problemOf(point);
  const bool beyond = point.latitude_deg < kSouthEnd || point.latitude_deg > kNorthEnd;
  if (problem != nullptr || beyond)
    throw std::invalid_argument(
        "no UTM zone at latitude " + shortestText(point.latitude_deg) + ", longitude " +
        shortestText(point.longitude_deg) + ": " +
        (problem != nullptr ? problem
                            : "the grid ends at 80 S and 84 N; give a polar system like EPSG:5041 "
                              "or EPSG:5042"));
  const int first = point.latitude_deg < 0 ? kCodeSouth : kCodeNorth;
  return "EPSG:" + std::to_string(first + zoneAt(point.latitude_deg, point.longitude_deg));
}

}  // namespace fastlio
