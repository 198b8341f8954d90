// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parameter_numbers.h Numbers and poses as text, independent of the locale (internal). */
#pragma once

#include <fastlio/math/pose.h>
#include <fastlio/odometry/parameter_table.h>

#include <array>
#include <charconv>
#include <optional>
#include <string>

namespace fastlio
{
/** Visitor of a std::variant made of lambdas. */
template <class... Ts>
struct Overloaded : Ts...
{
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

/** The number that the whole text is, or nothing. */
template <typename Number>
std::optional<Number> parsed(const std::string& text)
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

/** The fewest digits in the unit of the file that give back the very member. */
[[nodiscard]] std::string realText(const RealValue& value, double member);

/** R = Rz(yaw) Ry(pitch) Rx(roll) from [x y z yaw pitch roll] in metres and degrees. */
[[nodiscard]] Pose poseFromNumbers(const std::array<double, 6>& numbers);

/** The inverse of poseFromNumbers(), as text. */
[[nodiscard]] std::string poseText(const Pose& pose);

}  // namespace fastlio
