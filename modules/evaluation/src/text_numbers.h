// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file text_numbers.h Lines of numbers in text files, with errors that say where. */
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** A place in a file, for messages. */
struct TextPlace
{
  std::filesystem::path file;
  std::size_t line = 0;  //!< from 1
};

/** Throws std::runtime_error "FILE:LINE: MESSAGE". */
[[noreturn]] void failAt(const TextPlace& place, const std::string& message);

/** A line that is neither blank nor a comment. */
struct DataLine
{
  std::size_t number = 0;  //!< from 1
  std::string text;        //!< without the line's end
};

/** All lines with data; throws std::runtime_error when the file cannot be read, has none, or more
 * than 2 GiB. */
[[nodiscard]] std::vector<DataLine> readDataLines(const std::filesystem::path& file);

/** A finite number. */
[[nodiscard]] double parseNumber(std::string_view text, const TextPlace& place);

/** An integer number of nanoseconds. */
[[nodiscard]] std::int64_t parseNanoseconds(std::string_view text, const TextPlace& place);

/** Decimal seconds as nanoseconds, without going through a floating-point number: a double holds
 * today's UNIX time to 240 ns only. Exponents ("1.7e9") are accepted with the precision of long
 * double. */
[[nodiscard]] std::int64_t parseSeconds(std::string_view text, const TextPlace& place);

}  // namespace fastlio
