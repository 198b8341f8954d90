// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Files beside the recording: maps, trajectories, what a recording names, labels, command lines.

#include "command_line.h"
#include "fuzz_targets.h"
#include "memory_file.h"
#include <fastlio/compat/register_classes.h>
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/options/label_pattern.h>
#include <fastlio/options/printable.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/savedmaps/saved_map_file.h>

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace fastlio::testing
{
namespace
{
namespace fs = std::filesystem;
using mrpt::obs::CObservationPointCloud;

std::string textOf(const std::uint8_t* data, std::size_t size)
{
  return {reinterpret_cast<const char*>(data), size};
}

/** A message is one or a few lines without control characters, whatever was read. */
void requirePrintable(const std::string& message)
{
  for (const char c : message)
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7F)
      throw std::logic_error("a message with a control character");
}

/** A folder for a recording and its external files, gone with the process. */
class RecordingFolder
{
 public:
  RecordingFolder()
      : path_(fs::temp_directory_path() / ("fastlio-fuzz-" + std::to_string(getpid())))
  {
    fs::create_directories(path_ / "log_Images");
  }
  ~RecordingFolder()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  RecordingFolder(const RecordingFolder&) = delete;
  RecordingFolder& operator=(const RecordingFolder&) = delete;

  [[nodiscard]] std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

void writeRecordingThatNames(const std::string& path, const std::string& name, unsigned format)
{
  CObservationPointCloud cloud;
  cloud.sensorLabel = "lidar";
  cloud.timestamp = mrpt::Clock::fromDouble(1.7e9);
  cloud.setAsExternalStorage(
      name, static_cast<CObservationPointCloud::ExternalStorageFormat>(1 + format % 3));
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream).WriteObject(cloud);
  std::ofstream(path, std::ios::binary)
      .write(
          static_cast<const char*>(stream.getRawBufferData()),
          static_cast<std::streamsize>(stream.getTotalBytesCount()));
}

/** Nothing of what a parser prints reaches the terminal. */
class Silence
{
 public:
  Silence() : out_(std::cout.rdbuf(sink_.rdbuf())), error_(std::cerr.rdbuf(sink_.rdbuf())) {}
  ~Silence()
  {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(error_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  std::ostringstream sink_;
  std::streambuf *out_, *error_;
};
}  // namespace

void fuzzMap(const std::uint8_t* data, std::size_t size)
{
  const MemoryFile file(data, size);
  try
  {
    if (loadSavedMap(file.path()).empty()) throw std::logic_error("an empty map was taken");
  }
  catch (const std::runtime_error& e)
  {
    requirePrintable(e.what());  // refused, with the reason
  }
}

void fuzzTrajectory(const std::uint8_t* data, std::size_t size)
{
  const MemoryFile file(data, size);
  try
  {
    const Trajectory trajectory = readTrajectory(file.path(), {{}, 10.0});
    if (trajectory.poses.empty()) throw std::logic_error("a trajectory without poses was taken");
  }
  catch (const std::runtime_error& e)
  {
    requirePrintable(e.what());
  }
}

void fuzzLabel(const std::uint8_t* data, std::size_t size)
{
  const std::string text = textOf(data, size);
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string label = end < text.size() ? text.substr(end + 1) : "lidar";
  requirePrintable(printable(label));
  try
  {
    const LabelPattern pattern("lidar", text.substr(0, end));
    (void)pattern.matches(label);
    // The same label, as long as a hostile one.
    std::string longer = label;
    while (!longer.empty() && longer.size() < 100'000)
      longer += longer;
    (void)pattern.matches(longer);
  }
  catch (const std::invalid_argument& e)
  {
    requirePrintable(e.what());
  }
}

void fuzzExternal(const std::uint8_t* data, std::size_t size)
{
  static const RecordingFolder folder;
  registerBridgeClasses();
  const std::string text = textOf(data, size);
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string name = text.substr(0, end);
  // The first character of the name chooses the format: an archive, KITTI (a dot) or text.
  for (const char* file : {"log_Images/own.bin", "log_Images/near.bin"})
    std::ofstream(folder.file(file), std::ios::binary)
        << (end < text.size() ? text.substr(end + 1) : "");
  writeRecordingThatNames(
      folder.file("log.rawlog"), name, name.empty() ? 0U : static_cast<unsigned char>(name[0]));
  RawlogSource source({folder.file("log.rawlog")});
  while (source.next())
  {
  }
  for (const ReadProblem& problem : source.problems())
    requirePrintable(problem.message);
}

void fuzzCommandLine(const std::uint8_t* data, std::size_t size)
{
  std::vector<std::string> words{"fastlio-replay"};
  std::istringstream lines(textOf(data, size));
  for (std::string line; std::getline(lines, line);)
    words.push_back(line.substr(0, line.find('\0')));
  std::vector<const char*> arguments;
  for (const std::string& word : words)
    arguments.push_back(word.c_str());
  const Silence silence;
  (void)parseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace fastlio::testing
