// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "yaml_value.h"

#include <fastlio/options/number_text.h>

namespace fastlio
{
namespace
{
using mrpt::containers::yaml;

std::optional<std::string> scalarText(const yaml::node_t& node)
{
  if (!node.isScalar()) return std::nullopt;
  const std::any& scalar = node.asScalar();
  if (const auto* real = std::any_cast<double>(&scalar)) return shortestText(*real);
  if (const auto* truth = std::any_cast<bool>(&scalar)) return *truth ? "true" : "false";
  return node.as<std::string>();
}

/** The value as text, for messages. */
std::string seenText(const yaml::node_t& node)
{
  if (node.isNullNode()) return "nothing";
  return node.isMap() ? "a group of keys" : "a list of " + std::to_string(node.size());
}

bool isList(const OptionValue& value)
{
  return std::holds_alternative<OptionalPoseValue>(value) ||
         std::holds_alternative<PoseValue>(value) || std::holds_alternative<VectorValue>(value) ||
         std::holds_alternative<NumbersValue>(value);
}

/** A list of scalars, or of such lists, as "[a, b, c]", or nothing. */
std::optional<std::string> listText(const yaml::node_t& node, bool rows)
{
  std::string text;
  for (const auto& item : node.asSequence())
  {
    const auto part = rows && item.isSequence() ? listText(item, false) : scalarText(item);
    if (!part) return std::nullopt;
    text += (text.empty() ? "[" : ", ") + *part;
  }
  return text + "]";
}

constexpr std::size_t kPoseNumbers = 6;
constexpr std::size_t kVectorNumbers = 3;
}  // namespace

std::string plainTextOf(const yaml::node_t& node)
{
  return scalarText(node).value_or("");
}

std::optional<std::string> assignNode(
    const OptionValue& value, std::string_view unit, const yaml::node_t& node)
{
  // A null is a scalar, too.
  if (node.isNullNode() && std::holds_alternative<OptionalPoseValue>(value))
    return assign(value, unit, "null");
  if (const auto text = scalarText(node)) return assign(value, unit, *text);
  if (node.isSequence() && isList(value))
  {
    const bool is_vector = std::holds_alternative<VectorValue>(value);
    const bool numbers = std::holds_alternative<NumbersValue>(value);
    const auto text = listText(node, numbers);
    if (text && (numbers || node.size() == (is_vector ? kVectorNumbers : kPoseNumbers)))
      return assign(value, unit, *text);
  }
  return seenText(node) + " is not a " + typeText(value) + "; allowed: " + allowedText(value, unit);
}

}  // namespace fastlio
