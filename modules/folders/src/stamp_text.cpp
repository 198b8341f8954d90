// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "stamp_text.h"

#include <fastlio/files/bounded_line.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>

#include <cmath>
#include <ctime>
#include <fstream>

namespace fastlio
{
namespace
{
constexpr std::int64_t kLatestTextSecond = 4'500'000'000;  // 2112

/** Digits behind the point as nanoseconds. */
std::optional<std::int64_t> fractionOf(std::string_view digits)
{
  std::string nine(digits.substr(0, 9));
  nine.resize(9, '0');
  for (const char c : digits)
    if (c < '0' || c > '9') return std::nullopt;
  return parsed<std::int64_t>(nine);
}

std::optional<std::int64_t> fromDate(std::string_view text)
{
  constexpr std::size_t kSeconds = 19;  // characters up to the point
  if (text.size() < kSeconds || text[4] != '-' || text[7] != '-' || text[13] != ':') return {};
  const auto field = [&](std::size_t at, std::size_t size)
  { return parsed<int>(text.substr(at, size)); };
  const auto year = field(0, 4), month = field(5, 2), day = field(8, 2), hour = field(11, 2),
             minute = field(14, 2), second = field(17, 2);
  if (!year || !month || !day || !hour || !minute || !second) return std::nullopt;
  std::tm date{};
  date.tm_year = *year - 1900;
  date.tm_mon = *month - 1;
  date.tm_mday = *day;
  date.tm_hour = *hour;
  date.tm_min = *minute;
  date.tm_sec = *second;
  const auto fraction = text.size() > kSeconds ? fractionOf(text.substr(kSeconds + 1))
                                               : std::optional<std::int64_t>(0);
  if (!fraction) return std::nullopt;
  return std::int64_t{timegm(&date)} * kSecondNs + *fraction;
}

std::optional<std::int64_t> fromWhole(std::int64_t number)
{
  std::int64_t unit_ns = 1;  // the largest in which it is a time of our days
  for (const std::int64_t unit : {kSecondNs, std::int64_t{1'000'000}, std::int64_t{1'000}})
    if (number <= kLatestTextSecond * (kSecondNs / unit))
    {
      unit_ns = unit;
      break;
    }
  return number * unit_ns;
}
}  // namespace

std::optional<std::int64_t> stampOf(std::string_view text)
{
  if (const auto date = fromDate(text)) return date;
  const std::size_t point = text.find('.');
  if (const auto whole = parsed<std::int64_t>(text.substr(0, point)); whole && *whole >= 0)
  {
    if (point == std::string_view::npos) return fromWhole(*whole);
    const auto fraction = fractionOf(text.substr(point + 1));
    if (fraction && *whole < kLatestTextSecond) return *whole * kSecondNs + *fraction;
  }
  const auto seconds = parsed<double>(text);
  if (!seconds || !(*seconds >= 0.0 && *seconds < static_cast<double>(kLatestTextSecond)))
    return std::nullopt;
  return toNanoseconds(*seconds);
}

std::vector<std::int64_t> stampsOfFile(const std::string& path)
{
  constexpr std::size_t kMostStamps = 10'000'000;
  std::vector<std::int64_t> stamps;
  std::ifstream in(path, std::ios::binary);
  for (std::string line; stamps.size() < kMostStamps && readBoundedLine(in, line);)
  {
    if (line.empty() || line.front() == '#') continue;
    auto stamp = fromDate(line);
    if (!stamp) stamp = stampOf(std::string_view(line).substr(0, line.find_first_of(" \t,;")));
    if (!stamp) break;
    stamps.push_back(*stamp);
  }
  return stamps;
}

}  // namespace fastlio
