// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file generic_fields.h Fields of CGenericPointsMap by name, whatever their type and whatever the
 * MRPT (internal). */
#pragma once

#include <fastlio/compat/CGenericPointsMap.h>

#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace fastlio
{
/** The values of a field, null if there is no field of that name and type. */
template <typename T>
const auto* storedField(const mrpt::maps::CGenericPointsMap& map, const std::string& name)
{
#if FASTLIO_MRPT_HAS_GENERIC_MAP
  if constexpr (std::is_same_v<T, float>) return map.getPointsBufferRef_float_field(name);
  if constexpr (std::is_same_v<T, double>) return map.getPointsBufferRef_double_field(name);
  if constexpr (std::is_same_v<T, std::uint16_t>) return map.getPointsBufferRef_uint16_field(name);
  if constexpr (std::is_same_v<T, std::uint8_t>) return map.getPointsBufferRef_uint8_field(name);
#else
  const auto find = [&name](const mrpt::maps::CGenericPointsMap::Fields<T>& fields)
  {
    const auto found = fields.find(name);
    return found == fields.end() ? nullptr : &found->second;
  };
  if constexpr (std::is_same_v<T, float>) return find(map.float_fields);
  if constexpr (std::is_same_v<T, double>) return find(map.double_fields);
  if constexpr (std::is_same_v<T, std::uint16_t>) return find(map.uint16_fields);
  if constexpr (std::is_same_v<T, std::uint8_t>) return find(map.uint8_fields);
  if constexpr (std::is_same_v<T, std::uint32_t>) return find(map.uint32_fields);
#endif
}

/** What is no such number, as NaN or -1 for a line, is 0. */
template <typename Wanted, typename Stored>
Wanted fieldNumber(Stored value)
{
  if constexpr (std::is_integral_v<Wanted>)
  {
    const auto number = static_cast<double>(value);
    if (!(number >= 0.0 && number <= static_cast<double>(std::numeric_limits<Wanted>::max())))
      return Wanted{0};
  }
  return static_cast<Wanted>(value);
}

/** Appends nothing unless \a to is empty and the field is as long as the map. */
template <typename Stored, typename Wanted>
bool takeField(
    const mrpt::maps::CGenericPointsMap& map, const std::string& name, std::vector<Wanted>& to)
{
  const auto* values = storedField<Stored>(map, name);
  if (!to.empty() || values == nullptr || values->size() != map.size()) return false;
  to.reserve(values->size());
  for (const Stored value : *values)
    to.push_back(fieldNumber<Wanted>(value));
  return true;
}

/** The first of the names that there is a field of; empty: none.
 * \param single_precision set when the values are stored as float */
template <typename Wanted>
std::vector<Wanted> genericField(
    const mrpt::maps::CGenericPointsMap& map, const std::vector<std::string>& names,
    bool* single_precision = nullptr)
{
  std::vector<Wanted> values;
  for (const std::string& name : names)
  {
    const bool is_float = takeField<float>(map, name, values);
    if (is_float && single_precision != nullptr) *single_precision = true;
    takeField<double>(map, name, values);
    takeField<std::uint16_t>(map, name, values);
    takeField<std::uint8_t>(map, name, values);
#if !FASTLIO_MRPT_HAS_GENERIC_MAP
    takeField<std::uint32_t>(map, name, values);
#endif
    if (!values.empty()) break;
  }
  return values;
}

}  // namespace fastlio
