// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Files of bags that are compressed as a whole, and the order of the files of a folder.

#include "failure_message.h"
#include "file_size_limit.h"
#include "inflated_copy.h"
#include "recording_test_support.h"
#include "ros2_writers.h"

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

class CompressedBags : public RecordingTest
{
};

TEST_F(CompressedBags, FramesThatFollowEachOtherAreOneFile)
{
  const auto messages = smallRecording(Wire::Cdr, 5);
  const std::string whole = mcapOf(messages);
  const std::size_t half = whole.size() / 2;
  const std::string file =
      fileOf(zstd(whole.substr(0, half)) + zstd(whole.substr(half)), "walk.mcap.zstd");
  const Recorded bag = readRecording(file);
  EXPECT_EQ(bag.observations.size(), messages.size());
  EXPECT_TRUE(bag.problems.empty()) << bag.problems.front().message;
}

TEST_F(CompressedBags, MessagesNameTheFileAndNotItsCopy)
{
  const std::string whole = mcapOf(smallRecording(Wire::Cdr, 5));
  const std::string file = fileOf(zstd(whole.substr(0, whole.size() / 2)), "walk.mcap.zstd");
  const Recorded bag = readRecording(file);
  ASSERT_EQ(bag.problems.size(), 1U);
  EXPECT_EQ(bag.problems[0].file, file);
  EXPECT_EQ(bag.problems[0].message.rfind(file, 0), 0U) << bag.problems[0].message;
}

TEST_F(CompressedBags, AFullDiskIsNoDamageOfTheRecording)
{
  // Fewer bytes than the library's buffer: they are written when the file is closed.
  const std::string file = fileOf(zstd(std::string(3000, 'x')), "walk.mcap.zstd");
  const std::string message = failureOf(
      [&]
      {
        const FileSizeLimit limit(1000);
        const InflatedCopy copy(file);
      });
  EXPECT_TRUE(contains(message, "TMPDIR")) << message;
}

TEST_F(CompressedBags, PartsKeepTheirOrderWhereTheNameHoldsDots)
{
  const auto messages = smallRecording(Wire::Cdr, 4);
  const auto middle = messages.begin() + static_cast<std::ptrdiff_t>(messages.size() / 2);
  const std::string name = folder_.file("walk");
  std::filesystem::create_directory(name);
  write(name + "/2024.05.01_2.mcap", mcapOf({messages.begin(), middle}));
  write(name + "/2024.05.01_10.mcap.zstd", zstd(mcapOf({middle, messages.end()})));
  const Recorded bag = readRecording(name);
  ASSERT_EQ(bag.observations.size(), messages.size());
  for (std::size_t i = 0; i < messages.size(); ++i)
    EXPECT_EQ(toNanoseconds(bag.observations[i]->timestamp), messages[i].stamp_ns) << i;
}
}  // namespace
