// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "timed_stream.h"

#include "cloud_files.h"
#include "stamp_text.h"
#include <fastlio/files/bounded_line.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/printable.h>
#include <fastlio/recordings/cloud_builder.h>
#include <fastlio/recordings/sensor_imu.h>
#include <fastlio/sensors/conversions.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

ReadProblem fileProblem(const std::string& path, const std::string& what)
{
  return {path, ReadProblemKind::Corrupt, "", path + ": the file " + printable(what, 1000) + "."};
}

/** Parts between commas, or semicolons, or else blanks; without the blanks around them. */
std::vector<std::string_view> cellsOf(std::string_view line)
{
  constexpr std::string_view kAround = " \t\r";
  const std::string_view separators = line.find(',') != std::string_view::npos   ? ","
                                      : line.find(';') != std::string_view::npos ? ";"
                                                                                 : kAround;
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0; begin <= line.size();)
  {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    std::string_view cell = line.substr(begin, end - begin);
    cell.remove_prefix(std::min(cell.find_first_not_of(kAround), cell.size()));
    cell = cell.substr(0, cell.find_last_not_of(kAround) + 1);
    if (!cell.empty() || separators != kAround) cells.push_back(cell);
    begin = end + 1;
  }
  return cells;
}

/** Small letters and digits, without the unit: "Angular_Velocity.x [rad/s]" is
 * "angularvelocityx". */
std::string plainName(std::string_view name)
{
  std::string plain;
  for (const char c : name.substr(0, name.find_first_of("[(")))
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

/** 0: time, 1 to 3: rates, 4 to 6: accelerations; -1: something else. */
int roleOf(const std::string& name)
{
  for (const char* time :
       {"t", "time", "timestamp", "stamp", "timens", "timestampns", "times", "sec"})
    if (name == time) return 0;
  const auto starts = [&](const char* with) { return name.rfind(with, 0) == 0; };
  const int axis = name.empty() ? 0 : name.back() - 'x' + 1;
  if (axis < 1 || axis > 3) return -1;
  if (starts("w") || starts("gyr") || starts("angular") || starts("omega") || starts("rate"))
    return axis;
  if (starts("a") || starts("linearacc")) return 3 + axis;
  return -1;
}
}  // namespace

std::vector<std::string> filesIn(
    const std::string& folder, const std::vector<std::string>& extensions)
{
  constexpr std::size_t kMostFiles = 10'000'000;
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
  {
    const std::string extension = it->path().extension().string();
    if (std::find(extensions.begin(), extensions.end(), extension) != extensions.end())
      files.push_back(it->path().string());
    if (files.size() == kMostFiles) break;
  }
  std::sort(files.begin(), files.end());
  return files;
}

CloudStream::CloudStream(
    std::string label, std::vector<TimedFile> files, std::string reason,
    const std::optional<Pose>& pose)
    : label_(std::move(label)), reason_(std::move(reason)), files_(std::move(files)), pose_(pose)
{
}

std::optional<std::int64_t> CloudStream::stamp() const
{
  if (next_ == files_.size()) return std::nullopt;
  return files_[next_].stamp_ns;
}

NextRecorded CloudStream::take()
{
  const TimedFile& file = files_[next_++];
  try
  {
    bytes_ += recordingBytes(file.path);
    const bool pcd = fs::path(file.path).extension() == ".pcd";
    auto cloud =
        makeCloud(pcd ? readPcdCloud(file.path) : readBinCloud(file.path), label_, file.stamp_ns);
    if (pose_) cloud->setSensorPose(toMrptPose(*pose_));
    ++taken_;
    return mrpt::obs::CObservation::Ptr(cloud);
  }
  catch (const std::exception& e)
  {
    return fileProblem(file.path, e.what());
  }
}

TopicReport CloudStream::report() const
{
  return {label_, "files of clouds", next_, taken_, reason_};
}

ImuTable::ImuTable(const std::string& path) : path_(path), in_(path, std::ios::binary)
{
  std::string line;
  if (!in_ || !readBoundedLine(in_, line))
    throw std::runtime_error("'" + path + "' cannot be read, or is empty");
  bytes_ += line.size() + 1;
  readNames(line);
  if (stamp_ns_) return;  // the first line was a sample
  advance();
}

void ImuTable::readNames(const std::string& line)
{
  columns_ = {0, 1, 2, 3, 4, 5, 6};
  if (parseLine(line)) return;
  const std::size_t begin = line.find_first_not_of("# ");
  const auto names = cellsOf(std::string_view(line).substr(std::min(begin, line.size())));
  std::vector<std::optional<std::size_t>> found(columns_.size());
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const int role = roleOf(plainName(names[i]));
    if (role >= 0 && !found[static_cast<std::size_t>(role)])
      found[static_cast<std::size_t>(role)] = i;
  }
  for (std::size_t role = 0; role < found.size(); ++role)
  {
    if (!found[role])
      throw std::runtime_error(
          "'" + path_ +
          "': its first line is neither a sample (time, wx, wy, wz, ax, ay, az) nor "
          "names columns for all of these: '" +
          printable(line) + "'");
    columns_[role] = *found[role];
  }
}

bool ImuTable::parseLine(std::string_view line)
{
  const auto cells = cellsOf(line);
  const auto cell = [&](std::size_t role)
  { return columns_[role] < cells.size() ? cells[columns_[role]] : std::string_view(); };
  const auto stamp_ns = stampOf(cell(0));
  std::vector<double> values;
  for (std::size_t role = 1; role < columns_.size(); ++role)
    if (const auto value = parsed<double>(cell(role))) values.push_back(*value);
  if (!stamp_ns || values.size() != columns_.size() - 1) return false;
  stamp_ns_ = stamp_ns;
  values_ = std::move(values);
  return true;
}

// To the next line that is a sample.
void ImuTable::advance()
{
  stamp_ns_.reset();
  for (std::string line; !stamp_ns_ && readBoundedLine(in_, line);)
  {
    bytes_ += line.size() + 1;
    ++lines_;
    if (line.empty() || line.front() == '#') continue;
    if (!parseLine(line)) ++bad_;
  }
}

std::optional<std::int64_t> ImuTable::stamp() const
{
  if (stamp_ns_) return stamp_ns_;
  // The problem is reported at the end, when it is known how many lines it is about.
  return bad_ > 0 && !told_ ? std::optional<std::int64_t>(INT64_MAX) : std::nullopt;
}

NextRecorded ImuTable::take()
{
  if (!stamp_ns_)
  {
    told_ = true;
    return fileProblem(path_, "has " + std::to_string(bad_) + " lines that are no samples");
  }
  auto imu = makeImu(
      "imu", *stamp_ns_, Vec3(values_[0], values_[1], values_[2]),
      Vec3(values_[3], values_[4], values_[5]));
  ++taken_;
  advance();
  return mrpt::obs::CObservation::Ptr(imu);
}

TopicReport ImuTable::report() const
{
  return {"imu", "table", taken_ + bad_, taken_, "IMU, units as recorded"};
}

}  // namespace fastlio
