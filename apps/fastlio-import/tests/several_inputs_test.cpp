// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Several inputs of the program: the parts of one recording, or recorded at the same time.

#include "import_fixture.h"
#include "rawlog_reading.h"
#include "ros2_writers.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>

namespace fastlio::testing
{
namespace
{
class SeveralInputs : public ImportFixture
{
};

TEST_F(SeveralInputs, SeveralInputsOfSeveralFormatsAreOneRecording)
{
  const auto all = messages();
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  const auto cdr = messages({}, Wire::Cdr);
  const auto result = import(
      {file("first.bag", bagOf({all.begin(), middle})),
       file("second.mcap", mcapOf({cdr.begin() + (middle - all.begin()), cdr.end()})), "-o",
       out()});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  EXPECT_EQ(readAll({out()}).seconds.size(), all.size());
}

/** Else the rawlog would go back in time in the middle. */
TEST_F(SeveralInputs, PartsThatDoNotFollowEachOtherAreRefused)
{
  const auto all = messages();
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  const std::string first = file("first.bag", bagOf({all.begin(), middle}));
  const std::string second = file("second.bag", bagOf({middle, all.end()}));
  const std::string whole = file("whole.bag", bagOf(all));
  const auto back = import({second, first, "-o", out()});
  EXPECT_EQ(back.exit_status, 1) << back.output;
  EXPECT_TRUE(contains(back.output, "in the order of time")) << back.output;
  const auto at_once = import({whole, second, "-o", out()});
  EXPECT_EQ(at_once.exit_status, 1) << at_once.output;
  EXPECT_TRUE(contains(at_once.output, "--merge")) << at_once.output;
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(SeveralInputs, ASecondSensorOfTheSameLabelGetsAnother)
{
  const std::string first = file("a.bag", bagOf(messages()));
  const std::string second = file("b.mcap", mcapOf(messages({}, Wire::Cdr)));
  const auto result = import({"--merge", first, second, "-o", out()});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  EXPECT_TRUE(contains(result.output, "b.mcap' is written as '/imu_2'")) << result.output;
  std::map<std::string, std::size_t> counts;
  for (const std::string& label : readAll({out()}).labels)
    ++counts[label];
  EXPECT_EQ(counts["/imu"], messages().size() - 30);
  EXPECT_EQ(counts["/imu_2"], counts["/imu"]);
  EXPECT_EQ(counts["/lidar"], 30U);
  EXPECT_EQ(counts["/lidar_2"], 30U);
  const auto chosen =
      import({"--merge", first, second, "-o", out(), "--overwrite", "--imu-topic", "/imu_2"});
  EXPECT_EQ(chosen.exit_status, 0) << chosen.output;
  EXPECT_FALSE(contains(chosen.output, "/imu:")) << chosen.output;
  const auto scans =
      import({"--merge", first, second, "-o", out(), "--overwrite", "--lidar-topic", "/lidar_2"});
  EXPECT_EQ(scans.exit_status, 0) << scans.output;
}

bool hasTemporaryFile(const std::string& folder)
{
  const std::filesystem::directory_iterator files(folder);
  return std::any_of(
      begin(files), end(files),
      [](const auto& entry) { return entry.path().extension() == ".tmp"; });
}

bool getsTemporaryFile(const std::string& folder)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!hasTemporaryFile(folder))
    if (std::chrono::steady_clock::now() > end) return false;
  return true;
}

TEST_F(SeveralInputs, AnInterruptionLeavesNothingBehind)
{
  const std::string bag = file("long.bag", bagOf(messagesOf(recording(3000), Wire::Ros1, {})));
  for (const int signal : {SIGINT, SIGTERM})
  {
    Process process({FASTLIO_IMPORT_PROGRAM, bag, "-o", out()}, folder_.file("log.txt"));
    ASSERT_TRUE(getsTemporaryFile(folder_.path()));
    process.signal(signal);
    const ProcessResult result = process.wait();
    EXPECT_EQ(result.exit_status, 130) << result.output;
    EXPECT_TRUE(contains(result.output, "nothing was written")) << result.output;
    EXPECT_FALSE(hasTemporaryFile(folder_.path()));
    EXPECT_FALSE(std::filesystem::exists(out()));
  }
}
}  // namespace
}  // namespace fastlio::testing
