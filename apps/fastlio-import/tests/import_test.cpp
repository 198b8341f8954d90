// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The program on recordings that the test writes, with good and bad arguments.

#include "import_fixture.h"
#include "rawlog_reading.h"
#include "ros2_writers.h"
#include <fastlio/compat/CPointsMapXYZIRT.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/gnss_accuracy.h>

#include <mrpt/core/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

namespace fastlio::testing
{
namespace
{
class ImportProgram : public ImportFixture
{
 protected:
  /** Seconds after the stamp of all points of the clouds of a rawlog. */
  static std::vector<float> timesOf(const std::string& rawlog)
  {
    std::vector<float> times;
    RawlogSource source({rawlog});
    while (const auto observation = source.next())
    {
      const auto cloud = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(observation);
      if (!cloud) continue;
      const auto map = std::dynamic_pointer_cast<mrpt::maps::CPointsMapXYZIRT>(cloud->pointcloud);
      EXPECT_TRUE(map);
      for (std::size_t i = 0; map && i < map->size(); ++i)
        times.push_back(map->getPointTime(i));
    }
    return times;
  }
};

TEST_F(ImportProgram, WritesTimesInSecondsWhateverTheyWere)
{
  std::vector<float> expected;
  for (const TimeField& time :
       {TimeField{"t", 6, 1e-9}, TimeField{"time", 7, 1.0}, TimeField{"offset_time", 6, 1e-6},
        TimeField{"timestamp", 8, 1.0, true}})
  {
    const auto result = import({file("in.bag", bagOf(messages(time))), "-o", out(), "--overwrite"});
    ASSERT_EQ(result.exit_status, 0) << result.output;
    EXPECT_TRUE(contains(result.output, "seconds after the stamp")) << result.output;
    const std::vector<float> times = timesOf(out());
    ASSERT_EQ(times.size(), 60U);
    for (std::size_t i = 0; i < times.size(); ++i)
      EXPECT_NEAR(times[i], i % 2 == 0 ? 0.0 : 0.1, time.absolute ? 1e-6 : 1e-8) << time.name;
  }
}

TEST_F(ImportProgram, WritesEveryCompression)
{
  const std::string bag = file("in.bag", bagOf(messages()));
  for (const char* compression : {"none", "gzip", "zstd"})
  {
    const auto result = import({bag, "-o", out(compression), "--compression", compression});
    ASSERT_EQ(result.exit_status, 0) << result.output;
    const Reading reading = readAll({out(compression)});
    EXPECT_TRUE(reading.problems.empty());
    EXPECT_EQ(reading.seconds.size(), messages().size());
    EXPECT_EQ(reading.labels[0].substr(0, 1), "/");
  }
}

TEST_F(ImportProgram, KeepsWhatAReceiverStatesOfItsAccuracy)
{
  auto all = messages();
  all.push_back(
      {"/fix", "sensor_msgs/NavSatFix", all.back().stamp_ns,
       navSatFixMessage(Wire::Ros1, all.back().stamp_ns, {0.25, 0, 0, 0, 4.0, 0, 0, 0, 9.0}, 2)});
  const auto result = import({file("in.bag", bagOf(all)), "-o", out()});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  RawlogSource source({out()});
  std::optional<Vec3> std;
  while (const auto observation = source.next())
    if (const auto gps = std::dynamic_pointer_cast<mrpt::obs::CObservationGPS>(observation))
      std = statedStdOf(*gps);
  ASSERT_TRUE(std);
  EXPECT_LT((*std - Vec3(0.5, 2.0, 3.0)).norm(), 1e-6);
}

TEST_F(ImportProgram, SplitsBySizeAndTimeWithoutLoss)
{
  const std::string bag = file("in.bag", bagOf(messages()));
  for (const char* option : {"--split-size", "--split-time"})
  {
    const std::string limit = std::string(option) == "--split-size" ? "0.02" : "1";
    const std::string name = std::string(option).substr(2);
    const auto result = import({bag, "-o", out(name + ".rawlog"), option, limit});
    ASSERT_EQ(result.exit_status, 0) << result.output;
    std::vector<std::string> parts;
    for (int i = 1;; ++i)
    {
      parts.push_back(out(mrpt::format("%s_%03i.rawlog", name.c_str(), i)));
      if (!std::filesystem::exists(parts.back())) break;
    }
    parts.pop_back();
    EXPECT_GE(parts.size(), 3U) << result.output;
    EXPECT_EQ(readAll(parts).seconds.size(), messages().size());
  }
}

// The first part is not there, but another one is, and it may be a recording of the user.
TEST_F(ImportProgram, NoPartReplacesAFileThatIsThere)
{
  const std::string bag = file("in.bag", bagOf(messages()));
  const std::string precious = file("day_002.rawlog", "precious");
  const auto refused = import({bag, "-o", out("day.rawlog"), "--split-time", "1"});
  EXPECT_EQ(refused.exit_status, 1) << refused.output;
  EXPECT_NE(refused.output.find(precious), std::string::npos) << refused.output;
  EXPECT_EQ(std::filesystem::file_size(precious), 8U);
  EXPECT_FALSE(std::filesystem::exists(out("day_001.rawlog")));
}

TEST_F(ImportProgram, TakesTheTopicsThatAreAskedFor)
{
  auto all = messages();
  const auto more = messages();
  for (TopicMessage message : more)
  {
    message.topic += "/second";
    all.push_back(std::move(message));
  }
  const std::string bag = file("in.bag", bagOf(all));
  const auto result =
      import({bag, "-o", out(), "--lidar-topic", "/lidar", "--imu-topic", "/imu/second"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  std::map<std::string, std::size_t> counts;
  for (const std::string& label : readAll({out()}).labels)
    ++counts[label];
  EXPECT_EQ(counts.size(), 2U);
  EXPECT_EQ(counts["/lidar"], 30U);
  EXPECT_EQ(counts["/imu/second"], more.size() - 30);
}

TEST_F(ImportProgram, ListTellsTopicsReasonsAndTimesAndWritesNothing)
{
  auto all = messages();
  all.push_back({"/camera", "sensor_msgs/Image", kStart, "pixels"});
  const auto result = import({file("in.bag", bagOf(all)), "--list"});
  ASSERT_EQ(result.exit_status, 0) << result.output;
  for (const char* text :
       {"bag of ROS 1", "/lidar", "sensor_msgs/PointCloud2", "30 messages, 30 taken", "/camera",
        "0 taken: not read", "ns after the stamp"})
    EXPECT_TRUE(contains(result.output, text)) << text << "\n" << result.output;
}

TEST_F(ImportProgram, ATruncatedInputIsWrittenAsFarAsItGoesWithStatusThree)
{
  const std::string whole = bagOf(messages(), {"none", 20, true});
  const auto result = import({file("cut.bag", whole.substr(0, whole.size() / 2)), "-o", out()});
  EXPECT_EQ(result.exit_status, 3) << result.output;
  EXPECT_TRUE(contains(result.output, "cut off")) << result.output;
  EXPECT_GT(readAll({out()}).seconds.size(), messages().size() / 4);
}

TEST_F(ImportProgram, UnitAndReferenceCanBeGiven)
{
  const std::string bag = file("in.bag", bagOf(messages({"t", 6, 1e-9})));
  const auto given =
      import({bag, "-o", out(), "--point-time-unit", "ns", "--point-time-reference", "end"});
  EXPECT_EQ(given.exit_status, 0) << given.output;
  EXPECT_NEAR(timesOf(out())[0], -0.1, 1e-8);
}

TEST_F(ImportProgram, CloudsWithoutTimesStayAsTheyAre)
{
  const auto result = import({file("in.bag", bagOf(messages({""}))), "-o", out()});
  EXPECT_EQ(result.exit_status, 0) << result.output;
  EXPECT_TRUE(contains(result.output, "written as recorded")) << result.output;
  EXPECT_EQ(readAll({out()}).seconds.size(), messages().size());
}

TEST_F(ImportProgram, RefusesWhatWouldDestroyOrCannotBe)
{
  const std::string bag = file("in.bag", bagOf(messages()));
  EXPECT_EQ(import({bag, "-o", bag}).exit_status, 1);
  EXPECT_EQ(import({bag, "-o", bag, "--overwrite"}).exit_status, 1);
  EXPECT_EQ(import({bag, bag, "-o", out()}).exit_status, 1);
  EXPECT_EQ(import({bag}).exit_status, 1);
  EXPECT_EQ(import({"-o", out()}).exit_status, 1);
  const auto missing = import({folder_.file("nothing.bag"), "-o", out()});
  EXPECT_EQ(missing.exit_status, 2) << "as of all programs that read recordings";
  EXPECT_TRUE(contains(missing.output, "nothing.bag' does not exist")) << missing.output;
  EXPECT_EQ(import({bag, "-o", out(), "--lidar-topic", "("}).exit_status, 1);
  const auto compression = import({bag, "-o", out(), "--compression", "lz4"});
  EXPECT_EQ(compression.exit_status, 1);
  EXPECT_TRUE(contains(compression.output, "must be gzip, none or zstd, not 'lz4'"))
      << compression.output;
  const auto ending = import({bag, "-o", out("out.bag")});
  EXPECT_EQ(ending.exit_status, 1);
  EXPECT_TRUE(contains(ending.output, "must end in .rawlog or .mcap")) << ending.output;
  EXPECT_FALSE(std::filesystem::exists(out("out.bag")));
  EXPECT_EQ(import({bag, "-o", out(), "--split-time", "-1"}).exit_status, 1);
  EXPECT_EQ(import({bag, "-o", "/nowhere/out.rawlog"}).exit_status, 1);
  EXPECT_FALSE(std::filesystem::exists(out()));
  write(out(), "somebody's");
  EXPECT_EQ(import({bag, "-o", out()}).exit_status, 1);
  std::ifstream in(out());
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "somebody's");
}

TEST_F(ImportProgram, InputsWithoutSensorsWriteNothing)
{
  const auto camera =
      import({file("in.bag", bagOf({{"/camera", "sensor_msgs/Image", kStart, "x"}})), "-o", out()});
  EXPECT_EQ(camera.exit_status, 2) << camera.output;
  const auto text = import({file("notes.txt", "no recording"), "-o", out()});
  EXPECT_EQ(text.exit_status, 2) << text.output;
  EXPECT_TRUE(contains(text.output, "docs/import.md")) << text.output;
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(ImportProgram, WritesMcapThatReadsBackToTheSameObservations)
{
  const std::string bag = file("in.bag", bagOf(messages()));
  ASSERT_EQ(import({bag, "-o", out("a.rawlog")}).exit_status, 0);
  const std::string poses =
      file("run.tum", "1700000000.100000000 1 2 3 0 0 0 1\n1700000000.200000000 4 5 6 0 0 0 1\n");
  const auto to = import({out("a.rawlog"), "-o", out("b.mcap"), "--trajectory", poses});
  ASSERT_EQ(to.exit_status, 0) << to.output;
  const auto list = import({out("b.mcap"), "--list"});
  for (const char* text :
       {"/odometry  nav_msgs/msg/Odometry: 2 messages", "pose in 'base_link'",
        "ns after the stamp"})
    EXPECT_TRUE(contains(list.output, text)) << text << "\n" << list.output;
  ASSERT_EQ(import({out("b.mcap"), "-o", out("c.rawlog")}).exit_status, 0);
  EXPECT_EQ(timesOf(out("c.rawlog")), timesOf(out("a.rawlog")));
  const Reading first = readAll({out("a.rawlog")}), second = readAll({out("c.rawlog")});
  EXPECT_EQ(first.seconds.size() + 2, second.seconds.size());  // and the two poses
}

TEST_F(ImportProgram, RefusesWhatMcapDoesNotHave)
{
  const std::string bag = file("in.bag", bagOf(messages()));
  EXPECT_EQ(import({bag, "-o", out("a.mcap"), "--split-time", "1"}).exit_status, 1);
  EXPECT_EQ(import({bag, "-o", out(), "--trajectory", bag}).exit_status, 1);
  EXPECT_EQ(import({bag, "-o", out("a.mcap"), "--trajectory", bag}).exit_status, 1);
  EXPECT_FALSE(std::filesystem::exists(out("a.mcap")));
}

TEST_F(ImportProgram, HelpNamesTheFormats)
{
  const auto result = import({"--help"});
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_TRUE(contains(result.output, "MCAP")) << result.output;
  EXPECT_EQ(import({"--version"}).exit_status, 0);
}

TEST_F(ImportProgram, ATopicThatNothingMatchesListsWhatThereIs)
{
  const std::string bag = file("in.bag", bagOf(messages()));
  for (const auto& [option, found] :
       {std::pair{"--lidar-topic", "'/lidar'"}, std::pair{"--imu-topic", "'/imu'"}})
  {
    const auto result = import({bag, "-o", out(), option, "rear"});
    EXPECT_EQ(result.exit_status, 2) << result.output;
    EXPECT_TRUE(contains(result.output, "'rear' matches no")) << result.output;
    EXPECT_TRUE(contains(result.output, found)) << result.output;
    EXPECT_FALSE(std::filesystem::exists(out()));
  }
}

}  // namespace
}  // namespace fastlio::testing
