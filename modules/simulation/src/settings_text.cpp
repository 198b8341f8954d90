// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "angles.h"
#include <fastlio/odometry/nearest_name.h>
#include <fastlio/simulation/settings_table.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::int64_t kStartUnitNs = 1'000'000'000;
constexpr std::int64_t kLastEpoch = 9'000'000'000;  // [s], in the range of 64-bit nanoseconds

/** The whole text as a number. */
template <typename T>
std::optional<T> number(std::string_view text)
{
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

template <std::size_t N>
std::optional<std::array<double, N>> numbers(std::string_view text)
{
  std::array<double, N> values{};
  for (std::size_t i = 0; i < N; ++i)
  {
    const std::size_t comma = i + 1 < N ? text.find(',') : text.size();
    if (comma == std::string_view::npos) return std::nullopt;
    const auto value = number<double>(text.substr(0, comma));
    if (!value || !std::isfinite(*value)) return std::nullopt;
    values[i] = *value;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return values;
}

std::string formatted(double value)
{
  std::array<char, 32> buffer{};
  const auto* end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {static_cast<const char*>(buffer.data()), end};
}

/** Writes a text into a setting; false when it is not an allowed value. */
struct Parser
{
  SimulationSettings& settings;
  std::string_view text;

  bool operator()(const RealSetting& s) const
  {
    const auto value = number<double>(text);
    if (!value || !(*value >= s.min && *value <= s.max)) return false;
    *s.member(settings) = *value * s.si_per_unit;
    return true;
  }
  bool operator()(const CountSetting& s) const
  {
    const auto value = number<int>(text);
    if (!value || *value < s.min || *value > s.max) return false;
    *s.member(settings) = *value;
    return true;
  }
  bool operator()(const SeedSetting& s) const
  {
    const auto value = number<std::uint64_t>(text);
    if (value) *s.member(settings) = *value;
    return value.has_value();
  }
  bool operator()(const EpochSetting& s) const
  {
    const auto value = number<std::int64_t>(text);
    if (!value || *value < 0 || *value > kLastEpoch) return false;
    *s.member(settings) = *value * kStartUnitNs;
    return true;
  }
  bool operator()(const SwitchSetting& s) const
  {
    if (text != "true" && text != "false") return false;
    *s.member(settings) = text == "true";
    return true;
  }
  bool operator()(const KindSetting& s) const
  {
    const auto& names = lidarKindNames();
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) return false;
    *s.member(settings) = static_cast<LidarKind>(found - names.begin());
    return true;
  }
  bool operator()(const ChoiceSetting& s) const
  {
    const auto found = std::find(s.names.begin(), s.names.end(), text);
    if (found == s.names.end()) return false;
    s.write(settings, static_cast<std::size_t>(found - s.names.begin()));
    return true;
  }
  bool operator()(const VectorSetting& s) const
  {
    const auto v = numbers<3>(text);
    if (v) *s.member(settings) = Vec3((*v)[0], (*v)[1], (*v)[2]);
    return v.has_value();
  }
  bool operator()(const PoseSetting& s) const
  {
    const auto v = numbers<6>(text);
    if (v) *s.member(settings) = poseFromNumbers(*v);
    return v.has_value();
  }
};

/** The text of a setting. */
struct Formatter
{
  SimulationSettings settings;

  std::string operator()(const RealSetting& s)
  {
    return formatted(*s.member(settings) / s.si_per_unit);
  }
  std::string operator()(const CountSetting& s) { return std::to_string(*s.member(settings)); }
  std::string operator()(const SeedSetting& s) { return std::to_string(*s.member(settings)); }
  std::string operator()(const EpochSetting& s)
  {
    return std::to_string(*s.member(settings) / kStartUnitNs);
  }
  std::string operator()(const SwitchSetting& s) { return *s.member(settings) ? "true" : "false"; }
  std::string operator()(const KindSetting& s)
  {
    return std::string(lidarKindNames().at(static_cast<std::size_t>(*s.member(settings))));
  }
  std::string operator()(const ChoiceSetting& s)
  {
    return std::string(s.names.at(s.read(settings)));
  }
  std::string operator()(const VectorSetting& s)
  {
    const Vec3& v = *s.member(settings);
    return formatted(v.x()) + "," + formatted(v.y()) + "," + formatted(v.z());
  }
  std::string operator()(const PoseSetting& s)
  {
    std::string text;
    for (const double n : numbersFromPose(*s.member(settings)))
      text += (text.empty() ? "" : ",") + formatted(std::round(n * 1e9) / 1e9);
    return text;
  }
};

struct Describer
{
  static std::string oneOf(const std::vector<std::string_view>& names)
  {
    std::string text = "one of";
    for (const auto name : names)
      text += " " + std::string(name);
    return text;
  }

  std::string operator()(const RealSetting& s) const
  {
    return "a number from " + formatted(s.min) + " to " + formatted(s.max);
  }
  std::string operator()(const CountSetting& s) const
  {
    return "a whole number from " + std::to_string(s.min) + " to " + std::to_string(s.max);
  }
  std::string operator()(const SeedSetting&) const { return "a whole number, not negative"; }
  std::string operator()(const EpochSetting&) const
  {
    return "whole seconds from 0 to " + std::to_string(kLastEpoch);
  }
  std::string operator()(const SwitchSetting&) const { return "true or false"; }
  std::string operator()(const KindSetting&) const { return oneOf(lidarKindNames()); }
  std::string operator()(const ChoiceSetting& s) const { return oneOf(s.names); }
  std::string operator()(const VectorSetting&) const { return "three numbers: x,y,z"; }
  std::string operator()(const PoseSetting&) const { return "six numbers: x,y,z,yaw,pitch,roll"; }
};

const SettingRow& findRow(std::string_view key)
{
  std::vector<std::string_view> keys;
  for (const auto& row : settingsTable())
  {
    if (row.key == key) return row;
    keys.push_back(row.key);
  }
  throw std::invalid_argument(
      "There is no setting '" + std::string(key) + "'. Did you mean '" +
      std::string(nearestName(key, keys)) + "'?");
}
}  // namespace

SimulationSettings withSetting(
    SimulationSettings settings, std::string_view key, std::string_view text)
{
  const SettingRow& row = findRow(key);
  if (std::visit(Parser{settings, text}, row.value)) return settings;
  const std::string unit = row.unit.empty() ? "" : " [" + std::string(row.unit) + "]";
  throw std::invalid_argument(
      "Setting '" + std::string(key) + "' cannot be '" + std::string(text) + "': give " +
      allowedValues(row) + unit + ".");
}

std::string settingText(const SettingRow& row, const SimulationSettings& settings)
{
  return std::visit(Formatter{settings}, row.value);
}

std::string allowedValues(const SettingRow& row)
{
  return std::visit(Describer{}, row.value);
}

void requireValid(const SimulationSettings& settings)
{
  std::string problems;
  for (const auto& row : settingsTable())
  {
    SimulationSettings scratch = settings;
    const std::string text = settingText(row, settings);
    if (!std::visit(Parser{scratch, text}, row.value))
      problems +=
          "\n  " + std::string(row.key) + " is " + text + ": needed is " + allowedValues(row) + ".";
  }
  if (settings.lidar.min_range >= settings.lidar.max_range)
    problems += "\n  lidar.min_range must be below lidar.max_range.";
  if (!problems.empty())
    throw std::invalid_argument("The simulation's settings cannot be used:" + problems);
}

}  // namespace fastlio
