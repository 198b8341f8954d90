// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "epoch.h"
#include "overloaded.h"
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/option_value.h>

namespace fastlio
{
namespace
{
std::string rangeText(const std::string& min, const std::string& max, std::string_view unit)
{
  return min + " to " + max + (unit.empty() ? "" : " " + std::string(unit));
}

std::string singleQuoted(const std::string& text)
{
  std::string quoted = "'";
  for (const char c : text)
    quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

std::string listText(const std::vector<std::string_view>& names)
{
  std::string text;
  for (const auto name : names)
    text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

std::string vectorText(const Vec3& v)
{
  return "[" + shortestText(v.x()) + ", " + shortestText(v.y()) + ", " + shortestText(v.z()) + "]";
}
std::string numbersText(const NumbersValue& value)
{
  const std::vector<double>& numbers = *value.member;
  const bool rows = numbers.size() > value.columns;
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    const bool first = i % value.columns == 0;
    if (i > 0) text += first ? "], " : ", ";
    text += (first && rows ? "[" : "") + shortestText(numbers[i]);
  }
  return "[" + text + (rows ? "]]" : "]");
}
}  // namespace

std::string valueText(const OptionValue& value)
{
  return std::visit(
      Overloaded{
          [](const RealValue& v) { return shortestText(*v.member, v.si_per_unit); },
          [](const IntegerValue& v) { return std::to_string(*v.member); },
          [](const SeedValue& v) { return std::to_string(*v.member); },
          [](const EpochValue& v) { return std::to_string(*v.member_ns / kSecondNs); },
          [](const BooleanValue& v) { return std::string(*v.member ? "true" : "false"); },
          [](const ChoiceValue& v) { return std::string(v.names.at(v.read())); },
          [](const RegexValue& v) { return singleQuoted(*v.member); },
          [](const TextValue& v) { return singleQuoted(*v.member); },
          [](const VectorValue& v) { return vectorText(*v.member); },
          [](const PoseValue& v) { return poseText(*v.member); },
          [](const OptionalPoseValue& v)
          { return *v.member ? poseText(**v.member) : std::string("null"); },
          [](const NumbersValue& v) { return numbersText(v); }},
      value);
}

std::optional<std::string> plainText(const OptionValue& value)
{
  if (const auto* regex = std::get_if<RegexValue>(&value)) return *regex->member;
  if (const auto* text = std::get_if<TextValue>(&value)) return *text->member;
  return std::nullopt;
}

std::string allowedText(const OptionValue& value, std::string_view unit)
{
  return std::visit(
      Overloaded{
          [unit](const RealValue& v)
          { return rangeText(shortestText(v.min), shortestText(v.max), unit); },
          [unit](const IntegerValue& v)
          { return rangeText(std::to_string(v.min), std::to_string(v.max), unit); },
          [](const SeedValue&) { return std::string("a whole number, not negative"); },
          [unit](const EpochValue&) { return rangeText("0", std::to_string(kLastEpoch), unit); },
          [](const BooleanValue&) { return std::string("true, false"); },
          [](const ChoiceValue& v) { return listText(v.names); },
          [](const RegexValue&) { return std::string("a regular expression"); },
          [](const TextValue& v) { return std::string(v.allowed); },
          [](const VectorValue&) { return std::string("[x, y, z]"); },
          [](const PoseValue&) { return std::string("[x, y, z, yaw, pitch, roll] in m and deg"); },
          [](const OptionalPoseValue&)
          { return std::string("[x, y, z, yaw, pitch, roll] in m and deg, or null"); },
          [](const NumbersValue& v) { return std::string(v.allowed); }},
      value);
}

std::string typeText(const OptionValue& value)
{
  return std::visit(
      Overloaded{
          [](const RealValue&) { return "number"; },
          [](const IntegerValue&) { return "whole number"; },
          [](const SeedValue&) { return "whole number"; },
          [](const EpochValue&) { return "whole number"; },
          [](const BooleanValue&) { return "boolean"; },
          [](const ChoiceValue&) { return "choice"; }, [](const RegexValue&) { return "text"; },
          [](const TextValue&) { return "text"; }, [](const VectorValue&) { return "vector"; },
          [](const PoseValue&) { return "pose"; }, [](const OptionalPoseValue&) { return "pose"; },
          [](const NumbersValue&) { return "list of numbers"; }},
      value);
}

}  // namespace fastlio
