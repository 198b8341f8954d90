// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/config/config_document.h>

#include <utility>

namespace fastlio
{
namespace
{
std::string markdownRow(const OptionRow<Config>& row)
{
  Config defaults;
  const OptionValue value = row.value(defaults);
  return "| `" + std::string(row.key) + "` | " + typeText(value) + " | " + std::string(row.unit) +
         " | " + allowedText(value, row.unit) + " | `" + valueText(value) + "` | " +
         std::string(row.effect) + " |\n";
}

constexpr const char* kIntroduction =
    R"(# Parameters

Generated from the tables `modules/*/src/*_option_*.cpp`; do not edit by hand.

A parameter file is YAML: groups with `name: value` lines below, indented. It holds what differs from the
defaults; every key may be left out. An unknown key, a key given twice, a wrong type or a value out of its
range is an error that names the line and what is allowed; a key of an earlier version is an error that
says what to do now. Angles in files are in degrees where the unit says `deg`.

`fastlio-replay --dump-config` prints all values in effect and where each comes from,
`--dump-config main` those of the first part. `params/` holds files for common LiDARs.
)";

constexpr const char* kMain = R"(
# Main parameters

Sensors and their poses, noise, ranges, map, start, and what is written: most recordings need nothing else.
)";

constexpr const char* kExpert = R"(
# Expert parameters

For experiments and for sensors that are out of the ordinary.
)";

constexpr const char* kHead =
    R"(
| key | type | unit | allowed | default | effect |
|---|---|---|---|---|---|
)";

std::string markdownTables(OptionTier tier)
{
  std::string text;
  std::string_view group = "-";
  for (const auto& row : configTable())
  {
    if (row.tier != tier) continue;
    const std::string_view now = groupOf(row.key);
    if (now != group)
      text +=
          (now.empty() ? "\n## Without a group\n" : "\n## `" + std::string(now) + "`\n") + kHead;
    group = now;
    text += markdownRow(row);
  }
  return text;
}

/** Lines of YAML, each below the name of its group. */
class YamlLines
{
 public:
  explicit YamlLines(std::string header) : text_(std::move(header)) {}

  void add(std::string_view key, const std::string& value, const std::string& comment = {})
  {
    const std::string_view group = groupOf(key);
    if (group != group_ && !group.empty()) text_ += std::string(group) + ":\n";
    group_ = group;
    text_ += (group.empty() ? "" : "  ") + std::string(nameOf(key)) + ": " + value +
             (comment.empty() ? "" : "  # " + comment) + "\n";
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::string_view group_;
};
}  // namespace

std::string toYaml(const Config& config, const std::string& header)
{
  return toYaml(
      config, [](std::string_view /*key*/) { return false; }, header);
}

std::string toYaml(const Config& config, const OptionFilter& given, const std::string& header)
{
  YamlLines lines(header);
  for (const auto& row : configTable())
  {
    const std::string text = valueText(row, config);
    if (text != valueText(row, Config{}) || given(row.key)) lines.add(row.key, text);
  }
  return lines.text();
}

std::string configDump(const Config& config, const OptionOrigin& origin, bool only_main)
{
  YamlLines lines({});
  for (const auto& row : configTable())
  {
    const std::string from = origin(row.key);
    if (!only_main || row.tier == OptionTier::Main || from != "default")
      lines.add(row.key, valueText(row, config), from);
  }
  return lines.text();
}

std::string configAsMarkdown()
{
  return kIntroduction + (kMain + markdownTables(OptionTier::Main)) + kExpert +
         markdownTables(OptionTier::Expert);
}

}  // namespace fastlio
