// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "label_pattern.h"

#include <stdexcept>

namespace
{
std::regex compile(const std::string& sensor, const std::string& pattern)
{
  try
  {
    return std::regex(pattern);
  }
  catch (const std::regex_error& e)
  {
    throw std::invalid_argument(
        "The " + sensor + " sensor label '" + pattern + "' is not a regular expression (" +
        e.what() + "). Escape special characters with a backslash, e.g. 'lidar\\(1\\)'.");
  }
}
}  // namespace

namespace fastlio
{
LabelPattern::LabelPattern(const std::string& sensor, const std::string& pattern)
    : any_(pattern.empty()), regex_(compile(sensor, pattern))
{
}

bool LabelPattern::matches(const std::string& label) const
{
  return any_ || std::regex_match(label, regex_);
}

}  // namespace fastlio
