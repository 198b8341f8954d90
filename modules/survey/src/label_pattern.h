// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file label_pattern.h Choice of sensors by their label. */
#pragma once

#include <regex>
#include <string>

namespace fastlio
{
/** A regular expression over whole labels; an empty one matches all. */
class LabelPattern
{
 public:
  /** \exception std::invalid_argument not a regular expression; \a sensor names it in the message
   */
  LabelPattern(const std::string& sensor, const std::string& pattern);

  [[nodiscard]] bool matches(const std::string& label) const;

 private:
  bool any_;
  std::regex regex_;
};

}  // namespace fastlio
