// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file number_text.h Numbers and poses from and to text, independent of the locale. */
#pragma once

#include <fastlio/math/pose.h>

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
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

/** Seconds with 9 decimals from integer nanoseconds, exact: 1403636580838555648 ->
 * "1403636580.838555648". */
[[nodiscard]] std::string secondsText(std::int64_t stamp_ns);

/** Fixed notation with \a decimals digits after the point ("nan", "inf" when not finite). */
[[nodiscard]] std::string fixedText(double value, int decimals);

/** "3 gaps", "1 gap". \param what in the singular, of a regular plural */
[[nodiscard]] std::string countedText(std::size_t count, std::string_view what);

/** The shortest text that reads back to the same double, as files of numbers hold it ("nan", "inf"
 * when not finite). */
[[nodiscard]] std::string roundTripText(double value);

/** With so many significant digits. */
[[nodiscard]] std::string numberText(double value, int digits);

/** The shortest text that is read back as \a value, as a person would write it: no exponent for
 * sizes from 1e-4 to 1e9. */
[[nodiscard]] std::string shortestText(double value);

/** The shortest number in the unit of the text that gives back the very \a value in SI units. */
[[nodiscard]] std::string shortestText(double value, double si_per_unit);

/** R = Rz(yaw) Ry(pitch) Rx(roll) from [x y z yaw pitch roll] in metres and degrees. */
[[nodiscard]] Pose poseFromSixNumbers(const std::array<double, 6>& numbers);

/** The inverse of poseFromSixNumbers(); roll = 0 at a pitch of +-90 deg. */
[[nodiscard]] std::array<double, 6> sixNumbers(const Pose& pose);

/** sixNumbers(), as "[x, y, z, yaw, pitch, roll]". The digits of the default
 * hide the rounding of the conversion to angles, and nothing else. */
[[nodiscard]] std::string poseText(const Pose& pose, int digits = 14);

}  // namespace fastlio
