// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Messages of LiDARs: clouds with any fields, Livox's own, Velodyne's packets.

#include "cloud_builder.h"
#include "ros_messages.h"
#include "velodyne_scans.h"
#include <fastlio/math/time.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <type_traits>

namespace fastlio
{
namespace
{
/** sensor_msgs/PointField. */
struct PointField
{
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t type = 0;
};

/** The values of PointField.datatype. */
enum : std::uint8_t
{
  kInt8 = 1,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64
};

constexpr std::array<std::size_t, 9> kFieldSizes{0, 1, 1, 2, 2, 4, 4, 4, 8};

// First those that can mean nothing else.
constexpr std::array<std::string_view, 15> kTimeNames{
    "t",          "time",       "timestamp",   "time_stamp",    "timeStamp",
    "timeOffset", "timeoffset", "time_offset", "offset_time",   "offsetTime",
    "point_time", "time_ns",    "t_offset",    "relative_time", "stamp"};
constexpr std::array<std::string_view, 6> kRingNames{"ring", "line",     "channel",
                                                     "row",  "laser_id", "scan_line"};
constexpr std::array<std::string_view, 4> kIntensityNames{
    "intensity", "reflectivity", "i", "signal"};

/** The points of a message: count and stride. */
struct PointGrid
{
  const std::uint8_t* data = nullptr;
  std::size_t width = 0, height = 0, step = 0, row_step = 0;
  bool swap = false;
};

template <typename T>
double valueAt(const std::uint8_t* bytes, bool swap)
{
  std::array<std::uint8_t, sizeof(T)> raw{};
  for (std::size_t i = 0; i < sizeof(T); ++i)
    raw[i] = bytes[swap ? sizeof(T) - 1 - i : i];
  T value{};
  std::memcpy(&value, raw.data(), sizeof(T));
  return static_cast<double>(value);
}

using ValueReader = double (*)(const std::uint8_t*, bool);

ValueReader valueReaderOf(std::uint8_t type)
{
  constexpr std::array<ValueReader, 9> kReaders{
      nullptr,
      valueAt<std::int8_t>,
      valueAt<std::uint8_t>,
      valueAt<std::int16_t>,
      valueAt<std::uint16_t>,
      valueAt<std::int32_t>,
      valueAt<std::uint32_t>,
      valueAt<float>,
      valueAt<double>};
  return kReaders.at(type);
}

/** Numbers of lines may be stored in any type; what is no such number is line 0. */
template <typename Wanted>
Wanted as(double value)
{
  if constexpr (!std::is_floating_point_v<Wanted>)
    if (!(value >= 0.0 && value <= std::numeric_limits<Wanted>::max())) return Wanted{0};
  return static_cast<Wanted>(value);
}

template <typename Wanted>
std::vector<Wanted> columnOf(const PointGrid& grid, const PointField& field)
{
  const ValueReader read = valueReaderOf(field.type);
  std::vector<Wanted> values;
  values.reserve(grid.width * grid.height);
  for (std::size_t row = 0; row < grid.height; ++row)
  {
    const std::uint8_t* point = grid.data + row * grid.row_step + field.offset;
    for (std::size_t i = 0; i < grid.width; ++i, point += grid.step)
      values.push_back(as<Wanted>(read(point, grid.swap)));
  }
  return values;
}

std::vector<PointField> readFields(WireReader& in)
{
  constexpr std::size_t kLeast = 13;  // bytes of a field without a name
  std::vector<PointField> fields(in.count(kLeast));
  for (PointField& field : fields)
  {
    field.name = in.text();
    field.offset = in.number<std::uint32_t>();
    field.type = in.number<std::uint8_t>();
    (void)in.number<std::uint32_t>();  // values per point: the first one is read
  }
  return fields;
}

/** Null: there is none of these names that lies within a point. */
template <std::size_t Count>
const PointField* fieldOf(
    const std::vector<PointField>& fields, const std::array<std::string_view, Count>& names,
    std::size_t step)
{
  for (const std::string_view name : names)
    for (const PointField& field : fields)
      if (field.name == name && field.type >= kInt8 && field.type <= kFloat64 &&
          field.offset + kFieldSizes.at(field.type) <= step)
        return &field;
  return nullptr;
}

template <std::size_t Count>
const PointField& requireField(
    const std::vector<PointField>& fields, const std::array<std::string_view, Count>& names,
    std::size_t step)
{
  if (const PointField* field = fieldOf(fields, names, step)) return *field;
  throw std::runtime_error("the cloud has no field '" + std::string(names[0]) + "'");
}

void requireInside(const PointGrid& grid, std::size_t bytes)
{
  constexpr std::size_t kMostPoints = std::size_t{1} << 28U;  // a message has fewer bytes
  const bool sane = grid.step > 0 && grid.width <= kMostPoints && grid.height <= kMostPoints &&
                    grid.width * grid.step <= grid.row_step;
  const bool inside = sane && grid.row_step <= bytes &&
                      grid.height <= bytes / std::max<std::size_t>(grid.row_step, 1);
  if (!inside && grid.width * grid.height != 0)
    throw std::runtime_error(
        "the cloud claims " + std::to_string(grid.height) + " rows of " +
        std::to_string(grid.width) + " points of " + std::to_string(grid.step) +
        " bytes, and has " + std::to_string(bytes) + " bytes");
}
}  // namespace

RosObservation readPointCloud2(WireReader& in, const std::string& label)
{
  const RosHeader header = readRosHeader(in);
  PointGrid grid;
  grid.height = in.number<std::uint32_t>();
  grid.width = in.number<std::uint32_t>();
  const std::vector<PointField> fields = readFields(in);
  grid.swap = in.number<std::uint8_t>() != 0;
  grid.step = in.number<std::uint32_t>();
  grid.row_step = in.number<std::uint32_t>();
  const std::size_t bytes = in.count(1);
  grid.data = in.take(bytes);
  // Some drivers leave the length of a row out.
  if (grid.height == 1 || grid.row_step == 0) grid.row_step = grid.width * grid.step;
  requireInside(grid, bytes);
  CloudColumns columns;
  columns.x = columnOf<float>(grid, requireField<1>(fields, {"x"}, grid.step));
  columns.y = columnOf<float>(grid, requireField<1>(fields, {"y"}, grid.step));
  columns.z = columnOf<float>(grid, requireField<1>(fields, {"z"}, grid.step));
  if (const PointField* intensity = fieldOf(fields, kIntensityNames, grid.step))
    columns.intensity = columnOf<float>(grid, *intensity);
  if (const PointField* ring = fieldOf(fields, kRingNames, grid.step))
    columns.ring = columnOf<std::uint16_t>(grid, *ring);
  if (const PointField* time = fieldOf(fields, kTimeNames, grid.step))
  {
    columns.time = columnOf<double>(grid, *time);
    columns.single_precision_time = time->type == kFloat32;
  }
  return {makeCloud(columns, label, header.stamp_ns), header.frame};
}

// Livox's offsets count from the message's time base, which drivers also write as its stamp, some
// of them by way of a double.
RosObservation readLivoxCustom(WireReader& in, const std::string& label)
{
  constexpr std::size_t kPointBytes = 19;
  constexpr std::int64_t kRounding = 1'000, kOtherClock = 1'000'000'000;  // [ns]
  const RosHeader header = readRosHeader(in);
  const auto base_ns = static_cast<std::int64_t>(in.number<std::uint64_t>());
  (void)in.number<std::uint32_t>();  // points, which the sequence tells again
  (void)in.take(4);                  // number of the LiDAR, reserved
  const std::size_t n = in.count(kPointBytes);
  const double ahead = static_cast<double>(base_ns) - static_cast<double>(header.stamp_ns);
  const bool shifted = std::abs(ahead) > kRounding && std::abs(ahead) < kOtherClock;
  const std::int64_t shift_ns = shifted ? base_ns - header.stamp_ns : 0;
  CloudColumns columns;
  for (std::size_t i = 0; i < n; ++i)
  {
    columns.time.push_back(toSeconds(std::int64_t{in.number<std::uint32_t>()} + shift_ns));
    columns.x.push_back(in.number<float>());
    columns.y.push_back(in.number<float>());
    columns.z.push_back(in.number<float>());
    columns.intensity.push_back(in.number<std::uint8_t>());
    (void)in.number<std::uint8_t>();  // tag
    columns.ring.push_back(in.number<std::uint8_t>());
  }
  return {makeCloud(columns, label, header.stamp_ns), header.frame};
}

RosObservation readVelodyneScan(WireReader& in, const std::string& label)
{
  const RosHeader header = readRosHeader(in);
  constexpr std::size_t kLeast = 8 + kVelodynePacketBytes;
  const std::size_t n = in.count(kLeast);
  std::vector<VelodynePacketBytes> packets;
  std::int64_t first_ns = header.stamp_ns;
  for (std::size_t i = 0; i < n; ++i)
  {
    const std::int64_t seconds =
        in.isRos1() ? std::int64_t{in.number<std::uint32_t>()} : in.number<std::int32_t>();
    const std::int64_t stamp_ns = seconds * 1'000'000'000 + in.number<std::uint32_t>();
    // The header's stamp is that of the last packet with most drivers; MRPT's is the first one's.
    if (i == 0 && stamp_ns != 0) first_ns = stamp_ns;
    packets.push_back(in.take(kVelodynePacketBytes));
  }
  return {makeVelodyneScan(packets, label, first_ns), header.frame};
}

}  // namespace fastlio
