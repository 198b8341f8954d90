// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/CGenericPointsMap.h>
#include <fastlio/recordings/cloud_builder.h>
#include <fastlio/sensors/conversions.h>

#include <algorithm>

namespace fastlio
{
namespace
{
using mrpt::maps::CGenericPointsMap;

void setCoordinates(CGenericPointsMap& map, const CloudColumns& columns)
{
  for (std::size_t i = 0; i < columns.size(); ++i)
    map.setPointFast(i, columns.x[i], columns.y[i], columns.z[i]);
}

#if FASTLIO_MRPT_HAS_GENERIC_MAP
template <typename From, typename To>
void fill(const std::vector<From>& from, To* to)
{
  if (to == nullptr || to->size() != from.size()) return;
  std::transform(
      from.begin(), from.end(), to->begin(),
      [](From value) { return static_cast<typename To::value_type>(value); });
}

void setFields(CGenericPointsMap& map, const CloudColumns& columns)
{
  if (!columns.intensity.empty()) map.registerField_float("intensity");
  if (!columns.ring.empty()) map.registerField_uint16("ring");
  if (!columns.time.empty() && columns.single_precision_time) map.registerField_float("t");
  if (!columns.time.empty() && !columns.single_precision_time) map.registerField_double("t");
  map.resize(columns.size());
  fill(columns.intensity, map.getPointsBufferRef_float_field("intensity"));
  fill(columns.ring, map.getPointsBufferRef_uint16_field("ring"));
  fill(columns.time, map.getPointsBufferRef_float_field("t"));
  fill(columns.time, map.getPointsBufferRef_double_field("t"));
}
#else
void setFields(CGenericPointsMap& map, const CloudColumns& columns)
{
  map.resize(columns.size());
  if (!columns.intensity.empty()) map.float_fields["intensity"] = columns.intensity;
  if (!columns.ring.empty()) map.uint16_fields["ring"] = columns.ring;
  if (columns.time.empty()) return;
  if (!columns.single_precision_time)
  {
    map.double_fields["t"] = columns.time;
    return;
  }
  auto& times = map.float_fields["t"];
  times.reserve(columns.time.size());
  for (const double time : columns.time)
    times.push_back(static_cast<float>(time));
}
#endif
}  // namespace

mrpt::obs::CObservationPointCloud::Ptr makeCloud(
    const CloudColumns& columns, const std::string& label, std::int64_t stamp_ns)
{
  auto map = CGenericPointsMap::Create();
  setFields(*map, columns);
  setCoordinates(*map, columns);
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  observation->sensorLabel = label;
  observation->timestamp = toMrptTime(stamp_ns);
  observation->pointcloud = map;
  return observation;
}

}  // namespace fastlio
