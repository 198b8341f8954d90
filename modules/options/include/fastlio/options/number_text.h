// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file number_text.h Numbers and poses from and to text, independent of the locale. */
#pragma once

#include <fastlio/math/pose.h>

#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace fastlio
{
/** The number that the whole text is, or nothing. */
template <typename Number>
std::optional<Number> parsed(std::string_view text)
{
  const char* first = text.data();
  const char* const last = first + text.size();
  if (first != last && *first == '+') ++first;
  Number value{};
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc{} || end != last) return std::nullopt;
  return value;
}

/** With so many significant digits. */
[[nodiscard]] std::string numberText(double value, int digits);

/** The shortest text that is read back as \a value. */
[[nodiscard]] std::string shortestText(double value);

/** The shortest number in the unit of the text that gives back the very \a value in SI units. */
[[nodiscard]] std::string shortestText(double value, double si_per_unit);

/** R = Rz(yaw) Ry(pitch) Rx(roll) from [x y z yaw pitch roll] in metres and degrees. */
[[nodiscard]] Pose poseFromSixNumbers(const std::array<double, 6>& numbers);

/** The inverse of poseFromSixNumbers(), as "[x, y, z, yaw, pitch, roll]". The digits of the default
 * hide the rounding of the conversion to angles, and nothing else. */
[[nodiscard]] std::string poseText(const Pose& pose, int digits = 14);

}  // namespace fastlio
