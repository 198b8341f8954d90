// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/files/bounded_line.h>
#include <fastlio/files/input_file.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/options/split_text.h>
#include <fastlio/recordings/pcd_reader.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string_view>

namespace fastlio
{
namespace
{
constexpr std::size_t kMostHeadLines = 1000;
constexpr std::size_t kLargestNumber = 8;     // [bytes]
constexpr std::size_t kMostNumbers = 10'000;  // of a field: descriptors have some hundred

/** The words behind the first one of each line. */
using Head = std::map<std::string, std::vector<std::string>>;

Head readHeadLines(std::istream& in)
{
  Head head;
  std::size_t count = 0;
  for (std::string line; head.count("DATA") == 0 && readBoundedLine(in, line);)
  {
    if (++count > kMostHeadLines) throw std::runtime_error("has a head that does not end");
    const auto words = splitAtBlanks(line);
    if (words.empty() || words.front().front() == '#') continue;
    head[std::string(words.front())].assign(words.begin() + 1, words.end());
  }
  return head;
}

/** \pre there is at least one word */
std::size_t numberIn(const std::string& word, std::size_t most)
{
  const auto number = parsed<std::size_t>(word);
  if (!number || *number > most)
    throw std::runtime_error(
        "has '" + printable(word) + "' in its head where a number up to " + std::to_string(most) +
        " belongs");
  return *number;
}

/** Zero: there is no such number. */
std::uint8_t typeOf(char kind, std::size_t size)
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

void requireCoordinates(
    const std::vector<PointField>& fields, const std::vector<std::size_t>& counts)
{
  for (const char* name : {"x", "y", "z"})
  {
    const auto found = std::find_if(
        fields.begin(), fields.end(), [name](const PointField& f) { return f.name == name; });
    if (found == fields.end()) throw std::runtime_error("has no field " + std::string(name));
    const std::size_t count = counts[static_cast<std::size_t>(found - fields.begin())];
    if (count != 1 || (found->type != kFloat32 && found->type != kFloat64))
      throw std::runtime_error(
          "has a field " + std::string(name) + " that is not a float of 4 or 8 bytes");
  }
}

/** LZF, as PCD compresses: runs of bytes, and references to bytes before. */
Bytes unpackLzf(const Bytes& in, std::size_t unpacked)
{
  constexpr std::size_t kRun = 32, kLong = 7;
  const std::size_t size = in.size();
  Bytes out;
  for (std::size_t at = 0; at < size;)
  {
    const std::size_t control = in[at++];
    if (control < kRun)
    {
      if (size - at < control + 1) throw std::runtime_error("has compressed data that end early");
      const auto run = in.begin() + static_cast<std::ptrdiff_t>(at);
      out.insert(out.end(), run, run + static_cast<std::ptrdiff_t>(control + 1));
      at += control + 1;
    }
    else
    {
      std::size_t length = control / kRun;
      if (size - at < (length == kLong ? 2U : 1U))
        throw std::runtime_error("has compressed data that end early");
      if (length == kLong) length += in[at++];
      const std::size_t back = (control % kRun) * 256 + in[at++] + 1;
      if (back > out.size()) throw std::runtime_error("has compressed data that are damaged");
      for (std::size_t i = 0; i < length + 2; ++i)
        out.push_back(out[out.size() - back]);
    }
    if (out.size() > unpacked) throw std::runtime_error("has compressed data that are damaged");
  }
  if (out.size() < unpacked) throw std::runtime_error("has compressed data that end early");
  return out;
}
}  // namespace

PcdReader::PcdReader(const std::string& path)
{
  if (const auto problem = inputFileProblem(path)) throw std::runtime_error(*problem);
  in_.open(path, std::ios::binary);
  readHead();
  in_.clear();  // the file may end with its head
  if (form_ == Form::Ascii) return;
  const auto begin = static_cast<std::size_t>(std::max<std::streamoff>(in_.tellg(), 0));
  const std::size_t bytes_left = std::filesystem::file_size(path) - begin;
  if (form_ == Form::Compressed)
    unpack(bytes_left);
  else if (bytes_left / step_ < points_)
    throw std::runtime_error(
        "ends after " + std::to_string(bytes_left / step_) + " of " + std::to_string(points_) +
        " points");
}

void PcdReader::readHead()
{
  Head head = readHeadLines(in_);
  const auto &names = head["FIELDS"], &sizes = head["SIZE"], &types = head["TYPE"];
  const auto &counts = head["COUNT"], &data = head["DATA"];
  if (names.empty() || sizes.size() != names.size() || types.size() != names.size() ||
      (!counts.empty() && counts.size() != names.size()) || head["POINTS"].empty() || data.empty())
    throw std::runtime_error(
        "has a head that lacks FIELDS, SIZE, TYPE, POINTS or DATA, or they do not fit together");
  points_ = numberIn(head["POINTS"].front(), std::numeric_limits<std::size_t>::max());
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const std::size_t size = numberIn(sizes[i], kLargestNumber);
    counts_.push_back(counts.empty() ? 1 : numberIn(counts[i], kMostNumbers));
    if ((size != 1 && size != 2 && size != 4 && size != 8) || counts_.back() == 0)
      throw std::runtime_error(
          "has a field " + printable(names[i]) + " of a size that no number has");
    fields_.push_back({names[i], step_, typeOf(types[i].front(), size)});
    step_ += size * counts_.back();
  }
  requireCoordinates(fields_, counts_);
  if (data.front() != "ascii" && data.front() != "binary" && data.front() != "binary_compressed")
    throw std::runtime_error(
        "has data of the kind '" + printable(data.front()) +
        "'; save it as ascii, binary or binary_compressed");
  form_ = data.front() == "ascii"    ? Form::Ascii
          : data.front() == "binary" ? Form::Binary
                                     : Form::Compressed;
  if (form_ != Form::Ascii) return;
  for (std::size_t i = 0; i < fields_.size(); ++i)
    fields_[i] = {fields_[i].name, i * sizeof(double), kFloat64};
  step_ = fields_.size() * sizeof(double);
}

