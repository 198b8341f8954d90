// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/options/number_text.h>

#include <Eigen/Geometry>

#include <cmath>

namespace fastlio
{
namespace
{
std::string notFiniteText(double value)
{
  if (std::isnan(value)) return "nan";
  return value > 0 ? "inf" : "-inf";
}
}  // namespace

std::string secondsText(std::int64_t stamp_ns)
{
  constexpr std::uint64_t kNsPerSecondExact = 1'000'000'000U;
  const bool negative = stamp_ns < 0;
  const auto bits = static_cast<std::uint64_t>(stamp_ns);
  const std::uint64_t magnitude = negative ? 0U - bits : bits;
  const std::string fraction = std::to_string(magnitude % kNsPerSecondExact);
  return (negative ? "-" : "") + std::to_string(magnitude / kNsPerSecondExact) + "." +
         std::string(9 - fraction.size(), '0') + fraction;
}

std::string fixedText(double value, int decimals)
{
  if (!std::isfinite(value)) return notFiniteText(value);
  std::array<char, 400> text{};  // 309 digits of the largest double, the point and decimals
  const auto end = std::to_chars(
      text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
  return {text.data(), end.ptr};
}

std::string countedText(std::size_t count, std::string_view what)
{
  return std::to_string(count) + " " + std::string(what) + (count == 1 ? "" : "s");
}

std::string roundTripText(double value)
{
  if (!std::isfinite(value)) return notFiniteText(value);
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::string shortestText(double value)
{
  constexpr double kPlainFrom = 1e-4;
  constexpr double kPlainBelow = 1e9;
  if (value == 0.0) return "0";  // of either sign
  const double size = std::abs(value);
  const bool plain = size >= kPlainFrom && size < kPlainBelow;
  std::array<char, 40> buffer{};
  const auto end = std::to_chars(
      buffer.data(), buffer.data() + buffer.size(), value,
      plain ? std::chars_format::fixed : std::chars_format::scientific);
  return {buffer.data(), end.ptr};
}

std::string numberText(double value, int digits)
{
  std::array<char, 40> buffer{};
  const auto end = std::to_chars(
      buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  const std::string text(buffer.data(), end.ptr);
  return shortestText(parsed<double>(text).value_or(value));
}

std::string shortestText(double value, double si_per_unit)
{
  constexpr int kAllDigits = 17;
  for (int digits = 1; digits < kAllDigits; ++digits)
  {
    std::string text = numberText(value / si_per_unit, digits);
    const auto back = parsed<double>(text);
    if (back && *back * si_per_unit == value) return text;
  }
  return shortestText(value / si_per_unit);
}

Pose poseFromSixNumbers(const std::array<double, 6>& numbers)
{
  using Eigen::AngleAxisd;
  const Mat3 R = (AngleAxisd(numbers[3] / kDegPerRad, Vec3::UnitZ()) *
                  AngleAxisd(numbers[4] / kDegPerRad, Vec3::UnitY()) *
                  AngleAxisd(numbers[5] / kDegPerRad, Vec3::UnitX()))
                     .toRotationMatrix();
  return {R, {numbers[0], numbers[1], numbers[2]}};
}

std::array<double, 6> sixNumbers(const Pose& pose)
{
  const Mat3& R = pose.R;
  const double pitch = std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2)));
  // At a pitch of +-90 deg only yaw -+ roll is defined: choose roll = 0.
  const bool upright = std::hypot(R(2, 1), R(2, 2)) > 1e-9;
  const double yaw = upright ? std::atan2(R(1, 0), R(0, 0)) : std::atan2(-R(0, 1), R(1, 1));
  const double roll = upright ? std::atan2(R(2, 1), R(2, 2)) : 0.0;
  return {pose.p.x(),       pose.p.y(),         pose.p.z(),
          yaw * kDegPerRad, pitch * kDegPerRad, roll * kDegPerRad};
}

std::string poseText(const Pose& pose, int digits)
{
  std::string text;
  for (const double number : sixNumbers(pose))
    text +=
        (text.empty() ? "[" : ", ") + numberText(std::abs(number) < 1e-13 ? 0.0 : number, digits);
  return text + "]";
}

}  // namespace fastlio
