// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "ply_file.h"

#include <fastlio/files/bounded_line.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/options/split_text.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostPlyLines = 1000;  // comments included

struct Type
{
  const char* name;
  const char* sized_name;
  std::size_t bytes;
  char kind;  // of number: i, u or f
};
constexpr Type kTypes[] = {{"char", "int8", 1, 'i'},     {"uchar", "uint8", 1, 'u'},
                           {"short", "int16", 2, 'i'},   {"ushort", "uint16", 2, 'u'},
                           {"int", "int32", 4, 'i'},     {"uint", "uint32", 4, 'u'},
                           {"float", "float32", 4, 'f'}, {"double", "float64", 8, 'f'}};

struct Property
{
  std::string name;
  const Type* type = nullptr;
  const Type* count = nullptr;  // of a list: how many there are
};

struct Element
{
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class PlyFormat
{
  Ascii,
  LittleEndian,
  BigEndian
};

struct PlyHeader
{
  std::optional<PlyFormat> format;
  std::vector<Element> elements;
};

[[noreturn]] void failPly(const std::string& path, const std::string& why)
{
  throw std::runtime_error("PLY file '" + path + "': " + why);
}

const Type* typeNamed(std::string_view name)
{
  const auto* found = std::find_if(
      std::begin(kTypes), std::end(kTypes),
      [&](const Type& type) { return name == type.name || name == type.sized_name; });
  return found == std::end(kTypes) ? nullptr : found;
}

/** Whether a line of the header is understood. */
bool take(PlyHeader& header, const std::vector<std::string_view>& words)
{
  if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return true;
  if (words[0] == "format" && words.size() == 3 && words[2] == "1.0")
  {
    if (words[1] == "ascii") header.format = PlyFormat::Ascii;
    if (words[1] == "binary_little_endian") header.format = PlyFormat::LittleEndian;
    if (words[1] == "binary_big_endian") header.format = PlyFormat::BigEndian;
    return header.format.has_value();
  }
  if (words[0] == "element" && words.size() == 3)
  {
    const auto count = parsed<std::size_t>(words[2]);
    if (count) header.elements.push_back({std::string(words[1]), *count, {}});
    return count.has_value();
  }
  if (words[0] != "property" || header.elements.empty()) return false;
  Property property;
  property.name = words.back();
  if (words.size() == 3) property.type = typeNamed(words[1]);
  if (words.size() == 5 && words[1] == "list")
  {
    property.count = typeNamed(words[2]);
    property.type = typeNamed(words[3]);
    if (property.count == nullptr || property.count->kind == 'f') return false;
  }
  header.elements.back().properties.push_back(property);
  return property.type != nullptr;
}

PlyHeader readPlyHeader(std::istream& in, const std::string& path)
{
  PlyHeader header;
  std::string line;
  if (!readBoundedLine(in, line) || line != "ply") failPly(path, "it does not begin with 'ply'");
  for (std::size_t number = 2; readBoundedLine(in, line); ++number)
  {
    if (number > kMostPlyLines) failPly(path, "its header does not end");
    if (line == "end_header")
    {
      if (!header.format) failPly(path, "its header names no format");
      return header;
    }
    if (!take(header, splitAtBlanks(line)))
      failPly(
          path, "line " + std::to_string(number) + " of its header is not understood: '" +
                    printable(line) + "'");
  }
  failPly(path, "it ends inside its header");
}

/** Gives the numbers of the body one after the other. */
class PlyBody
{
 public:
  PlyBody(std::istream& in, PlyFormat format) : in_(in), format_(format) {}

  /** Nothing at the end of the file, or where a word is no number. */
  std::optional<double> next(const Type& type)
  {
    return format_ == PlyFormat::Ascii ? nextWord() : nextBinary(type);
  }

 private:
  std::optional<double> nextWord()
  {
    constexpr std::size_t kLongestNumber = 100;
    int c = in_.get();
    while (c == ' ' || (c >= '\t' && c <= '\r'))
      c = in_.get();
    word_.clear();
    for (; c > ' ' && word_.size() < kLongestNumber; c = in_.get())
      word_ += static_cast<char>(c);
    return parsed<double>(word_);
  }

  std::optional<double> nextBinary(const Type& type)
  {
    std::array<char, 8> bytes{};
    if (!in_.read(bytes.data(), static_cast<std::streamsize>(type.bytes))) return std::nullopt;
    if (format_ == PlyFormat::BigEndian)
      std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(type.bytes));
    if (type.kind == 'f') return type.bytes == 8 ? as<double>(bytes) : as<float>(bytes);
    if (type.bytes == 1) return type.kind == 'u' ? as<std::uint8_t>(bytes) : as<std::int8_t>(bytes);
    if (type.bytes == 2)
      return type.kind == 'u' ? as<std::uint16_t>(bytes) : as<std::int16_t>(bytes);
    return type.kind == 'u' ? as<std::uint32_t>(bytes) : as<std::int32_t>(bytes);
  }

  template <typename T>
  static double as(const std::array<char, 8>& bytes)
  {
    T value{};
    std::memcpy(&value, bytes.data(), sizeof(value));
    return static_cast<double>(value);
  }

  std::istream& in_;
  PlyFormat format_;
  std::string word_;
};

/** One vertex, edge, ...; false when the file ends before, or a word is no number. */
bool readOne(PlyBody& body, const Element& element, std::vector<double>& values)
{
  values.clear();
  for (const Property& property : element.properties)
  {
    if (property.count == nullptr)
    {
      const auto value = body.next(*property.type);
      if (!value) return false;
      values.push_back(*value);
      continue;
    }
    const auto count = body.next(*property.count);
    if (!count || *count < 0) return false;
    for (double i = 0; i < *count; ++i)
      if (!body.next(*property.type)) return false;
    values.push_back(0.0);
  }
  return true;
}

std::array<std::size_t, 3> axesOf(const Element& vertex, const std::string& path)
{
  std::array<std::size_t, 3> axes{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::string name(1, static_cast<char>('x' + axis));
    const auto found = std::find_if(
        vertex.properties.begin(), vertex.properties.end(),
        [&](const Property& p) { return p.name == name && p.count == nullptr; });
    if (found == vertex.properties.end()) failPly(path, "its vertices have no property " + name);
    axes.at(axis) = static_cast<std::size_t>(found - vertex.properties.begin());
  }
  return axes;
}
}  // namespace

FilePoints readPly(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  const PlyHeader header = readPlyHeader(in, path);
  PlyBody body(in, *header.format);
  std::vector<double> values;
  FilePoints points;
  for (const Element& element : header.elements)
  {
    const bool is_vertex = element.name == "vertex";
    const auto axes = is_vertex ? axesOf(element, path) : std::array<std::size_t, 3>{};
    // An element without properties takes no bytes, however many there are.
    for (std::size_t i = 0; i < element.count && !element.properties.empty(); ++i)
    {
      if (!readOne(body, element, values))
        failPly(
            path, "it is cut off or damaged: element " + std::to_string(i) + " of " +
                      std::to_string(element.count) + " (" + printable(element.name) +
                      ") cannot be read");
      if (!is_vertex) continue;
      points.add({values[axes[0]], values[axes[1]], values[axes[2]]});
    }
    if (is_vertex) return points;  // what follows, faces for instance, is not needed
  }
  failPly(path, "it has no element vertex");
}

}  // namespace fastlio
