// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "cloud_files.h"

#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/recordings/byte_source.h>
#include <fastlio/recordings/point_grid.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace fastlio
{
namespace
{
Bytes contentOf(const std::string& path)
{
  FileBytes file(path);
  if (file.size() > kLargestRecord) throw std::runtime_error("is larger than 256 MiB");
  Bytes bytes;
  (void)readBytes(file, file.size(), bytes);
  return bytes;
}

/** Not more than \a most, whatever the length of the line is. */
std::vector<std::string_view> wordsOf(std::string_view line, std::size_t most)
{
  constexpr std::string_view kBlanks = " \t\r";
  std::vector<std::string_view> words;
  std::size_t begin = line.find_first_not_of(kBlanks);
  while (begin != std::string_view::npos && words.size() < most)
  {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

/** The head of a PCD file. */
struct PcdHead
{
  std::vector<PointField> fields;
  std::vector<std::size_t> counts;  // values of each field
  std::size_t step = 0, points = 0;
  std::string data;        // ascii, binary, binary_compressed
  std::size_t length = 0;  // of the head
};

std::size_t sizeIn(std::string_view word, std::size_t most)
{
  const auto number = parsed<std::size_t>(word);
  if (!number || *number > most)
    throw std::runtime_error("its head has the number '" + printable(word) + "'");
  return *number;
}

std::uint8_t pcdType(char kind, std::size_t size)
{
  switch (kind)
  {
    case 'F':
      return size == 4 ? kFloat32 : size == 8 ? kFloat64 : 0;
    case 'U':
      return size == 1 ? kUint8 : size == 2 ? kUint16 : size == 4 ? kUint32 : kUint64;
    case 'I':
      return size == 1 ? kInt8 : size == 2 ? kInt16 : size == 4 ? kInt32 : kInt64;
    default:
      return 0;
  }
}

using Lines = std::vector<std::vector<std::string_view>>;

/** The line of the head that begins with a word. */
const std::vector<std::string_view>& lineOf(const Lines& lines, std::string_view name)
{
  for (const auto& line : lines)
    if (line.front() == name) return line;
  throw std::runtime_error("its head has no line " + std::string(name));
}

constexpr std::size_t kMostPcdFields = 100;

PcdHead headOfLines(const Lines& lines)
{
  constexpr std::size_t kMostCount = 10'000;
  const auto& names = lineOf(lines, "FIELDS");
  const auto &sizes = lineOf(lines, "SIZE"), &types = lineOf(lines, "TYPE");
  const auto counts = std::find_if(
      lines.begin(), lines.end(), [](const auto& line) { return line.front() == "COUNT"; });
  if (names.size() > kMostPcdFields || sizes.size() != names.size() ||
      types.size() != names.size() || (counts != lines.end() && counts->size() != names.size()))
    throw std::runtime_error("its head does not describe each field");
  PcdHead head;
  for (std::size_t i = 1; i < names.size(); ++i)
  {
    const std::size_t size = sizeIn(sizes[i], 8);
    head.counts.push_back(counts == lines.end() ? 1 : sizeIn((*counts)[i], kMostCount));
    if ((size != 1 && size != 2 && size != 4 && size != 8) || head.counts.back() == 0)
      throw std::runtime_error("its head gives a field a size that no number has");
    head.fields.push_back({std::string(names[i]), head.step, pcdType(types[i].front(), size)});
    head.step += size * head.counts.back();
  }
  const auto& data = lineOf(lines, "DATA");
  head.points = sizeIn(lineOf(lines, "POINTS").at(1), std::size_t{1} << 28U);
  head.data = data.size() > 1 ? data[1] : "";
  return head;
}

PcdHead readHead(std::string_view text)
{
  constexpr std::size_t kLongest = 65536;
  Lines lines;
  for (std::size_t at = 0; at < std::min(text.size(), kLongest);)
  {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    auto words = wordsOf(text.substr(at, end - at), kMostPcdFields + 2);
    at = end + 1;
    if (words.empty() || words.front().front() == '#') continue;
    lines.push_back(std::move(words));
    if (lines.back().size() < 2) throw std::runtime_error("its head is not one of PCD");
    if (lines.back().front() != "DATA") continue;
    PcdHead head = headOfLines(lines);
    head.length = std::min(at, text.size());
    return head;
  }
  throw std::runtime_error("its head has no line DATA");
}

CloudColumns fromAscii(const PcdHead& head, std::string_view text)
{
  std::vector<PointField> fields = head.fields;
  std::vector<double> values;
  for (std::size_t i = 0; i < fields.size(); ++i)
    fields[i] = {fields[i].name, i * sizeof(double), kFloat64};
  const std::size_t numbers =
      std::accumulate(head.counts.begin(), head.counts.end(), std::size_t{0});
  std::size_t points = 0;
  for (std::size_t at = 0; at < text.size() && points < head.points;)
  {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const auto words = wordsOf(text.substr(at, end - at), numbers);
    at = end + 1;
    if (words.empty()) continue;
    if (words.size() < numbers)
      throw std::runtime_error("a line of its data has fewer numbers than its head says");
    std::size_t word = 0;
    for (std::size_t i = 0; i < fields.size(); word += head.counts[i++])
      values.push_back(
          parsed<double>(words[word]).value_or(std::numeric_limits<double>::quiet_NaN()));
    ++points;
  }
  PointGrid grid;
  grid.data = reinterpret_cast<const std::uint8_t*>(values.data());
  grid.width = points;
  grid.height = 1;
  grid.step = fields.size() * sizeof(double);
  grid.row_step = grid.width * grid.step;
  return columnsOf(grid, values.size() * sizeof(double), fields);
}

/** LZF, as PCD compresses: runs of bytes, and references to bytes before. */
Bytes unpackLzf(const std::uint8_t* in, std::size_t size, std::size_t unpacked)
{
  constexpr std::size_t kRun = 32, kLong = 7;
  Bytes out;
  for (std::size_t at = 0; at < size;)
  {
    const std::size_t control = in[at++];
    if (control < kRun)
    {
      if (size - at < control + 1) throw std::runtime_error("its compressed data end early");
      out.insert(out.end(), in + at, in + at + control + 1);
      at += control + 1;
    }
    else
    {
      std::size_t length = control / kRun;
      if (size - at < (length == kLong ? 2U : 1U))
        throw std::runtime_error("its compressed data end early");
      if (length == kLong) length += in[at++];
      const std::size_t back = (control % kRun) * 256 + in[at++] + 1;
      if (back > out.size()) throw std::runtime_error("its compressed data are damaged");
      for (std::size_t i = 0; i < length + 2; ++i)
        out.push_back(out[out.size() - back]);
    }
    if (out.size() > unpacked) throw std::runtime_error("its compressed data are damaged");
  }
  return out;
}

/** Compressed data lie field by field; these become records. */
Bytes asRecords(const PcdHead& head, const Bytes& packed)
{
  Bytes records(packed.size());
  for (std::size_t i = 0, at = 0; i < head.fields.size(); ++i)
  {
    const std::size_t end = i + 1 < head.fields.size() ? head.fields[i + 1].offset : head.step;
    const std::size_t size = end - head.fields[i].offset;
    for (std::size_t k = 0; k < head.points; ++k, at += size)
      std::memcpy(records.data() + k * head.step + head.fields[i].offset, packed.data() + at, size);
  }
  return records;
}

CloudColumns fromCompressed(const PcdHead& head, const std::uint8_t* data, std::size_t size)
{
  std::uint32_t sizes[2] = {};  // compressed, and not
  if (size < sizeof sizes) throw std::runtime_error("it ends early");
  std::memcpy(sizes, data, sizeof sizes);
  if (sizes[0] > size - sizeof sizes || sizes[1] != head.points * head.step ||
      sizes[1] > kLargestRecord)
    throw std::runtime_error("the sizes of its compressed data make no sense");
  const Bytes packed = unpackLzf(data + sizeof sizes, sizes[0], sizes[1]);
  if (packed.size() != sizes[1]) throw std::runtime_error("its compressed data end early");
  const Bytes records = asRecords(head, packed);
  return columnsOf(
      {records.data(), head.points, 1, head.step, records.size(), false}, records.size(),
      head.fields);
}
}  // namespace

CloudColumns readBinCloud(const std::string& path)
{
  constexpr std::size_t kStep = 16;
  const Bytes bytes = contentOf(path);
  if (bytes.size() % kStep != 0)
    throw std::runtime_error(
        "has " + std::to_string(bytes.size()) + " bytes, which are not whole points of 16");
  const std::size_t n = bytes.size() / kStep;
  return columnsOf(
      {bytes.data(), n, 1, kStep, bytes.size(), false}, bytes.size(),
      {{"x", 0, kFloat32}, {"y", 4, kFloat32}, {"z", 8, kFloat32}, {"intensity", 12, kFloat32}});
}

CloudColumns readPcdCloud(const std::string& path)
{
  const Bytes bytes = contentOf(path);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const PcdHead head = readHead(text);
  const std::uint8_t* data = bytes.data() + head.length;
  const std::size_t size = bytes.size() - head.length;
  if (head.data == "ascii") return fromAscii(head, text.substr(head.length));
  if (head.data == "binary_compressed") return fromCompressed(head, data, size);
  if (head.data != "binary")
    throw std::runtime_error("has data of the kind '" + printable(head.data) + "'");
  return columnsOf(
      {data, head.points, 1, head.step, head.points * head.step, false}, size, head.fields);
}

}  // namespace fastlio
