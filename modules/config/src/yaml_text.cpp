// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "yaml_text.h"

#include <fastlio/options/printable.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <yaml.h>

namespace fastlio
{
namespace
{
using mrpt::containers::yaml;

[[noreturn]] void refuse(const std::string& why)
{
  throw std::invalid_argument(why);
}

[[noreturn]] void refuseLine(std::size_t line, const std::string& why)
{
  refuse("is not valid YAML: line " + std::to_string(line) + ": " + why);
}

bool startsWith(const std::string& text, const char* beginning)
{
  return text.rfind(beginning, 0) == 0;
}

/** Without the mark that some editors put before UTF-8. */
std::string withoutMark(const std::string& text)
{
  if (startsWith(text, "\xFF\xFE") || startsWith(text, "\xFE\xFF"))
    refuse("is text in UTF-16; save it as UTF-8");
  return startsWith(text, "\xEF\xBB\xBF") ? text.substr(3) : text;
}

/** Text has lines and tabs, and no other control character. */
void requireText(const std::string& text)
{
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1, ++line)
  {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    for (std::size_t i = at; i < end; ++i)
    {
      const auto byte = static_cast<unsigned char>(text[i]);
      if ((byte < 0x20 && byte != '\t' && byte != '\r') || byte == 0x7F)
        refuse(
            "is not a text file: line " + std::to_string(line) + " holds the byte " +
            printable(text.substr(i, 1)) +
            ". Parameters are given as YAML; a recording is given to --input-rawlog");
    }
    if (end == text.size()) break;
  }
}

/** Whether a line is indented with a tab, which YAML does not allow. */
bool beginsWithTab(const std::string& text, std::size_t line)
{
  std::size_t at = 0;
  for (std::size_t before = 1; before < line; ++before)
  {
    at = text.find('\n', at);
    if (at == std::string::npos) return false;
    ++at;
  }
  const std::size_t first = text.find_first_not_of(' ', at);
  return first != std::string::npos && text[first] == '\t';
}

/** One step of the parser. */
class Event
{
 public:
  Event(yaml_parser_t& parser, const std::string& text)
  {
    if (yaml_parser_parse(&parser, &event_) != 0) return;
    const std::size_t line = parser.problem_mark.line + 1;
    if (beginsWithTab(text, line))
      refuse("is not valid YAML: line " + std::to_string(line) + " begins with a tab; use spaces");
    std::string why = parser.problem != nullptr ? parser.problem : "it cannot be read";
    if (parser.context != nullptr) why = std::string(parser.context) + ", " + why;
    if (parser.error == YAML_READER_ERROR)
      refuse(
          "is not text in UTF-8 (" + why + ", byte " + std::to_string(parser.problem_offset) + ")");
    refuseLine(line, why);
  }
  ~Event() { yaml_event_delete(&event_); }
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;

  const yaml_event_t* operator->() const { return &event_; }
  [[nodiscard]] int line() const { return static_cast<int>(event_.start_mark.line) + 1; }

 private:
  yaml_event_t event_{};
};

class Reader
{
 public:
  explicit Reader(const std::string& text) : text_(text)
  {
    if (yaml_parser_initialize(&parser_) == 0) throw std::bad_alloc();
    yaml_parser_set_encoding(&parser_, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(
        &parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  }
  ~Reader() { yaml_parser_delete(&parser_); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  YamlText read()
  {
    for (bool begun = false;;)
    {
      const Event event(parser_, text_);
      if (event->type == YAML_STREAM_END_EVENT) break;
      if (event->type == YAML_STREAM_START_EVENT || event->type == YAML_DOCUMENT_END_EVENT)
        continue;
      if (event->type == YAML_DOCUMENT_START_EVENT && begun)
        refuseLine(event->start_mark.line + 1, "a second document begins; give one");
      begun = true;
      if (event->type != YAML_DOCUMENT_START_EVENT) result_.document = yaml(node(event, "", 0));
    }
    return std::move(result_);
  }

 private:
  yaml::node_t node(const Event& event, const std::string& path, int depth)
  {
    if (depth > kDeepestYaml)
      refuseLine(
          event->start_mark.line + 1,
          "it is nested more than " + std::to_string(kDeepestYaml) + " deep");
    yaml::node_t node;
    switch (event->type)
    {
      case YAML_SCALAR_EVENT:
        requirePlain(event, event->data.scalar.anchor, event->data.scalar.tag);
        fill(node, event->data.scalar);
        break;
      case YAML_SEQUENCE_START_EVENT:
        requirePlain(event, event->data.sequence_start.anchor, event->data.sequence_start.tag);
        fillList(node, path, depth);
        break;
      case YAML_MAPPING_START_EVENT:
        requirePlain(event, event->data.mapping_start.anchor, event->data.mapping_start.tag);
        fillGroup(node, path, depth);
        break;
      default:
        refuseLine(event->start_mark.line + 1, "aliases are not read here");
    }
    node.marks = {
        event->start_mark.index, event.line() - 1, static_cast<int>(event->start_mark.column)};
    return node;
  }

  static void requirePlain(const Event& event, const yaml_char_t* anchor, const yaml_char_t* tag)
  {
    if (anchor != nullptr || tag != nullptr)
      refuseLine(event->start_mark.line + 1, "anchors and tags are not read here");
  }

  template <typename Scalar>
  static std::string textOf(const Scalar& scalar)
  {
    return {reinterpret_cast<const char*>(scalar.value), scalar.length};
  }

  template <typename Scalar>
  static void fill(yaml::node_t& node, const Scalar& scalar)
  {
    const std::string text = textOf(scalar);
    const bool is_plain = scalar.style == YAML_PLAIN_SCALAR_STYLE;
    const bool is_null =
        text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL";
    if (!is_plain || !is_null) node = yaml::node_t(text);
  }

  void fillList(yaml::node_t& list, const std::string& path, int depth)
  {
    auto& items = list.d.emplace<yaml::sequence_t>();
    for (;;)
    {
      const Event item(parser_, text_);
      if (item->type == YAML_SEQUENCE_END_EVENT) return;
      items.push_back(node(item, path + "[]", depth + 1));
    }
  }

  void fillGroup(yaml::node_t& group, const std::string& path, int depth)
  {
    auto& entries = group.d.emplace<yaml::map_t>();
    std::map<std::string, int> lines;
    for (;;)
    {
      const Event key(parser_, text_);
      if (key->type == YAML_MAPPING_END_EVENT) return;
      if (key->type != YAML_SCALAR_EVENT)
        refuseLine(key->start_mark.line + 1, "a key must be a name");
      requirePlain(key, key->data.scalar.anchor, key->data.scalar.tag);
      const std::string name = textOf(key->data.scalar);
      const std::string whole = path.empty() ? name : path + "." + name;
      const auto [first, is_new] = lines.emplace(name, key.line());
      if (!is_new) result_.repeated.push_back({whole, key.line(), first->second});
      const Event value(parser_, text_);
      entries[yaml::node_t(name)] = node(value, whole, depth + 1);
    }
  }

  const std::string& text_;
  yaml_parser_t parser_{};
  YamlText result_;
};
}  // namespace

YamlText parseYaml(const std::string& text)
{
  const std::string plain = withoutMark(text);
  requireText(plain);
  return Reader(plain).read();
}

}  // namespace fastlio
