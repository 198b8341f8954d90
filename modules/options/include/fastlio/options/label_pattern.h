// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file label_pattern.h Choice of sensors by their label. */
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace fastlio
{
/** Characters of a pattern. Who chooses among all labels of a vehicle needs a tenth. */
inline constexpr std::size_t kLongestPattern = 1000;

/** Why a text is no pattern for labels; nothing when it is one. */
[[nodiscard]] std::optional<std::string> patternProblem(const std::string& pattern);

/** A regular expression (RE2) over whole labels, byte by byte; an empty one matches all. It takes
 * time in proportion to the label and memory within a fixed bound, whatever pattern and label are:
 * there are no references to earlier groups and no looking ahead. Copies share their state, which
 * threads may use together. */
class LabelPattern
{
 public:
  /** \exception std::invalid_argument not a pattern; \a sensor names it in the message */
  LabelPattern(const std::string& sensor, const std::string& pattern);

  [[nodiscard]] bool matches(const std::string& label) const;

 private:
  class Matcher;
  std::shared_ptr<const Matcher> matcher_;  // null: any label
};

}  // namespace fastlio
