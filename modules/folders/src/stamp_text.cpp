// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "stamp_text.h"

#include <fastlio/files/bounded_line.h>
#include <fastlio/math/statistics.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <fstream>

namespace fastlio
{
namespace
{
constexpr double kEarliestDate = 946'684'800, kLatestDate = 4'500'000'000;  // 2000, 2112 [s]
constexpr std::array<std::int64_t, 4> kStampUnits{kSecondNs, 1'000'000, 1000, 1};

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
  const std::int64_t seconds = timegm(&date);
  if (!fraction || seconds < 0 || seconds >= kLatestStamp / kSecondNs) return std::nullopt;
  return seconds * kSecondNs + *fraction;
}

/** The unit of whole numbers in ascending order, of which there is at least one. */
std::int64_t unitOfWhole(const std::vector<double>& numbers, const StampRhythm& rhythm)
{
  std::vector<double> steps;
  for (std::size_t i = 1; i < numbers.size(); ++i)
    steps.push_back(numbers[i] - numbers[i - 1]);
  const double newest = numbers.back(), step = median(steps);
  for (const std::int64_t unit : kStampUnits)
  {
    const double date = newest * toSeconds(unit);
    if (date >= kEarliestDate && date < kLatestDate && step * toSeconds(unit) <= rhythm.longest)
      return unit;
  }
  const auto misfit = [&](std::int64_t unit)
  { return step > 0 ? std::abs(std::log(step * toSeconds(unit) / rhythm.usual)) : 0.0; };
  std::int64_t best = 1;
  for (auto unit = kStampUnits.rbegin(); unit != kStampUnits.rend(); ++unit)
    if (newest * toSeconds(*unit) < kLatestDate && misfit(*unit) <= misfit(best)) best = *unit;
  return best;
}
}  // namespace

std::int64_t stampUnitOf(const std::vector<std::string>& texts, const StampRhythm& rhythm)
{
  std::vector<double> numbers;
  for (const std::string& text : texts)
  {
    const auto number = parsed<double>(text);
    if (!number || !std::isfinite(*number)) continue;
    if (!parsed<std::int64_t>(text)) return kSecondNs;
    numbers.push_back(*number);
  }
  if (numbers.empty()) return kSecondNs;
  std::sort(numbers.begin(), numbers.end());
  return unitOfWhole(numbers, rhythm);
}

std::optional<std::int64_t> stampOf(std::string_view text, std::int64_t unit_ns)
{
  if (const auto date = fromDate(text)) return date;
  if (text.empty() || text.front() == '-') return std::nullopt;
  const std::int64_t most = kLatestStamp / unit_ns;
  const std::size_t point = text.find('.');
  const auto whole = parsed<std::int64_t>(text.substr(0, point));
  const auto fraction = point == std::string_view::npos ? std::optional<std::int64_t>(0)
                                                        : fractionOf(text.substr(point + 1));
  if (whole && fraction && *whole < most) return *whole * unit_ns + *fraction * unit_ns / kSecondNs;
  const auto number = parsed<double>(text);
  if (!number || !(*number >= 0.0 && *number < static_cast<double>(most))) return std::nullopt;
  return std::int64_t{std::llround(*number * static_cast<double>(unit_ns))};
}

namespace
{
/** Calls \a take with each line that is no remark, until it says that it is enough. */
template <typename Take>
void forEachLine(const std::string& path, Take take)
{
  std::ifstream in(path, std::ios::binary);
  for (std::string line; readBoundedLine(in, line);)
    if (!line.empty() && line.front() != '#' && !take(line)) return;
}

std::string_view firstWord(const std::string& line)
{
  return std::string_view(line).substr(0, line.find_first_of(" \t\r,;"));
}
}  // namespace

std::vector<std::int64_t> stampsOfFile(const std::string& path)
{
  constexpr std::size_t kMostStamps = 10'000'000, kLooks = 1000;
  std::vector<std::string> texts;
  forEachLine(
      path,
      [&](const std::string& line)
      {
        texts.emplace_back(firstWord(line));
        return texts.size() < kLooks;
      });
  const std::int64_t unit_ns = stampUnitOf(texts, kCloudRhythm);
  std::vector<std::int64_t> stamps;
  forEachLine(
      path,
      [&](const std::string& line)
      {
        auto stamp = fromDate(line);
        if (!stamp) stamp = stampOf(firstWord(line), unit_ns);
        if (stamp) stamps.push_back(*stamp);
        return stamp && stamps.size() < kMostStamps;
      });
  return stamps;
}

}  // namespace fastlio
