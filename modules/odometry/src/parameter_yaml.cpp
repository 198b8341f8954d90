// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_key_lines.h"
#include <fastlio/odometry/nearest_name.h>
#include <fastlio/odometry/parameter_check.h>
#include <fastlio/odometry/parameter_read.h>
#include <fastlio/odometry/parameter_table.h>
#include <fastlio/odometry/parameter_yaml.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace fastlio
{
namespace
{
using mrpt::containers::yaml;

/** What is wrong in a document, and where. */
struct Problem
{
  int line = 0;  //!< counted from 1; 0: unknown, as for values that were set in code
  std::string text;
};
using Problems = std::vector<Problem>;

[[noreturn]] void throwProblems(const std::string& source, Problems problems)
{
  std::stable_sort(
      problems.begin(), problems.end(),
      [](const Problem& a, const Problem& b) { return a.line < b.line; });
  std::string text = source + ": " + std::to_string(problems.size()) +
                     (problems.size() == 1 ? " problem" : " problems") + " in the parameters:";
  for (const auto& problem : problems)
  {
    const std::string place = problem.line > 0 ? "line " + std::to_string(problem.line) + ", " : "";
    text += "\n  " + place + problem.text;
  }
  throw std::invalid_argument(text + "\nSee docs/parameters.md for every key with its range.");
}

Problem problemAt(const yaml::node_t& node, const std::string& key, const std::string& what)
{
  const bool has_place = node.marks.line > 0 || node.marks.column > 0;
  return {has_place ? node.marks.line + 1 : 0, key + ": " + what};
}

void append(Problems& to, const Problems& more)
{
  to.insert(to.end(), more.begin(), more.end());
}

std::vector<std::string_view> validKeys()
{
  std::vector<std::string_view> keys;
  for (const auto& row : parameterTable())
    keys.push_back(row.key);
  return keys;
}

std::vector<std::string_view> validTopLevelNames()
{
  std::vector<std::string_view> names;
  for (const auto& row : parameterTable())
    names.push_back(row.group().empty() ? row.name() : row.group());
  return names;
}

bool isGroup(const std::string& name)
{
  const auto& table = parameterTable();
  return std::any_of(
      table.begin(), table.end(),
      [&name](const ParameterRow& row) { return !name.empty() && row.group() == name; });
}

/** Parameters under construction. */
struct Loading
{
  Parameters parameters;
  Problems problems;
};

Loading withParameter(Loading loading, const std::string& key, const yaml::node_t& node)
{
  const ParameterRow* row = findParameter(key);
  if (row == nullptr)
  {
    const std::string nearest(nearestName(key, validKeys()));
    loading.problems.push_back(
        problemAt(node, key, "is not a parameter; did you mean '" + nearest + "'?"));
    return loading;
  }
  const ParsedValue value = withValue(*row, loading.parameters, node);
  if (value.problem)
    loading.problems.push_back(problemAt(node, key, *value.problem));
  else
    loading.parameters = value.parameters;
  return loading;
}

Loading withGroup(Loading loading, const std::string& group, const yaml::node_t& node)
{
  if (node.isNullNode()) return loading;
  if (!node.isMap())
  {
    loading.problems.push_back(
        problemAt(node, group, "is a group and must hold 'name: value' lines, indented"));
    return loading;
  }
  for (const auto& [name, value] : node.asMap())
    loading = withParameter(std::move(loading), group + "." + name.as<std::string>(), value);
  return loading;
}

Loading withTopLevel(Loading loading, const std::string& name, const yaml::node_t& node)
{
  if (isGroup(name)) return withGroup(std::move(loading), name, node);
  if (findParameter(name) == nullptr && node.isMap())
  {
    const std::string nearest(nearestName(name, validTopLevelNames()));
    loading.problems.push_back(
        problemAt(node, name, "is not a group of parameters; did you mean '" + nearest + "'?"));
    return loading;
  }
  return withParameter(std::move(loading), name, node);
}

Problems relationProblems(const Parameters& parameters)
{
  Problems problems;
  for (const auto& relation : parameterRelations())
    if (!relation.holds(parameters))
      problems.push_back({0, std::string(relation.key) + ": " + std::string(relation.demand)});
  return problems;
}

Loading loading(const yaml& document)
{
  Loading result;
  const yaml::node_t& root = document.node();
  if (root.isNullNode()) return result;
  if (!root.isMap())
  {
    result.problems.push_back(
        {0, "the file must hold 'group:' lines with 'name: value' lines below, indented"});
    return result;
  }
  for (const auto& [name, node] : root.asMap())
    result = withTopLevel(std::move(result), name.as<std::string>(), node);
  append(result.problems, relationProblems(result.parameters));
  return result;
}

/** Keys given twice: the YAML parser keeps the last one silently. */
Problems duplicateKeys(const std::vector<KeyLine>& key_lines)
{
  Problems problems;
  std::map<std::string, int> first_line;
  for (const auto& [key, line] : key_lines)
  {
    const auto [entry, is_new] = first_line.emplace(key, line);
    if (!is_new)
      problems.push_back(
          {line, key + ": is given a second time (first in line " + std::to_string(entry->second) +
                     "); remove one of them"});
  }
  return problems;
}

bool holdsKey(const yaml::node_t& root, const std::string& key)
{
  const auto dot = key.find('.');
  if (!root.isMap()) return false;
  for (const auto& [name, node] : root.asMap())
  {
    if (name.as<std::string>() != key.substr(0, dot)) continue;
    return dot == std::string::npos || holdsKey(node, key.substr(dot + 1));
  }
  return false;
}

/** Keys that are in the text but not in the document: the YAML parser stops silently at some
 * errors. */
Problems lostKeys(const std::vector<KeyLine>& key_lines, const yaml& document)
{
  for (const auto& [key, line] : key_lines)
    if (!holdsKey(document.node(), key))
      return {
          {line, key + ": cannot be read from here on; check the YAML syntax (indentation, "
                       "brackets, quotes) here and in the line before"}};
  return {};
}

std::string fileText(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()).good())
    throw std::runtime_error(
        path +
        ": cannot be read as a parameter file; check that it exists, is a file with content and "
        "may be read");
  return text.str();
}

yaml parsedText(const std::string& text, const std::string& path)
{
  try
  {
    return yaml::FromText(text);
  }
  catch (const std::exception&)
  {
    throw std::invalid_argument(
        path +
        ": is not valid YAML; check indentation, brackets, and that every key has a value "
        "(the parser's own message, with the place, is on the standard error)");
  }
}
}  // namespace

Parameters loadParameters(const yaml& document, const std::string& source)
{
  const Loading result = loading(document);
  if (!result.problems.empty()) throwProblems(source, result.problems);
  return result.parameters;
}

Parameters loadParametersFromFile(const std::string& path)
{
  const std::string text = fileText(path);
  const yaml document = parsedText(text, path);
  const auto key_lines = keyLines(text);
  Loading result = loading(document);
  append(result.problems, duplicateKeys(key_lines));
  append(result.problems, lostKeys(key_lines, document));
  if (!result.problems.empty()) throwProblems(path, result.problems);
  return result.parameters;
}

void validate(const Parameters& parameters)
{
  Problems problems;
  for (const auto& row : parameterTable())
    if (const auto problem = valueProblem(row, parameters))
      problems.push_back({0, std::string(row.key) + ": " + *problem});
  append(problems, relationProblems(parameters));
  if (!problems.empty()) throwProblems("Parameters", problems);
}

}  // namespace fastlio
