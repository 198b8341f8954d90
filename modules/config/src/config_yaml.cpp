// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "key_lines.h"
#include "removed_keys.h"
#include "yaml_value.h"
#include <fastlio/config/config_yaml.h>
#include <fastlio/odometry/odometry_option_table.h>

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
                     (problems.size() == 1 ? " problem" : " problems") + " in the configuration:";
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

std::vector<std::string_view> validTopLevelNames()
{
  std::vector<std::string_view> names;
  for (const auto& row : configTable())
    names.push_back(groupOf(row.key).empty() ? row.key : groupOf(row.key));
  return names;
}

/** A group of today or of an earlier version, whose keys get messages of their own. */
bool isGroup(std::string_view name)
{
  const auto holds = [name](const auto& row) { return !name.empty() && groupOf(row.key) == name; };
  const auto& table = configTable();
  const auto& removed = removedKeys();
  return std::any_of(table.begin(), table.end(), holds) ||
         std::any_of(removed.begin(), removed.end(), holds);
}

/** A configuration that is being read. */
struct Loading
{
  Config config;
  Problems problems;
};

std::string unknownKeyText(const std::string& key)
{
  const std::string_view advice = adviceForKey(key);
  if (!advice.empty()) return std::string(advice);
  return "is not a parameter; did you mean '" + nearestKey(configTable(), key) + "'?";
}

void loadValue(Loading& loading, const std::string& key, const yaml::node_t& node)
{
  const auto* row = findOption(configTable(), key);
  std::optional<std::string> problem =
      row == nullptr ? unknownKeyText(key)
                     : assignNode(row->value(loading.config), row->unit, node);
  if (!problem) return;
  const std::string_view advice = row == nullptr ? "" : adviceForChoice(key, plainTextOf(node));
  if (!advice.empty()) *problem += "; " + std::string(advice);
  loading.problems.push_back(problemAt(node, key, *problem));
}

void loadGroup(Loading& loading, const std::string& group, const yaml::node_t& node)
{
  if (node.isNullNode()) return;
  if (!node.isMap())
  {
    loading.problems.push_back(
        problemAt(node, group, "is a group and must hold 'name: value' lines, indented"));
    return;
  }
  for (const auto& [name, value] : node.asMap())
    loadValue(loading, group + "." + name.as<std::string>(), value);
}

void loadTopLevel(Loading& loading, const std::string& name, const yaml::node_t& node)
{
  if (isGroup(name))
    loadGroup(loading, name, node);
  else if (findOption(configTable(), name) == nullptr && node.isMap())
  {
    const std::string nearest(nearestName(name, validTopLevelNames()));
    loading.problems.push_back(
        problemAt(node, name, "is not a group of parameters; did you mean '" + nearest + "'?"));
  }
  else
    loadValue(loading, name, node);
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
    loadTopLevel(result, name.as<std::string>(), node);
  // Every value is in its range: what is wrong now is a relation between values.
  for (const auto& problem : optionProblems(result.config.odometry))
    result.problems.push_back({0, problem});
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

/** Where the document gives a key, from 1; 0: it does not. */
int lineOf(std::string_view key, const yaml& document)
{
  const yaml::node_t* node = &document.node();
  for (const std::string_view name : {groupOf(key), nameOf(key)})
  {
    if (name.empty()) continue;
    if (!node->isMap()) return 0;
    const auto& map = node->asMap();
    const auto entry = std::find_if(
        map.begin(), map.end(),
        [name](const auto& e) { return e.first.template as<std::string>() == name; });
    if (entry == map.end()) return 0;
    node = &entry->second;
  }
  return std::max(1, node->marks.line + 1);
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

Config loadConfig(const yaml& document, const std::string& source)
{
  const Loading result = loading(document);
  if (!result.problems.empty()) throwProblems(source, result.problems);
  return result.config;
}

ConfigFile readConfigFile(const std::string& path)
{
  const std::string text = fileText(path);
  const yaml document = parsedText(text, path);
  const auto key_lines = keyLines(text);
  Loading result = loading(document);
  append(result.problems, duplicateKeys(key_lines));
  append(result.problems, lostKeys(key_lines, document));
  if (!result.problems.empty()) throwProblems(path, result.problems);
  ConfigFile file{result.config, {}};
  for (const auto& row : configTable())
    if (const int line = lineOf(row.key, document); line > 0)
      file.lines[std::string(row.key)] = line;
  return file;
}

Config loadConfigFromFile(const std::string& path)
{
  return readConfigFile(path).config;
}

}  // namespace fastlio
