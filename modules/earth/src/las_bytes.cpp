// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "las_bytes.h"

#include <fastlio/math/time.h>

#include <ctime>

namespace fastlio
{
namespace
{
constexpr std::uint16_t kHeaderBytes = 375, kRecordHeaderBytes = 54, kPointBytes = 30;
constexpr std::uint8_t kPointFormat = 6;
constexpr std::uint16_t kAdjustedStandardGpsTime = 1U << 0U, kIsWkt = 1U << 4U;
constexpr std::uint16_t kWktRecord = 2112;
constexpr std::size_t kLegacyCounts = 24, kReturns = 15;

struct Day
{
  std::uint16_t of_year = 0, year = 0;
};

Day dayOf(std::int64_t stamp_ns)
{
  const auto seconds = static_cast<std::time_t>(stamp_ns / kSecondNs);
  std::tm utc = {};
  if (!isTime(stamp_ns) || gmtime_r(&seconds, &utc) == nullptr) return {};
  return {
      static_cast<std::uint16_t>(utc.tm_yday + 1), static_cast<std::uint16_t>(utc.tm_year + 1900)};
}

std::uint32_t offsetToPoints(const LasHeader& header)
{
  const std::size_t record = header.wkt_bytes == 0 ? 0 : kRecordHeaderBytes + header.wkt_bytes + 1;
  return static_cast<std::uint32_t>(kHeaderBytes + record);
}
}  // namespace

std::string lasHeaderBytes(const LasHeader& header)
{
  std::string bytes;
  const Day day = dayOf(header.day_of_stamp_ns);
  const auto one = [](int number) { return static_cast<std::uint8_t>(number); };
  LasBytes out(bytes);
  out.text("LASF", 4)
      .zeros(2)  // file source
      .number(static_cast<std::uint16_t>(kAdjustedStandardGpsTime | kIsWkt))
      .zeros(16)  // project
      .number(one(1))
      .number(one(4))
      .text("LiDAR-inertial odometry", kLasNameLength)
      .text("mrpt_fastlio", kLasNameLength)
      .number(day.of_year)
      .number(day.year)
      .number(kHeaderBytes)
      .number(offsetToPoints(header))
      .number(static_cast<std::uint32_t>(header.wkt_bytes == 0 ? 0 : 1))
      .number(kPointFormat)
      .number(kPointBytes)
      .zeros(kLegacyCounts);  // zero for this point format
  for (int axis = 0; axis < 3; ++axis)
    out.number(kLasStep);
  for (int axis = 0; axis < 3; ++axis)
    out.number(header.offset[axis]);
  for (int axis = 0; axis < 3; ++axis)
    out.number(header.most[axis]).number(header.least[axis]);
  out.zeros(8 + 8 + 4)  // waveforms, extended records
      .number(header.points)
      .number(header.points)  // all are first returns
      .zeros((kReturns - 1) * sizeof(std::uint64_t));
  return bytes;
}

std::string lasWktRecord(const std::string& wkt)
{
  std::string bytes;
  LasBytes(bytes)
      .zeros(2)
      .text("LASF_Projection", 16)
      .number(kWktRecord)
      .number(static_cast<std::uint16_t>(wkt.size() + 1))
      .text("OGC coordinate system WKT", 32)
      .text(wkt, wkt.size() + 1);
  return bytes;
}

}  // namespace fastlio
