// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file bounded_line.h Lines of files of others. */
#pragma once

#include <cstddef>
#include <istream>
#include <string>

namespace fastlio
{
/** A line of a table or of a map file, with room for hundreds of numbers [bytes]. */
inline constexpr std::size_t kLongestLine = 16384;

/** The next line without its end, LF or CR LF; a longer one is cut, and what is left of it is the
 * next line. False at the end. Takes no memory for the rest of a file that has no lines. */
inline bool readBoundedLine(std::istream& in, std::string& line)
{
  line.clear();
  for (int c = in.get(); c != std::istream::traits_type::eof(); c = in.get())
  {
    if (c == '\n')
    {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      return true;
    }
    line += static_cast<char>(c);
    if (line.size() == kLongestLine) return true;
  }
  return !line.empty();
}

}  // namespace fastlio
