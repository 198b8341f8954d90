// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "fast_lio_keys.h"
#include "removed_keys.h"
#include "unknown_key.h"
#include "yaml_text.h"
#include "yaml_value.h"
#include <fastlio/config/config_yaml.h>
#include <fastlio/config/yaml_file.h>
#include <fastlio/files/input_file.h>
#include <fastlio/interface/odometry_option_table.h>
#include <fastlio/options/printable.h>
#include <fastlio/options/split_text.h>
#include <fastlio/survey/lidar_models.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace fastlio
{
namespace
{
using mrpt::containers::yaml;

/** An error in a document, and its place. */
struct Problem
{
  int line = 0;  //!< counted from 1; 0: unknown, as for values that were set in code
  std::string text;
};
using Problems = std::vector<Problem>;

void requireNoProblems(Problems problems, const std::string& source)
{
  std::stable_sort(
      problems.begin(), problems.end(),
      [](const Problem& a, const Problem& b) { return a.line < b.line; });
  std::vector<std::string> texts;
  for (const Problem& problem : problems)
    texts.push_back(
        (problem.line > 0 ? "line " + std::to_string(problem.line) + ", " : "") + problem.text);
  requireNone(texts, source);
}

Problem problemAt(const yaml::node_t& node, const std::string& key, const std::string& what)
{
  const bool has_place = node.marks.line > 0 || node.marks.column > 0;
  return {has_place ? node.marks.line + 1 : 0, printable(key) + ": " + what};
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

void loadValue(Loading& loading, const std::string& key, const yaml::node_t& node)
{
  const auto* row = findOption(configTable(), key);
  std::optional<std::string> problem =
      row == nullptr ? unknownKeyText(key)
                     : assignNode(row->value(loading.config), row->unit, node);
  if (!problem) return;
  const std::string advice = row == nullptr ? "" : adviceFor(key + ": " + plainTextOf(node));
  if (!advice.empty()) *problem += "; " + advice;
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

/** Each of its parameters gets a message that says what takes its place. */
void explainFastLioGroup(Loading& loading, const std::string& group, const yaml::node_t& node)
{
  for (const auto& [key, value] : node.asMap())
  {
    const auto name = key.as<std::string>();
    if (value.isMap())
      explainFastLioGroup(loading, name, value);
    else
      loadValue(loading, group + "." + name, value);
  }
}

void loadTopLevel(Loading& loading, const std::string& name, const yaml::node_t& node)
{
  if (isGroup(name))
    loadGroup(loading, name, node);
  else if (
      node.isMap() && (isFastLioGroup(name) || node.asMap().count(std::string(kRos2Group)) > 0))
    explainFastLioGroup(loading, name, node);
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

Problems repetitions(const std::vector<RepeatedKey>& repeated)
{
  Problems problems;
  for (const RepeatedKey& key : repeated)
    problems.push_back(
        {key.line, printable(key.key) + ": is given a second time (first in line " +
                       std::to_string(key.first_line) + "); remove one of them"});
  return problems;
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

/** Why nothing came out of a file. */
std::string emptyText(const std::string& path)
{
  std::error_code ignored;
  const auto type = std::filesystem::status(path, ignored).type();
  // What comes through a pipe is read once, which is enough here.
  const bool is_stream =
      type == std::filesystem::file_type::fifo || type == std::filesystem::file_type::character;
  const auto problem = is_stream ? std::nullopt : inputFileProblem(path);
  if (!problem) return "is empty; it must hold 'group:' lines with 'name: value' lines below";
  const bool says_so = problem->rfind("cannot", 0) == 0;
  return says_so ? *problem : "cannot be read: it " + *problem;
}

/** \exception std::exception without the name of the file */
std::string fileText(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::string text(kLargestYaml + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kLargestYaml)
    throw std::invalid_argument(
        "is larger than " + std::to_string(kLargestYaml >> 20U) +
        " MiB and so no parameter file; a recording is given to --input-rawlog");
  if (text.empty()) throw std::runtime_error(emptyText(path));
  return text;
}

/** Where a preset is that was named as if its file lay here. */
std::string presetText(const std::string& path)
{
  const std::filesystem::path file(path);
  for (const Preset& preset : presetTable())
    if (file.stem() == preset.name && !std::filesystem::exists(file))
      return " The preset of this name is params/" + std::string(preset.name) +
             ".yaml of the sources, or of /usr/share/mrpt_fastlio where the package is installed.";
  return {};
}

YamlText parsedFile(const std::string& path)
{
  try
  {
    return parseYaml(fileText(path));
  }
  catch (const std::invalid_argument& e)
  {
    throw std::invalid_argument(path + ": " + e.what() + ".");
  }
  catch (const std::runtime_error& e)
  {
    throw std::runtime_error(path + ": " + e.what() + "." + presetText(path));
  }
}
}  // namespace

Config loadConfig(const yaml& document, const std::string& source)
{
  const Loading result = loading(document);
  requireNoProblems(result.problems, source);
  return result.config;
}

ConfigFile readConfigFile(const std::string& path)
{
  const YamlText text = parsedFile(path);
  Loading result = loading(text.document);
  append(result.problems, repetitions(text.repeated));
  requireNoProblems(result.problems, path);
  ConfigFile file{result.config, {}};
  for (const auto& row : configTable())
    if (const int line = lineOf(row.key, text.document); line > 0)
      file.lines[std::string(row.key)] = line;
  return file;
}

yaml readYamlFile(const std::string& path)
{
  const YamlText text = parseYaml(fileText(path));
  const Problems repeated = repetitions(text.repeated);
  if (!repeated.empty())
    throw std::invalid_argument(
        "line " + std::to_string(repeated.front().line) + ", " + repeated.front().text);
  return text.document;
}

std::string applySetting(const std::string& setting, Config& config)
{
  const auto wrong = [&setting](const std::string& what)
  { return std::invalid_argument("--set '" + printable(setting) + "': " + what); };
  // As around the colon of a parameter file, blanks around the sign do not count.
  const std::size_t equals = setting.find('=');
  std::string key(trimmed(std::string_view(setting).substr(0, equals)));
  if (equals == std::string::npos)
    throw wrong("has no '='; write KEY=VALUE, for example map.voxel_size=0.3");
  const auto* row = findOption(configTable(), key);
  if (row == nullptr) throw wrong("'" + printable(key) + "' " + unknownKeyText(key));
  if (const auto problem = assign(
          row->value(config), row->unit,
          std::string(trimmed(std::string_view(setting).substr(equals + 1)))))
    throw wrong(*problem);
  return key;
}

Config loadConfigFromFile(const std::string& path)
{
  return readConfigFile(path).config;
}

}  // namespace fastlio
