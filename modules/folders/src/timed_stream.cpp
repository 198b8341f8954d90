// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "timed_stream.h"

#include "cloud_files.h"
#include <fastlio/options/printable.h>
#include <fastlio/recordings/cloud_builder.h>
#include <fastlio/sensors/conversions.h>

#include <algorithm>
#include <filesystem>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;
}  // namespace

ReadProblem fileProblem(const std::string& path, const std::string& what)
{
  return {path, ReadProblemKind::Corrupt, "", path + ": the file " + printable(what, 1000) + "."};
}

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

std::optional<std::int64_t> FileStream::stamp() const
{
  if (report_.messages == files_.size()) return std::nullopt;
  return files_[report_.messages].stamp_ns;
}

NextRecorded FileStream::take()
{
  const TimedFile& file = files_[report_.messages++];
  try
  {
    bytes_ += recordingBytes(file.path);
    auto observation = read_(file);
    ++report_.taken;
    return observation;
  }
  catch (const std::exception& e)
  {
    return fileProblem(file.path, e.what());
  }
}

std::unique_ptr<TimedStream> cloudStream(
    const std::string& label, std::vector<TimedFile> files, const std::string& reason,
    const std::optional<Pose>& pose)
{
  const auto read = [label, pose](const TimedFile& file)
  {
    const bool pcd = fs::path(file.path).extension() == ".pcd";
    auto cloud =
        makeCloud(pcd ? readPcdCloud(file.path) : readBinCloud(file.path), label, file.stamp_ns);
    if (pose) cloud->setSensorPose(toMrptPose(*pose));
    return cloud;
  };
  return std::make_unique<FileStream>(
      TopicReport{label, "files of clouds", 0, 0, reason}, std::move(files), read);
}

}  // namespace fastlio
