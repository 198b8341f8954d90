// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/number_text.h>

#include <array>
#include <charconv>
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

std::string roundTripText(double value)
{
  if (!std::isfinite(value)) return notFiniteText(value);
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

}  // namespace fastlio
