// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_numbers.h"
#include <fastlio/odometry/parameter_check.h>
#include <fastlio/odometry/parameter_read.h>
#include <fastlio/odometry/parameter_text.h>

#include <algorithm>
#include <cmath>

namespace fastlio
{
namespace
{
using mrpt::containers::yaml;

/** The text of a scalar that was parsed, or of a value that was set in code. */
std::optional<std::string> scalarText(const yaml::node_t& node)
{
  if (!node.isScalar()) return std::nullopt;
  const std::any& scalar = node.asScalar();
  if (const auto* real = std::any_cast<double>(&scalar)) return shortestText(*real);
  if (const auto* truth = std::any_cast<bool>(&scalar)) return *truth ? "true" : "false";
  return node.as<std::string>();
}

/** What was seen, for messages. */
std::string seenText(const yaml::node_t& node)
{
  const auto text = scalarText(node);
  if (text) return "'" + *text + "'";
  if (node.isNullNode()) return "nothing";
  return node.isMap() ? "a group of keys" : "a list of " + std::to_string(node.size());
}

std::optional<double> finiteNumber(const yaml::node_t& node)
{
  const auto text = scalarText(node);
  const auto number = text ? parsed<double>(*text) : std::nullopt;
  return number && std::isfinite(*number) ? number : std::nullopt;
}

ParsedValue wrongType(const ParameterRow& row, const Parameters& p, const yaml::node_t& node)
{
  return {p, seenText(node) + " is not a " + typeText(row) + "; allowed: " + allowedText(row)};
}

template <typename Value, typename T>
ParsedValue stored(const ParameterRow& row, Parameters p, const Value& value, const T& member)
{
  value.member.in(p) = member;
  return {p, valueProblem(row, p)};
}

ParsedValue readChoice(
    const ParameterRow& row, Parameters p, const ChoiceValue& value, const yaml::node_t& node)
{
  const auto text = scalarText(node);
  const auto name = std::find(value.names.begin(), value.names.end(), text.value_or(""));
  if (!text || name == value.names.end()) return wrongType(row, p, node);
  value.write(p, static_cast<std::size_t>(name - value.names.begin()));
  return {p, std::nullopt};
}

ParsedValue readBoolean(
    const ParameterRow& row, const Parameters& p, const BooleanValue& value,
    const yaml::node_t& node)
{
  const auto text = scalarText(node);
  if (text != "true" && text != "false") return wrongType(row, p, node);
  return stored(row, p, value, text == "true");
}

ParsedValue readPose(
    const ParameterRow& row, const Parameters& p, const PoseValue& value, const yaml::node_t& node)
{
  if (node.isNullNode()) return stored(row, p, value, std::optional<Pose>{});
  std::array<double, 6> numbers{};
  if (!node.isSequence() || node.size() != numbers.size()) return wrongType(row, p, node);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    const auto number = finiteNumber(node.asSequence()[i]);
    if (!number) return wrongType(row, p, node.asSequence()[i]);
    numbers[i] = *number;
  }
  return stored(row, p, value, std::optional<Pose>{poseFromNumbers(numbers)});
}
}  // namespace

ParsedValue withValue(const ParameterRow& row, const Parameters& p, const yaml::node_t& node)
{
  return std::visit(
      Overloaded{
          [&](const RealValue& v)
          {
            const auto number = finiteNumber(node);
            return number ? stored(row, p, v, *number * v.si_per_unit) : wrongType(row, p, node);
          },
          [&](const IntegerValue& v)
          {
            const auto number = parsed<int>(scalarText(node).value_or(""));
            return number ? stored(row, p, v, *number) : wrongType(row, p, node);
          },
          [&](const BooleanValue& v) { return readBoolean(row, p, v, node); },
          [&](const ChoiceValue& v) { return readChoice(row, p, v, node); },
          [&](const RegexValue& v)
          {
            const auto text = scalarText(node);
            return text ? stored(row, p, v, *text) : wrongType(row, p, node);
          },
          [&](const PoseValue& v) { return readPose(row, p, v, node); },
          [&](const TextValue& v)
          {
            const auto text = scalarText(node);
            return text ? stored(row, p, v, *text) : wrongType(row, p, node);
          }},
      row.value);
}

}  // namespace fastlio
