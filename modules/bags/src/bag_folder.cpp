// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bag_folder.h"

#include "db3_file.h"
#include "mcap_file.h"

#include <algorithm>
#include <filesystem>

namespace fastlio
{
namespace
{
namespace fs = std::filesystem;

/** The number at the end of "NAME_12.db3"; -1: there is none. */
long numberAtEnd(const std::string& stem)
{
  const std::size_t digits = stem.find_last_not_of("0123456789") + 1;
  constexpr std::size_t kMostDigits = 9;
  if (digits == stem.size() || stem.size() - digits > kMostDigits) return -1;
  return std::stol(stem.substr(digits));
}

bool isBagPart(const std::string& path)
{
  return isMcap(path) || isDb3(path) || isCompressedBag(path);
}

std::vector<std::string> bagFilesOf(const std::string& path)
{
  constexpr std::size_t kMostEntries = 100'000;
  std::vector<std::string> files;
  std::error_code error;
  if (!fs::is_directory(path, error))
  {
    if (isCompressedBag(path)) files.push_back(path);
    return files;
  }
  std::size_t entries = 0;
  for (fs::directory_iterator it(path, error), end; !error && it != end && entries < kMostEntries;
       it.increment(error), ++entries)
    if (isBagPart(it->path().string())) files.push_back(it->path().string());
  std::sort(
      files.begin(), files.end(),
      [](const std::string& a, const std::string& b)
      {
        const auto stem = [](const std::string& file)
        {
          fs::path name = fs::path(file).filename();
          if (name.extension() == ".zstd") name = name.stem();
          return name.stem().string();  // a name may hold further dots: a date
        };
        const long number_a = numberAtEnd(stem(a)), number_b = numberAtEnd(stem(b));
        return number_a != number_b ? number_a < number_b : a < b;
      });
  return files;
}
}  // namespace

bool isCompressedBag(const std::string& path)
{
  const std::string head = inflatedHeadOf(path, sqliteMagic().size());
  return head == sqliteMagic() || head.substr(0, mcapMagic().size()) == mcapMagic();
}

bool isBagFolder(const std::string& path)
{
  std::error_code error;
  return fs::is_directory(path, error) && !bagFilesOf(path).empty();
}

BagFolder::BagFolder(const std::string& path) : files_(bagFilesOf(path))
{
  if (files_.empty()) throw std::runtime_error("holds no files of a ROS 2 bag");
}

std::optional<ReadProblem> BagFolder::openNext()
{
  const std::string& file = files_[next_++];
  if (next_ > 1) bytes_before_ += recordingBytes(files_[next_ - 2]);
  if (file_)
    for (const RosTopic* topic : file_->topics())
      topics_.emplace(topic->name, *topic);
  file_.reset();
  try
  {
    std::string readable = file;
    if (isCompressedBag(file))
    {
      copy_ = std::make_unique<InflatedCopy>(file);
      readable = copy_->path();
    }
    if (isMcap(readable))
      file_ = std::make_unique<McapFile>(readable, file);
    else
      file_ = std::make_unique<Db3File>(readable, file);
    if (leave_out_) file_->leaveOutUnwanted();
    return std::nullopt;
  }
  catch (const std::exception& e)
  {
    return ReadProblem{file, ReadProblemKind::Corrupt, "", file + ": the file " + e.what() + "."};
  }
}

NextMessage BagFolder::next(const TopicFilter& wanted)
{
  for (;;)
  {
    if (file_)
    {
      NextMessage next = file_->next(wanted);
      if (!std::holds_alternative<EndOfRecording>(next)) return next;
    }
    if (next_ == files_.size()) return EndOfRecording{};
    if (auto problem = openNext()) return std::move(*problem);
  }
}

// Files behind the first one may have more.
bool BagFolder::listsAllTopics() const
{
  return files_.size() == 1 && file_ && file_->listsAllTopics();
}

void BagFolder::leaveOutUnwanted()
{
  leave_out_ = true;
}

std::uint64_t BagFolder::position() const
{
  return bytes_before_ + (file_ ? file_->position() : 0);
}

std::vector<const RosTopic*> BagFolder::topics() const
{
  std::vector<const RosTopic*> topics;
  for (const auto& [name, topic] : topics_)
    topics.push_back(&topic);
  if (!file_) return topics;
  for (const RosTopic* topic : file_->topics())
    topics.push_back(topic);
  return topics;
}

}  // namespace fastlio