/** Compressed data lie field by field; these become records. */
void PcdReader::unpack(std::size_t bytes_left)
{
  std::uint32_t sizes[2] = {};  // compressed, and not
  const bool has_sizes =
      bytes_left >= sizeof sizes && in_.read(reinterpret_cast<char*>(sizes), sizeof sizes).good();
  if (!has_sizes || sizes[0] > bytes_left - sizeof sizes)
    throw std::runtime_error("has compressed data that end early");
  if (sizes[1] % step_ != 0 || sizes[1] / step_ != points_)
    throw std::runtime_error(
        "has compressed data of " + std::to_string(sizes[1]) + " bytes for " +
        std::to_string(points_) + " points of " + std::to_string(step_));
  if (sizes[1] > kLargestRecord)
    throw std::runtime_error("inflates to more than 256 MiB; save it as binary");
  Bytes packed(sizes[0]);
  in_.read(reinterpret_cast<char*>(packed.data()), static_cast<std::streamsize>(packed.size()));
  const Bytes columns = unpackLzf(packed, sizes[1]);
  records_.resize(columns.size());
  const std::uint8_t* from = columns.data();
  for (std::size_t i = 0; i < fields_.size(); ++i)
  {
    const std::size_t end = i + 1 < fields_.size() ? fields_[i + 1].offset : step_;
    const std::size_t size = end - fields_[i].offset;
    for (std::size_t k = 0; k < points_; ++k, from += size)
      std::memcpy(records_.data() + k * step_ + fields_[i].offset, from, size);
  }
}

void PcdReader::readBinary(std::size_t points)
{
  records_.resize(points * step_);
  if (!in_.read(
          reinterpret_cast<char*>(records_.data()), static_cast<std::streamsize>(records_.size())))
    throw std::runtime_error("cannot be read behind point " + std::to_string(given_));
}

void PcdReader::readAscii(std::size_t points)
{
  const std::size_t numbers = std::accumulate(counts_.begin(), counts_.end(), std::size_t{0});
  records_.clear();
  std::size_t done = 0;
  for (std::string line; done < points && readBoundedLine(in_, line);)
  {
    const auto words = splitAtBlanks(line, numbers);
    if (words.empty()) continue;
    if (words.size() < numbers)
      throw std::runtime_error(
          "has a line with fewer numbers than its head says: '" + printable(line) + "'");
    for (std::size_t i = 0, word = 0; i < counts_.size(); word += counts_[i++])
    {
      const double value =
          parsed<double>(words[word]).value_or(std::numeric_limits<double>::quiet_NaN());
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
      records_.insert(records_.end(), bytes, bytes + sizeof value);
    }
    ++done;
  }
  if (done < points)
    throw std::runtime_error(
        "ends after " + std::to_string(given_ + done) + " of " + std::to_string(points_) +
        " points");
}

PointGrid PcdReader::next(std::size_t most)
{
  const std::size_t points = std::min(most, points_ - given_);
  if (form_ == Form::Ascii)
    readAscii(points);
  else if (form_ == Form::Binary)
    readBinary(points);
  const std::size_t begin = form_ == Form::Compressed ? given_ * step_ : 0;
  given_ += points;
  return {records_.data() + begin, points, 1, step_, points * step_, false};
}

}  // namespace fastlio
