// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/generic_fields.h>
#include <fastlio/math/time.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <mrpt/maps/CPointsMapXYZI.h>

#include <stdexcept>
#include <string>

namespace
{
using fastlio::CloudColumns;
using mrpt::maps::CPointsMapXYZI;
using mrpt::maps::CPointsMapXYZIRT;

template <typename T, typename Get>
std::vector<T> column(std::size_t length, Get get)
{
  std::vector<T> values(length);
  for (std::size_t i = 0; i < length; ++i)
    values[i] = get(i);
  return values;
}

void readFields(const CPointsMapXYZIRT& cloud, CloudColumns& columns)
{
  const std::size_t n = cloud.size();
  if (cloud.hasIntensityField())
    columns.intensity = column<float>(n, [&](std::size_t i) { return cloud.getPointIntensity(i); });
  if (cloud.hasRingField())
    columns.ring = column<std::uint16_t>(n, [&](std::size_t i) { return cloud.getPointRing(i); });
  if (!cloud.hasTimeField()) return;
  columns.single_precision_time = true;
  columns.time =
      column<double>(n, [&](std::size_t i) { return static_cast<double>(cloud.getPointTime(i)); });
}

void readFields(const mrpt::maps::CGenericPointsMap& cloud, CloudColumns& columns)
{
  columns.intensity = fastlio::genericField<float>(cloud, {"intensity", "i", "I", "reflectivity"});
  columns.ring = fastlio::genericField<std::uint16_t>(
      cloud, {"ring", "r", "R", "line", "channel", "laser_id"});
  static const std::vector<std::string> times = []
  {
    std::vector<std::string> names(
        fastlio::kPointTimeNames.begin(), fastlio::kPointTimeNames.end());
    names.emplace_back("T");  // only here: elsewhere it may be a temperature
    return names;
  }();
  columns.time = fastlio::genericField<double>(cloud, times, &columns.single_precision_time);
}

void checkLength(const char* name, std::size_t length, std::size_t points, bool may_be_empty)
{
  if (length == points || (may_be_empty && length == 0)) return;
  throw std::invalid_argument(
      "makeXyzirt: column '" + std::string(name) + "' has " + std::to_string(length) +
      " values, column 'x' has " + std::to_string(points) + "; give all columns one length.");
}

void checkLengths(const CloudColumns& columns)
{
  const std::size_t n = columns.size();
  checkLength("y", columns.y.size(), n, false);
  checkLength("z", columns.z.size(), n, false);
  checkLength("intensity", columns.intensity.size(), n, true);
  checkLength("ring", columns.ring.size(), n, true);
  checkLength("time", columns.time.size(), n, true);
}
}  // namespace

namespace fastlio
{
CloudColumns readColumns(const mrpt::maps::CPointsMap& cloud)
{
  const auto& x = cloud.getPointsBufferRef_x();
  const auto& y = cloud.getPointsBufferRef_y();
  const auto& z = cloud.getPointsBufferRef_z();
  CloudColumns columns;
  columns.x.assign(x.begin(), x.end());
  columns.y.assign(y.begin(), y.end());
  columns.z.assign(z.begin(), z.end());
  if (const auto* timed = dynamic_cast<const CPointsMapXYZIRT*>(&cloud))
    readFields(*timed, columns);
  if (const auto* generic = dynamic_cast<const mrpt::maps::CGenericPointsMap*>(&cloud))
    readFields(*generic, columns);
  if (const auto* bright = dynamic_cast<const CPointsMapXYZI*>(&cloud))
    columns.intensity =
        column<float>(cloud.size(), [&](std::size_t i) { return bright->getPointIntensity(i); });
  return columns;
}

CPointsMapXYZIRT::Ptr makeXyzirt(const CloudColumns& columns)
{
  checkLengths(columns);
  const std::size_t n = columns.size();
  auto cloud = CPointsMapXYZIRT::Create();
  cloud->resize_XYZIRT(n, !columns.intensity.empty(), !columns.ring.empty(), !columns.time.empty());
  for (std::size_t i = 0; i < n; ++i)
    cloud->setPointFast(i, columns.x[i], columns.y[i], columns.z[i]);
  for (std::size_t i = 0; i < columns.intensity.size(); ++i)
    cloud->setPointIntensity(i, columns.intensity[i]);
  for (std::size_t i = 0; i < columns.ring.size(); ++i)
    cloud->setPointRing(i, columns.ring[i]);
  for (std::size_t i = 0; i < columns.time.size(); ++i)
    cloud->setPointTime(i, static_cast<float>(columns.time[i]));
  return cloud;
}

CPointsMapXYZIRT::Ptr makeXyzirt(const PointColumns& points)
{
  checkLength("time_offset_ns", points.time_offset_ns.size(), points.size(), false);
  CloudColumns columns{points.x, points.y, points.z, points.intensity, points.ring, {}};
  columns.time = column<double>(
      points.size(), [&](std::size_t i) { return toSeconds(points.time_offset_ns[i]); });
  return makeXyzirt(columns);
}

}  // namespace fastlio
