// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "pcd_file.h"

#include <fastlio/files/bounded_line.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>

#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostHeaderLines = 1000;
constexpr std::size_t kLargestNumber = 8;    // [bytes]
constexpr std::size_t kMostNumbers = 10000;  // of a field: descriptors have some hundred

struct Field
{
  std::string name;
  std::size_t size = 4, count = 1;
  char type = 'F';
};

struct Header
{
  std::vector<Field> fields;
  std::size_t points = 0;
  std::string data;  // ascii, binary, ...
};

/** Where a coordinate stands in a point: cell of a line, byte of a record. */
struct Place
{
  std::size_t cell = 0, byte = 0, size = 4;
};

[[noreturn]] void fail(const std::string& path, const std::string& why)
{
  throw std::runtime_error("PCD file '" + path + "': " + why);
}

Header readHeader(std::ifstream& in, const std::string& path)
{
  Header header;
  std::map<std::string, std::vector<std::string>> lines;
  std::size_t count = 0;
  for (std::string line; header.data.empty() && readBoundedLine(in, line);)
  {
    if (++count > kMostHeaderLines) fail(path, "its header does not end");
    std::istringstream cells(line);
    std::string key;
    if (!(cells >> key) || key.front() == '#') continue;
    std::vector<std::string> values;
    for (std::string value; cells >> value;)
      values.push_back(value);
    if (key == "DATA" && !values.empty()) header.data = values.front();
    lines[key] = std::move(values);
  }
  const auto& names = lines["FIELDS"];
  const auto& sizes = lines["SIZE"];
  const auto& types = lines["TYPE"];
  const auto& counts = lines["COUNT"];
  if (header.data.empty() || names.empty() || sizes.size() != names.size() ||
      types.size() != names.size() || lines["POINTS"].empty())
    fail(path, "its header lacks FIELDS, SIZE, TYPE, POINTS or DATA, or they do not fit together");
  const auto number = [&](const std::string& text, std::size_t most)
  {
    const auto value = parsed<std::size_t>(text);
    if (!value || *value > most)
      fail(
          path, "its header has '" + printable(text) + "' where a number up to " +
                    std::to_string(most) + " belongs");
    return *value;
  };
  header.points = number(lines["POINTS"].front(), std::numeric_limits<std::size_t>::max());
  for (std::size_t i = 0; i < names.size(); ++i)
    header.fields.push_back(
        {names[i], number(sizes[i], kLargestNumber),
         i < counts.size() ? number(counts[i], kMostNumbers) : 1, types[i].front()});
  return header;
}

std::array<Place, 3> placesOf(const Header& header, const std::string& path)
{
  std::array<Place, 3> places;
  std::size_t found = 0, cell = 0, byte = 0;
  for (const Field& field : header.fields)
  {
    const auto axis = std::string("xyz").find(field.name);
    if (field.name.size() == 1 && axis != std::string::npos)
    {
      if (field.type != 'F' || (field.size != 4 && field.size != 8) || field.count != 1)
        fail(path, "field " + field.name + " is not a float of 4 or 8 bytes");
      places.at(axis) = {cell, byte, field.size};
      ++found;
    }
    cell += field.count;
    byte += field.size * field.count;
  }
  if (found != 3) fail(path, "it has no fields x, y, z");
  return places;
}

double numberAt(const std::vector<char>& record, const Place& place)
{
  if (place.size == 8)
  {
    double value = 0;
    std::memcpy(&value, record.data() + place.byte, sizeof value);
    return value;
  }
  float value = 0;
  std::memcpy(&value, record.data() + place.byte, sizeof value);
  return static_cast<double>(value);
}

FilePoints readBinary(std::ifstream& in, const Header& header, const std::string& path)
{
  const auto places = placesOf(header, path);
  std::size_t bytes = 0;
  for (const Field& field : header.fields)
    bytes += field.size * field.count;
  std::vector<char> record(bytes);
  FilePoints points;
  for (std::size_t i = 0; i < header.points; ++i)
  {
    if (!in.read(record.data(), static_cast<std::streamsize>(bytes)))
      fail(
          path, "it ends after " + std::to_string(i) + " of " + std::to_string(header.points) +
                    " points");
    points.add(
        {numberAt(record, places[0]), numberAt(record, places[1]), numberAt(record, places[2])});
  }
  return points;
}

FilePoints readAscii(std::ifstream& in, const Header& header, const std::string& path)
{
  const auto places = placesOf(header, path);
  FilePoints points;
  std::vector<std::string> cells;
  for (std::string line; points.points.size() < header.points && readBoundedLine(in, line);)
  {
    std::istringstream text(line);
    text.imbue(std::locale::classic());
    cells.clear();
    for (std::string cell; text >> cell;)
      cells.push_back(cell);
    if (cells.empty()) continue;
    std::array<double, 3> p{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (places.at(axis).cell >= cells.size())
        fail(path, "a line is too short: '" + printable(line) + "'");
      p.at(axis) = parsed<double>(cells[places.at(axis).cell])
                       .value_or(std::numeric_limits<double>::quiet_NaN());
    }
    points.add(p);
  }
  if (points.points.size() < header.points)
    fail(
        path, "it ends after " + std::to_string(points.points.size()) + " of " +
                  std::to_string(header.points) + " points");
  return points;
}
}  // namespace

FilePoints readPcd(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  const Header header = readHeader(in, path);
  if (header.data == "binary") return readBinary(in, header, path);
  if (header.data == "ascii") return readAscii(in, header, path);
  fail(
      path, "DATA " + printable(header.data) +
                " is not supported; save it as ascii or binary (pcl_convert_pcd_ascii_binary)");
}

}  // namespace fastlio
