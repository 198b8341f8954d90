// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "text_numbers.h"

#include <fastlio/files/bounded_line.h>
#include <fastlio/files/input_file.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/options/split_text.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostBytes = std::size_t{2} << 30U;  // a run of a week has less
constexpr std::int64_t kMaxSeconds = 9'223'372'035;        // of an int64_t in nanoseconds

std::string quoted(std::string_view text)
{
  return "'" + printable(text) + "'";
}

bool allDigits(std::string_view text)
{
  return std::all_of(
      text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

[[noreturn]] void failTooLarge(std::string_view text, const TextPlace& place)
{
  failAt(
      place, "time " + quoted(text) +
                 " does not fit into 64-bit nanoseconds; times are in seconds, "
                 "were they written in nanoseconds?");
}

std::int64_t parseScientificSeconds(std::string_view text, const TextPlace& place)
{
  long double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    failAt(place, "expected a time in seconds, saw " + quoted(text));
  if (std::abs(value) > static_cast<long double>(kMaxSeconds)) failTooLarge(text, place);
  return std::llround(value * static_cast<long double>(kSecondNs));
}

/** Nanoseconds of the digits behind the decimal point, rounded at the tenth. */
std::int64_t fractionNs(std::string_view digits)
{
  std::int64_t ns = 0;
  for (std::size_t i = 0; i < 9; ++i)
    ns = 10 * ns + (i < digits.size() ? digits[i] - '0' : 0);
  return digits.size() > 9 && digits[9] >= '5' ? ns + 1 : ns;
}

std::int64_t parseDecimalSeconds(std::string_view text, const TextPlace& place)
{
  const bool negative = !text.empty() && text.front() == '-';
  const std::string_view unsigned_text = text.substr(negative ? 1 : 0);
  const auto point = unsigned_text.find('.');
  const std::string_view whole = unsigned_text.substr(0, point);
  const std::string_view fraction =
      point == std::string_view::npos ? std::string_view{} : unsigned_text.substr(point + 1);
  if (whole.empty() || !allDigits(whole) || !allDigits(fraction))
    failAt(place, "expected a time in seconds, saw " + quoted(text));
  std::int64_t seconds = 0;
  const auto parsed = std::from_chars(whole.data(), whole.data() + whole.size(), seconds);
  if (parsed.ec != std::errc{} || seconds > kMaxSeconds) failTooLarge(text, place);
  const std::int64_t ns = seconds * kSecondNs + fractionNs(fraction);
  return negative ? -ns : ns;
}

}  // namespace

void failAt(const TextPlace& place, const std::string& message)
{
  throw std::runtime_error(place.file.string() + ":" + std::to_string(place.line) + ": " + message);
}

std::vector<DataLine> readDataLines(const std::filesystem::path& file)
{
  if (const auto problem = inputFileProblem(file.string()))
    throw std::runtime_error(
        file.string() + ": " + *problem + "; give a trajectory, or a table of a run");
  std::ifstream in(file, std::ios::binary);
  std::vector<DataLine> lines;
  std::string text;
  std::size_t bytes = 0;
  for (std::size_t number = 1; readBoundedLine(in, text); ++number)
  {
    bytes += text.size();
    if (bytes > kMostBytes) failAt({file, number}, "there is more text than 2 GiB");
    if (text.size() == kLongestLine)
      failAt(
          {file, number},
          "the line is longer than " + std::to_string(kLongestLine) + " characters");
    const std::string_view data = trimmed(text);
    if (!data.empty() && data.front() != '#') lines.push_back({number, std::string(data)});
  }
  if (in.bad()) throw std::runtime_error(file.string() + ": reading failed half way");
  if (lines.empty())
    throw std::runtime_error(file.string() + ": holds no data (empty, or comments only)");
  return lines;
}

double parseNumber(std::string_view text, const TextPlace& place)
{
  const auto value = parsed<double>(text);
  if (!value) failAt(place, "expected a number, saw " + quoted(text));
  if (!std::isfinite(*value))
    failAt(place, "expected a finite number, saw " + quoted(text) + "; remove or repair the line");
  return *value;
}

std::int64_t parseNanoseconds(std::string_view text, const TextPlace& place)
{
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    failAt(place, "expected an integer number of nanoseconds, saw " + quoted(text));
  return value;
}

std::int64_t parseSeconds(std::string_view text, const TextPlace& place)
{
  const bool scientific = text.find_first_of("eE") != std::string_view::npos;
  return scientific ? parseScientificSeconds(text, place) : parseDecimalSeconds(text, place);
}

}  // namespace fastlio
