// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "imu_columns.h"

#include <fastlio/math/angles.h>
#include <fastlio/math/gravity.h>
#include <fastlio/math/time.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace fastlio
{
namespace
{
/** Small letters and digits. */
std::string plainText(std::string_view text)
{
  std::string plain;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

/** Without the unit: "Angular_Velocity.x [rad/s]" is "angularvelocityx". */
std::string plainName(std::string_view name)
{
  return plainText(name.substr(0, name.find_first_of("[(")));
}

/** What stands in brackets behind a name: "rad s^-1" of "w_x [rad s^-1]". */
std::string_view bracketIn(std::string_view name)
{
  const std::size_t begin = std::min(name.find_first_of("[("), name.size());
  name.remove_prefix(std::min(begin + 1, name.size()));
  return name.substr(0, name.find_first_of("])"));
}

/** A word and what it says of times [ns]; 0: nothing. */
struct TimeWord
{
  const char* word;
  std::int64_t unit_ns;
};

constexpr std::int64_t kMicrosecond = 1000, kMillisecond = 1'000'000;
constexpr std::array<TimeWord, 18> kTimeColumns{{
    {"t", 0},
    {"time", 0},
    {"timestamp", 0},
    {"stamp", 0},
    {"times", 0},
    {"timens", 1},
    {"timestampns", 1},
    {"stampns", 1},
    {"timeus", kMicrosecond},
    {"timestampus", kMicrosecond},
    {"timems", kMillisecond},
    {"timestampms", kMillisecond},
    {"sec", kSecondNs},
    {"secs", kSecondNs},
    {"seconds", kSecondNs},
    {"headerstampsec", kSecondNs},
    {"headerstampsecs", kSecondNs},
    {"timesec", kSecondNs},
}};
constexpr std::array<const char*, 7> kNanosecondColumns{"nsec",
                                                        "nsecs",
                                                        "nanosec",
                                                        "nanosecs",
                                                        "nanoseconds",
                                                        "headerstampnsecs",
                                                        "headerstampnanosec"};
constexpr std::array<TimeWord, 13> kUnitWords{{
    {"ns", 1},
    {"nsec", 1},
    {"nanosec", 1},
    {"nanoseconds", 1},
    {"us", kMicrosecond},
    {"usec", kMicrosecond},
    {"microseconds", kMicrosecond},
    {"ms", kMillisecond},
    {"msec", kMillisecond},
    {"milliseconds", kMillisecond},
    {"s", kSecondNs},
    {"sec", kSecondNs},
    {"seconds", kSecondNs},
}};

template <std::size_t Count>
const TimeWord* wordIn(const std::array<TimeWord, Count>& words, const std::string& word)
{
  const auto found = std::find_if(
      words.begin(), words.end(), [&](const TimeWord& row) { return word == row.word; });
  return found == words.end() ? nullptr : &*found;
}

/** A unit of rates or accelerations in units of SI. */
struct ValueUnit
{
  const char* word;
  double si;
};
constexpr std::array<ValueUnit, 11> kValueUnits{{
    {"degs", kRadPerDeg},
    {"degs1", kRadPerDeg},
    {"degsec", kRadPerDeg},
    {"degpersec", kRadPerDeg},
    {"degreess", kRadPerDeg},
    {"dps", kRadPerDeg},
    {"mdps", 1e-3 * kRadPerDeg},
    {"mrads", 1e-3},
    {"g", kStandardGravity},
    {"mg", 1e-3 * kStandardGravity},
    {"milligee", 1e-3 * kStandardGravity},
}};
}  // namespace

std::vector<std::string_view> cellsOf(std::string_view line)
{
  constexpr std::string_view kAround = " \t\r";
  const std::string_view separators = line.find(',') != std::string_view::npos   ? ","
                                      : line.find(';') != std::string_view::npos ? ";"
                                                                                 : kAround;
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();)
  {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    std::string_view cell = line.substr(begin, end - begin);
    cell.remove_prefix(std::min(cell.find_first_not_of(kAround), cell.size()));
    cell = cell.substr(0, cell.find_last_not_of(kAround) + 1);
    if (!cell.empty() || separators != kAround) cells.push_back(cell);
    begin = end + 1;
  }
  return cells;
}

int roleOfColumn(std::string_view column)
{
  const std::string name = plainName(column);
  if (wordIn(kTimeColumns, name) != nullptr) return 0;
  const auto starts = [&](const char* with) { return name.rfind(with, 0) == 0; };
  const int axis = name.empty() ? 0 : name.back() - 'x' + 1;
  if (axis < 1 || axis > 3) return -1;
  if (starts("w") || starts("gyr") || starts("angular") || starts("omega") || starts("rate"))
    return axis;
  if (starts("a") || starts("linearacc")) return 3 + axis;
  return -1;
}

bool isNanosecondColumn(std::string_view name)
{
  const std::string plain = plainName(name);
  return std::any_of(
      kNanosecondColumns.begin(), kNanosecondColumns.end(),
      [&](const char* word) { return plain == word; });
}

std::int64_t timeUnitOfColumn(std::string_view name)
{
  const std::string_view text = bracketIn(name);
  // The letter mu is none of ASCII's.
  if (std::any_of(
          text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) > 127; }))
    return kMicrosecond;
  const TimeWord* unit = wordIn(kUnitWords, plainText(text));
  if (unit != nullptr) return unit->unit_ns;
  const TimeWord* column = wordIn(kTimeColumns, plainName(name));
  return column == nullptr ? 0 : column->unit_ns;
}

double siFactorOfColumn(std::string_view name)
{
  const std::string unit = plainText(bracketIn(name));
  for (const ValueUnit& row : kValueUnits)
    if (unit == row.word) return row.si;
  return 1.0;
}

}  // namespace fastlio
