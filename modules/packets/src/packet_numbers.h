// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file packet_numbers.h Numbers at a place in a packet, whose size was checked before. */
#pragma once

#include <fastlio/math/little_endian.h>
#include <fastlio/math/time.h>

#include <cstddef>
#include <cstdint>
#include <ctime>

namespace fastlio
{
inline constexpr int kTurn = 36'000;  // in the unit of azimuths, 0.01 deg
/** A scan that has more is no scan: it is given as it is. */
inline constexpr std::size_t kMostPointsPerScan = 2'000'000;

/** The highest byte first. \param size of the number, at most 8 bytes */
[[nodiscard]] inline std::uint64_t bigAt(const std::uint8_t* bytes, std::size_t size)
{
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i)
    value = value << 8U | bytes[i];
  return value;
}

[[nodiscard]] inline std::uint16_t big16At(const std::uint8_t* bytes)
{
  return static_cast<std::uint16_t>(bigAt(bytes, 2));
}

/** Clocks that have just begun are fine; others are damage. */
[[nodiscard]] inline bool isStamp(std::int64_t stamp_ns)
{
  return stamp_ns >= 0 && stamp_ns < kLatestStamp;
}

/** Month, day, hour, minute, second as one byte each. \return seconds since 1970 */
[[nodiscard]] inline std::int64_t secondsOfDate(int year, const std::uint8_t* rest)
{
  std::tm date{};
  date.tm_year = year - 1900;
  date.tm_mon = rest[0] - 1;
  date.tm_mday = rest[1];
  date.tm_hour = rest[2];
  date.tm_min = rest[3];
  date.tm_sec = rest[4];
  return std::int64_t{timegm(&date)};
}

}  // namespace fastlio
