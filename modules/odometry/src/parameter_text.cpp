// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_numbers.h"
#include <fastlio/odometry/parameter_text.h>

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
}  // namespace

std::string valueText(const ParameterRow& row, const Parameters& p)
{
  return std::visit(
      Overloaded{
          [&p](const RealValue& v) { return realText(v, v.member.of(p)); },
          [&p](const IntegerValue& v) { return std::to_string(v.member.of(p)); },
          [&p](const BooleanValue& v) { return std::string(v.member.of(p) ? "true" : "false"); },
          [&p](const ChoiceValue& v) { return std::string(v.names.at(v.read(p))); },
          [&p](const RegexValue& v) { return singleQuoted(v.member.of(p)); },
          [&p](const PoseValue& v)
          {
            const auto& pose = v.member.of(p);
            return pose ? poseText(*pose) : std::string("null");
          },
          [&p](const TextValue& v) { return singleQuoted(v.member.of(p)); }},
      row.value);
}

std::string allowedText(const ParameterRow& row)
{
  return std::visit(
      Overloaded{
          [&row](const RealValue& v)
          { return rangeText(shortestText(v.min), shortestText(v.max), row.unit); },
          [&row](const IntegerValue& v)
          { return rangeText(std::to_string(v.min), std::to_string(v.max), row.unit); },
          [](const BooleanValue&) { return std::string("true, false"); },
          [](const ChoiceValue& v)
          {
            std::string text;
            for (const auto name : v.names)
              text += (text.empty() ? "" : ", ") + std::string(name);
            return text;
          },
          [](const RegexValue&) { return std::string("a regular expression"); },
          [](const PoseValue&)
          { return std::string("[x, y, z, yaw, pitch, roll] in m and deg, or null"); },
          [](const TextValue& v) { return std::string(v.allowed); }},
      row.value);
}

std::string typeText(const ParameterRow& row)
{
  constexpr std::array<const char*, 7> kNames = {"number", "whole number", "boolean", "choice",
                                                 "text",   "pose",         "text"};
  return kNames.at(row.value.index());
}

}  // namespace fastlio
