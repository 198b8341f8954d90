// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/recordings/point_grid.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <type_traits>

namespace fastlio
{
namespace
{

constexpr std::array<std::size_t, 11> kFieldSizes{0, 1, 1, 2, 2, 4, 4, 4, 8, 8, 8};

// First those that can mean nothing else.
constexpr std::array<std::string_view, 6> kRingNames{"ring", "line",     "channel",
                                                     "row",  "laser_id", "scan_line"};
constexpr std::array<std::string_view, 4> kIntensityNames{
    "intensity", "reflectivity", "i", "signal"};

template <typename T>
T valueAt(const std::uint8_t* bytes, bool swap)
{
  std::array<std::uint8_t, sizeof(T)> raw{};
  std::memcpy(raw.data(), bytes, sizeof(T));
  if (swap) std::reverse(raw.begin(), raw.end());
  T value{};
  std::memcpy(&value, raw.data(), sizeof(T));
  return value;
}

/** Numbers of lines may be stored in any type; what is no such number is line 0. */
template <typename Wanted>
Wanted as(double value)
{
  if constexpr (!std::is_floating_point_v<Wanted>)
    if (!(value >= 0.0 && value <= std::numeric_limits<Wanted>::max())) return Wanted{0};
  return static_cast<Wanted>(value);
}

/** One loop for each type that is stored: clouds have millions of values a second. */
template <typename Stored, typename Wanted>
std::vector<Wanted> columnFrom(const PointGrid& grid, const PointField& field)
{
  std::vector<Wanted> values(grid.width * grid.height);
  if (values.empty()) return values;  // the data of an empty file are nowhere
  std::size_t next = 0;
  for (std::size_t row = 0; row < grid.height; ++row)
  {
    const std::uint8_t* point = grid.data + row * grid.row_step + field.offset;
    for (std::size_t i = 0; i < grid.width; ++i, point += grid.step)
      values[next++] = as<Wanted>(static_cast<double>(valueAt<Stored>(point, grid.swap)));
  }
  return values;
}

template <typename Wanted>
std::vector<Wanted> columnOf(const PointGrid& grid, const PointField& field)
{
  using Reader = std::vector<Wanted> (*)(const PointGrid&, const PointField&);
  constexpr std::array<Reader, 11> kReaders{
      nullptr,
      columnFrom<std::int8_t, Wanted>,
      columnFrom<std::uint8_t, Wanted>,
      columnFrom<std::int16_t, Wanted>,
      columnFrom<std::uint16_t, Wanted>,
      columnFrom<std::int32_t, Wanted>,
      columnFrom<std::uint32_t, Wanted>,
      columnFrom<float, Wanted>,
      columnFrom<double, Wanted>,
      columnFrom<std::int64_t, Wanted>,
      columnFrom<std::uint64_t, Wanted>};
  return kReaders.at(field.type)(grid, field);
}

/** Null: there is none of these names that lies within a point. */
template <std::size_t Count>
const PointField* fieldOf(
    const std::vector<PointField>& fields, const std::array<std::string_view, Count>& names,
    std::size_t step)
{
  for (const std::string_view name : names)
    for (const PointField& field : fields)
      if (field.name == name && field.type >= kInt8 && field.type <= kUint64 &&
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

CloudColumns columnsOf(
    const PointGrid& grid, std::size_t bytes, const std::vector<PointField>& fields)
{
  requireInside(grid, bytes);
  CloudColumns columns;
  columns.x = columnOf<float>(grid, requireField<1>(fields, {"x"}, grid.step));
  columns.y = columnOf<float>(grid, requireField<1>(fields, {"y"}, grid.step));
  columns.z = columnOf<float>(grid, requireField<1>(fields, {"z"}, grid.step));
  if (const PointField* intensity = fieldOf(fields, kIntensityNames, grid.step))
    columns.intensity = columnOf<float>(grid, *intensity);
  if (const PointField* ring = fieldOf(fields, kRingNames, grid.step))
    columns.ring = columnOf<std::uint16_t>(grid, *ring);
  if (const PointField* time = fieldOf(fields, kPointTimeNames, grid.step))
  {
    columns.time = columnOf<double>(grid, *time);
    columns.single_precision_time = time->type == kFloat32;
  }
  return columns;
}

std::vector<double> valuesOf(
    const PointGrid& grid, const std::vector<PointField>& fields, std::string_view name)
{
  return columnOf<double>(grid, requireField<1>(fields, {name}, grid.step));
}

}  // namespace fastlio
