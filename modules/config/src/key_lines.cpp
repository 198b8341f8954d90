// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "key_lines.h"

#include <sstream>

namespace fastlio
{
namespace
{
/** The plain key that \a line starts with, after its indentation; empty when there is none. */
std::string keyOfLine(const std::string& line, std::size_t indent)
{
  const auto end = line.find_first_of(" :#'\"[]{},", indent);
  const auto colon = line.find_first_not_of(' ', end);
  const bool is_key = colon != std::string::npos && line[colon] == ':';
  return is_key ? line.substr(indent, end - indent) : std::string();
}
}  // namespace

std::vector<KeyLine> keyLines(const std::string& text)
{
  std::vector<KeyLine> keys;
  std::istringstream lines(text);
  std::string line;
  std::string group;
  for (int number = 1; std::getline(lines, line); ++number)
  {
    const auto indent = line.find_first_not_of(' ');
    if (indent == std::string::npos) continue;
    const std::string key = keyOfLine(line, indent);
    if (key.empty()) continue;
    if (indent == 0) group = key;
    keys.push_back({indent == 0 ? key : group + "." + key, number});
  }
  return keys;
}

}  // namespace fastlio
