// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/config/yaml_file.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/tuning/search_space.h>

#include <mrpt/containers/yaml.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
using mrpt::containers::yaml;
constexpr int kDigits = 4;

[[noreturn]] void fail(const std::string& key, const std::string& what)
{
  throw std::invalid_argument(printable(key) + ": " + what);
}

/** A scalar, or a sequence as "[a, b]". */
std::string textOf(const std::string& key, const yaml::node_t& node)
{
  if (node.isScalar()) return node.as<std::string>();
  if (!node.isSequence()) fail(key, "each value must be a scalar or a list of numbers");
  std::string text;
  for (const auto& element : node.asSequence())
    text += (text.empty() ? "[" : ", ") + textOf(key, element);
  return text + "]";
}

double numberOf(const std::string& key, const std::string& name, const yaml::node_t& node)
{
  const auto number = parsed<double>(textOf(key, node));
  if (!number || !std::isfinite(*number)) fail(key, name + " must be a finite number");
  return *number;
}

void readRange(SearchKey& key, const yaml::node_t& node)
{
  bool has_min = false;
  bool has_max = false;
  for (const auto& [name_node, value] : node.asMap())
  {
    const auto name = name_node.as<std::string>();
    if (name == "min")
      key.min = numberOf(key.key, name, value), has_min = true;
    else if (name == "max")
      key.max = numberOf(key.key, name, value), has_max = true;
    else if (
        name == "scale" && (textOf(key.key, value) == "log" || textOf(key.key, value) == "lin"))
      key.logarithmic = textOf(key.key, value) == "log";
    else
      fail(
          key.key, "saw '" + printable(name) + "'; a range is {min: A, max: B, scale: lin or log}");
  }
  if (!has_min || !has_max || !(key.min < key.max))
    fail(key.key, "a range needs min and max, min below max");
  if (key.logarithmic && key.min <= 0.0) fail(key.key, "a range with scale: log needs min above 0");
}

void requireAllowed(const SearchKey& key, const OptionTable<Config>::value_type& row)
{
  Config config;
  const OptionValue value = row.value(config);
  const bool number =
      std::holds_alternative<RealValue>(value) || std::holds_alternative<IntegerValue>(value);
  if (key.values.empty() && !number) fail(key.key, "is no number: give a list of values");
  std::vector<std::string> texts = key.values;
  if (texts.empty()) texts = {key.at(0.0), key.at(1.0)};
  for (const std::string& text : texts)
    if (const auto problem = assign(value, row.unit, text)) fail(key.key, *problem);
}

SearchKey readKey(const std::string& name, const yaml::node_t& node)
{
  const auto* row = findOption(configTable(), name);
  if (row == nullptr)
    fail(name, "is not a parameter; did you mean '" + nearestKey(configTable(), name) + "'?");
  SearchKey key;
  key.key = name;
  Config config;
  key.whole = std::holds_alternative<IntegerValue>(row->value(config));
  if (node.isMap())
    readRange(key, node);
  else if (node.isSequence() && !node.asSequence().empty())
    for (const auto& value : node.asSequence())
      key.values.push_back(textOf(name, value));
  else
    fail(name, "needs a list of values, or {min: A, max: B, scale: lin or log}");
  requireAllowed(key, *row);
  return key;
}

SearchSpace spaceOf(const yaml::node_t& root)
{
  if (!root.isMap()) throw std::invalid_argument("holds no 'group:' lines");
  SearchSpace space;
  for (const auto& [group_node, node] : root.asMap())
  {
    const auto group = group_node.as<std::string>();
    if (findOption(configTable(), group) != nullptr)
      space.push_back(readKey(group, node));
    else if (!node.isMap())
      fail(group, "is a group and must hold 'name: values' lines, indented");
    else
      for (const auto& [name, value] : node.asMap())
        space.push_back(readKey(group + "." + name.as<std::string>(), value));
  }
  if (space.empty()) throw std::invalid_argument("names no key to search");
  return space;
}
}  // namespace

std::string SearchKey::at(double place) const
{
  if (!values.empty())
  {
    const auto count = static_cast<double>(values.size());
    return values[static_cast<std::size_t>(std::clamp(std::floor(place * count), 0.0, count - 1))];
  }
  if (place <= 0.0) return shortestText(whole ? std::ceil(min) : min);
  if (place >= 1.0) return shortestText(whole ? std::floor(max) : max);
  const double value = logarithmic ? min * std::pow(max / min, place) : min + place * (max - min);
  if (whole) return shortestText(std::round(value));
  return numberText(value, kDigits);
}

SearchSpace readSearchSpace(const std::string& path)
try
{
  return spaceOf(readYamlFile(path).node());
}
catch (const std::exception& e)
{
  throw std::invalid_argument("search space '" + printable(path) + "': " + e.what());
}

Candidate candidateAt(const SearchSpace& space, const std::vector<double>& places)
{
  Candidate candidate;
  for (std::size_t i = 0; i < space.size(); ++i)
    candidate.push_back(space[i].at(places[i]));
  return candidate;
}

Config configured(const Config& base, const SearchSpace& space, const Candidate& candidate)
{
  Config config = base;
  for (std::size_t i = 0; i < space.size(); ++i)
  {
    const auto* row = findOption(configTable(), space[i].key);
    if (const auto problem = assign(row->value(config), row->unit, candidate[i]))
      fail(space[i].key, *problem);
  }
  return config;
}

}  // namespace fastlio
