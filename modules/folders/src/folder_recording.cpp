// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "folder_recording.h"

#include "stamp_text.h"
#include <fastlio/math/statistics.h>
#include <fastlio/options/number_text.h>
#include <fastlio/options/split_text.h>
#include <fastlio/recordings/byte_source.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

bool isThere(const std::string& path)
{
  std::error_code error;
  return fs::exists(path, error);
}

/** A file for each stamp. */
std::vector<TimedFile> timed(
    const std::vector<std::string>& files, const std::vector<std::int64_t>& stamps,
    const std::string& times)
{
  if (files.size() != stamps.size())
    throw std::runtime_error(
        "has " + std::to_string(files.size()) + " clouds or samples, but '" + times + "' has " +
        std::to_string(stamps.size()) + " times");
  std::vector<TimedFile> timed_files;
  for (std::size_t i = 0; i < files.size(); ++i)
    timed_files.push_back({stamps[i], files[i]});
  std::stable_sort(
      timed_files.begin(), timed_files.end(),
      [](const TimedFile& a, const TimedFile& b) { return a.stamp_ns < b.stamp_ns; });
  return timed_files;
}

// KITTI leaves out files of lost frames and keeps their times: the name of a file is its number.
std::vector<TimedFile> timedByNumber(
    const std::vector<std::string>& files, const std::vector<std::int64_t>& stamps)
{
  std::vector<TimedFile> timed_files;
  for (const std::string& file : files)
  {
    const auto number = parsed<std::size_t>(fs::path(file).stem().string());
    if (!number || *number >= stamps.size())
      throw std::runtime_error("has no time for '" + file + "'");
    timed_files.push_back({stamps[*number], file});
  }
  return timed_files;
}

/** "R: nine numbers" and "T: three numbers" of KITTI's calibration. */
std::optional<Pose> kittiPose(const std::string& path)
{
  constexpr std::size_t kLargest = 65536;
  const std::string text = headOf(path, kLargest);
  const auto numbersBehind = [&](const std::string& name, std::size_t count)
  {
    std::vector<double> numbers;
    const std::size_t at = text.find(name);
    if (at == std::string::npos) return numbers;
    const std::string_view line = std::string_view(text).substr(at + name.size());
    for (const std::string_view word : splitAtBlanks(line.substr(0, line.find('\n')), count))
      if (const auto number = parsed<double>(word)) numbers.push_back(*number);
    return numbers;
  };
  const auto R = numbersBehind("R:", 9), p = numbersBehind("T:", 3);
  if (R.size() != 9 || p.size() != 3) return std::nullopt;
  Pose pose;
  for (int i = 0; i < 9; ++i)
    pose.R(i / 3, i % 3) = R[static_cast<std::size_t>(i)];
  pose.p = Vec3(p[0], p[1], p[2]);
  if (!(pose.R * pose.R.transpose()).isIdentity(1e-3)) return std::nullopt;
  return pose;
}

const std::string kWithoutTimes =
    "LiDAR, clouds without times of their points (docs/inputs.md explains how to make them)";

/** Where a folder keeps its clouds. */
std::string cloudsOf(const std::string& path)
{
  constexpr std::array<const char*, 9> kNames{"clouds", "scans",    "pcd", "pcds",  "lidar",
                                              "points", "velodyne", "bin", "frames"};
  if (!filesIn(path, {".pcd", ".bin"}).empty()) return path;
  for (const char* name : kNames)
    if (!filesIn(path + "/" + name, {".pcd", ".bin"}).empty()) return path + "/" + name;
  return "";
}

std::string tableOf(const std::string& path)
{
  for (const char* name : {"imu.csv", "imu.txt", "IMU.csv", "imu/imu.csv", "imu0/data.csv"})
    if (isThere(path + "/" + name)) return path + "/" + name;
  return "";
}

/** The file with a time for each cloud, if there is one. */
std::string timesOf(const std::string& path, const std::string& clouds)
{
  for (const std::string& folder : {clouds, path})
    for (const char* name :
         {"times.txt", "timestamps.txt", "timestamp.txt", "stamps.txt", "times.csv"})
      if (isThere(folder + "/" + name)) return folder + "/" + name;
  return "";
}

std::vector<std::string> stemsOf(const std::vector<std::string>& files)
{
  std::vector<std::string> stems;
  stems.reserve(files.size());
  for (const std::string& file : files)
    stems.push_back(fs::path(file).stem().string());
  return stems;
}

/** Clouds whose names are times, and the other files ("map.pcd"). */
struct NamedByTime
{
  std::vector<std::string> clouds, others;
  std::vector<std::int64_t> stamps;  //!< of the clouds
};

NamedByTime namedByTime(const std::vector<std::string>& files)
{
  const std::int64_t unit_ns = stampUnitOf(stemsOf(files), kCloudRhythm);
  NamedByTime named;
  for (const std::string& file : files)
  {
    const auto stamp = stampOf(fs::path(file).stem().string(), unit_ns);
    (stamp ? named.clouds : named.others).push_back(file);
    if (stamp) named.stamps.push_back(*stamp);
  }
  return named;
}

std::vector<std::string> notesOn(const std::vector<std::string>& without_time)
{
  if (without_time.empty()) return {};
  const std::size_t more = without_time.size() - 1;
  return {
      "Left out: '" + without_time.front() + "'" +
      (more > 0 ? " and " + std::to_string(more) + " more" : std::string()) +
      ", whose name is no time."};
}

