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

}  // namespace fastlio
