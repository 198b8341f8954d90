// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parameter_key_lines.h Where keys stand in the text of a parameter file (internal). */
#pragma once

#include <string>
#include <vector>

namespace fastlio
{
/** A key at the start of a line. */
struct KeyLine
{
  std::string key;  //!< `group.name`, or `name` when the line is not indented
  int line = 0;     //!< counted from 1
};

/** The keys of block mappings of one or two levels; what stands inside of brackets is not looked
 * at. */
[[nodiscard]] std::vector<KeyLine> keyLines(const std::string& text);

}  // namespace fastlio