/** The names count the clouds ("000123.bin"): they are no times. */
bool areNumbered(const std::vector<std::string>& files)
{
  constexpr std::int64_t kLargest = 100'000'000, kMostApart = 10;
  std::vector<std::int64_t> numbers, steps;
  for (const std::string& stem : stemsOf(files))
  {
    const auto number = parsed<std::int64_t>(stem);
    if (!number || *number < 0 || *number > kLargest) return false;
    numbers.push_back(*number);
  }
  std::sort(numbers.begin(), numbers.end());
  for (std::size_t i = 1; i < numbers.size(); ++i)
    steps.push_back(numbers[i] - numbers[i - 1]);
  return median(steps) < kMostApart;
}
}  // namespace

NextRecorded FolderRecording::next()
{
  TimedStream* first = nullptr;
  for (const auto& stream : streams_)
    if (stream->stamp() && (first == nullptr || *stream->stamp() < *first->stamp()))
      first = stream.get();
  if (first == nullptr) return EndOfRecording{};
  return first->take();
}

std::uint64_t FolderRecording::position() const
{
  std::uint64_t bytes = 0;
  for (const auto& stream : streams_)
    bytes += stream->bytes();
  return bytes;
}

std::vector<TopicReport> FolderRecording::topics() const
{
  std::vector<TopicReport> reports;
  for (const auto& stream : streams_)
    reports.push_back(stream->report());
  return reports;
}

bool isKittiDrive(const std::string& path)
{
  return isThere(path + "/velodyne_points/data") &&
         isThere(path + "/velodyne_points/timestamps.txt");
}

std::unique_ptr<RecordingReader> openKittiDrive(const std::string& path)
{
  const std::string velodyne = path + "/velodyne_points", oxts = path + "/oxts";
  std::vector<std::string> notes;
  // The calibration lies with the date, above its drives; the unit's frame is the vehicle's.
  std::optional<Pose> T_imu_velodyne;
  for (const std::string& folder : {path, path + "/.."})
    if (const auto T_velodyne_imu = kittiPose(folder + "/calib_imu_to_velo.txt"))
      T_imu_velodyne = T_velodyne_imu->inverse();
  notes.emplace_back(
      T_imu_velodyne ? "The pose of the LiDAR is that of calib_imu_to_velo.txt."
                     : "There is no calib_imu_to_velo.txt: the pose of the LiDAR is not known.");
  std::vector<std::unique_ptr<TimedStream>> streams;
  streams.push_back(cloudStream(
      "velodyne",
      timedByNumber(
          filesIn(velodyne + "/data", {".bin"}), stampsOfFile(velodyne + "/timestamps.txt")),
      kWithoutTimes, T_imu_velodyne));
  if (isThere(oxts + "/data"))
    streams.push_back(oxtsStream(
        timedByNumber(filesIn(oxts + "/data", {".txt"}), stampsOfFile(oxts + "/timestamps.txt"))));
  return std::make_unique<FolderRecording>(std::move(streams), std::move(notes));
}

bool isKittiSequence(const std::string& path)
{
  return isThere(path + "/times.txt") && !filesIn(path + "/velodyne", {".bin"}).empty() &&
         tableOf(path).empty();
}

std::unique_ptr<RecordingReader> openKittiSequence(const std::string& path)
{
  std::vector<std::unique_ptr<TimedStream>> streams;
  streams.push_back(cloudStream(
      "velodyne",
      timedByNumber(filesIn(path + "/velodyne", {".bin"}), stampsOfFile(path + "/times.txt")),
      "LiDAR, clouds that are motion compensated"));
  return std::make_unique<FolderRecording>(
      std::move(streams), std::vector<std::string>{"The benchmark has no inertial data."});
}

bool isCloudFolder(const std::string& path)
{
  const std::string clouds = cloudsOf(path);
  if (clouds.empty()) return false;
  if (!timesOf(path, clouds).empty()) return true;
  const NamedByTime named = namedByTime(filesIn(clouds, {".pcd", ".bin"}));
  return named.clouds.size() > named.others.size();
}

std::unique_ptr<RecordingReader> openCloudFolder(const std::string& path)
{
  const std::string clouds = cloudsOf(path), times = timesOf(path, clouds), table = tableOf(path);
  const auto files = filesIn(clouds, {".pcd", ".bin"});
  const NamedByTime named = times.empty() ? namedByTime(files) : NamedByTime{files, {}, {}};
  if (times.empty() && areNumbered(named.clouds))
    throw std::runtime_error(
        "holds clouds whose names are numbers and no times; put a file times.txt beside them, with "
        "the time of each cloud [s] in a line");
  std::vector<std::unique_ptr<TimedStream>> streams;
  streams.push_back(cloudStream(
      "lidar", timed(named.clouds, times.empty() ? named.stamps : stampsOfFile(times), times),
      "LiDAR; stamps from " + (times.empty() ? "the names of the files" : "'" + times + "'")));
  if (!table.empty()) streams.push_back(std::make_unique<ImuTable>(table));
  return std::make_unique<FolderRecording>(std::move(streams), notesOn(named.others));
}

// The extension is asked for, too: trajectories are tables of numbers as well.
bool isImuTable(const std::string& path)
{
  if (fs::path(path).extension() != ".csv" || headOf(path, 1).empty()) return false;
  try
  {
    return ImuTable(path).stamp().has_value();
  }
  catch (const std::runtime_error&)
  {
    return false;
  }
}

std::unique_ptr<RecordingReader> openImuTable(const std::string& path)
{
  std::vector<std::unique_ptr<TimedStream>> streams;
  streams.push_back(std::make_unique<ImuTable>(path));
  return std::make_unique<FolderRecording>(std::move(streams), std::vector<std::string>{});
}

}  // namespace fastlio
