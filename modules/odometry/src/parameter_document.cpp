// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/odometry/parameter_table.h>
#include <fastlio/odometry/parameter_text.h>
#include <fastlio/odometry/parameter_yaml.h>

#include <algorithm>

namespace fastlio
{
namespace
{
constexpr std::size_t kColumns = 100;

/** Comment lines of at most kColumns characters. */
std::string commentLines(const std::string& text, const std::string& indent)
{
  std::string lines;
  std::string line = indent + "#";
  for (std::size_t begin = 0; begin < text.size();)
  {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (line.size() + 1 + end - begin > kColumns)
    {
      lines += line + "\n";
      line = indent + "#";
    }
    line += " " + text.substr(begin, end - begin);
    begin = end + 1;
  }
  return lines + line + "\n";
}

/** "0.1 to 10 m; default 0.5". */
std::string limitsText(const ParameterRow& row)
{
  return allowedText(row) + "; default " + valueText(row, Parameters{});
}

std::string yamlEntry(const ParameterRow& row, const Parameters& parameters)
{
  const std::string indent = row.group().empty() ? "" : "  ";
  return commentLines(std::string(row.effect), indent) + commentLines(limitsText(row), indent) +
         indent + std::string(row.name()) + ": " + valueText(row, parameters) + "\n";
}

std::string markdownRow(const ParameterRow& row)
{
  return "| `" + std::string(row.key) + "` | " + typeText(row) + " | " + std::string(row.unit) +
         " | " + allowedText(row) + " | `" + valueText(row, Parameters{}) + "` | " +
         std::string(row.effect) + " |\n";
}

constexpr const char* kMarkdownIntroduction =
    R"(# Parameters

Generated from the table in `modules/odometry/src/parameter_table.cpp`; do not edit by hand.

A parameter file is YAML: groups with `name: value` lines below, indented. Every key may be left out and
then has its default. An unknown key, a key given twice, a wrong type or a value out of its range is an
error that names the line and what is allowed. `params/velodyne_vlp16.yaml` holds every key and is a good
start for a file of your own. Angles in files are in degrees where the unit says `deg`.
)";

constexpr const char* kMarkdownHead =
    R"(
| key | type | unit | allowed | default | effect |
|---|---|---|---|---|---|
)";
}  // namespace

std::string toYaml(const Parameters& parameters, const std::string& header)
{
  std::string text = header;
  std::string_view group;
  for (const auto& row : parameterTable())
  {
    const bool new_group = row.group() != group;
    if (!text.empty()) text += "\n";
    if (new_group && !row.group().empty()) text += std::string(row.group()) + ":\n";
    group = row.group();
    text += yamlEntry(row, parameters);
  }
  return text;
}

std::string parametersAsMarkdown()
{
  std::string text = kMarkdownIntroduction;
  std::string_view group = "-";
  for (const auto& row : parameterTable())
  {
    if (row.group() != group)
      text += row.group().empty() ? "\n## Without a group\n"
                                  : "\n## `" + std::string(row.group()) + "`\n";
    if (row.group() != group) text += kMarkdownHead;
    group = row.group();
    text += markdownRow(row);
  }
  return text;
}

}  // namespace fastlio
