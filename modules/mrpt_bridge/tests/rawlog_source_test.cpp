// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Reading rawlogs: all formats, and every way in which a file can be broken.

#include "test_files.h"
#include <fastlio/mrpt_bridge/conversions.h>
#include <fastlio/mrpt_bridge/rawlog_source.h>
#include <fastlio/mrpt_bridge/register_classes.h>
#include <fastlio/mrpt_bridge/xyzirt_access.h>

#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{
using namespace fastlio_test;
using fastlio::RawlogSource;
using fastlio::RawlogSourceOptions;
using fastlio::ReadProblem;
using fastlio::ReadProblemKind;

struct Reading
{
  std::vector<double> seconds;  // stamps since kStart
  std::vector<std::string> labels;
  std::vector<ReadProblem> problems;
};

Reading readAll(const std::vector<std::string>& files, RawlogSourceOptions options = {})
{
  RawlogSource source(files, options);
  Reading reading;
  while (const auto observation = source.next())
  {
    const auto ns = fastlio::toNanoseconds(observation->timestamp) - kStart;
    reading.seconds.push_back(std::round(static_cast<double>(ns) * 1e-6) / 1e3);
    reading.labels.push_back(observation->sensorLabel);
  }
  EXPECT_EQ(source.next(), nullptr);
  reading.problems = source.problems();
  return reading;
}

std::vector<Object> samples(int count)
{
  std::vector<Object> objects;
  for (int i = 0; i < count; ++i)
    objects.push_back(imuAt(0.005 * i));
  return objects;
}

// Where each object ends.
std::vector<std::size_t> endsOf(const std::vector<Object>& objects)
{
  std::vector<std::size_t> ends;
  for (const Object& object : objects)
    ends.push_back((ends.empty() ? 0 : ends.back()) + serialize({object}).size());
  return ends;
}

std::size_t wholeObjects(const std::vector<std::size_t>& ends, std::size_t length)
{
  return static_cast<std::size_t>(
      std::count_if(ends.begin(), ends.end(), [&](std::size_t end) { return end <= length; }));
}

void replaceAll(std::string& bytes, const std::string& from, const std::string& to)
{
  for (auto at = bytes.find(from); at != std::string::npos; at = bytes.find(from, at + 1))
    bytes.replace(at, from.size(), to);
}

class RawlogSourceTest : public testing::Test
{
 protected:
  std::string fileOf(const std::string& bytes)
  {
    const std::string name = folder_.file("log.rawlog");
    write(name, bytes);
    return name;
  }

  TemporaryFolder folder_;
};
}  // namespace

TEST_F(RawlogSourceTest, reads_plain_and_gzip)
{
  const std::string bytes = serialize(samples(10));
  for (const std::string& content :
       {bytes, gzip(bytes), gzip(bytes.substr(0, 700)) + gzip(bytes.substr(700))})
  {
    const Reading reading = readAll({fileOf(content)});
    EXPECT_EQ(reading.seconds.size(), 10U);
    EXPECT_TRUE(reading.problems.empty()) << reading.problems.front().message;
  }
}

TEST_F(RawlogSourceTest, takes_sensory_frames_apart_and_skips_actions)
{
  std::vector<Object> objects;
  for (int i = 0; i < 3; ++i)
  {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(imuAt(i, "a"));
    frame->insert(imuAt(i, "b"));
    objects.push_back(mrpt::obs::CActionCollection::Create());
    objects.push_back(frame);
  }
  const Reading reading = readAll({fileOf(gzip(serialize(objects)))});
  EXPECT_EQ(reading.labels, (std::vector<std::string>{"a", "b", "a", "b", "a", "b"}));
  EXPECT_TRUE(reading.problems.empty());
}

TEST_F(RawlogSourceTest, reads_files_in_the_order_given)
{
  write(folder_.file("1"), serialize({imuAt(0), imuAt(1)}));
  write(folder_.file("2"), gzip(serialize({imuAt(2), imuAt(3)})));
  const Reading reading = readAll({folder_.file("1"), folder_.file("2")});
  EXPECT_EQ(reading.seconds, (std::vector<double>{0, 1, 2, 3}));
}

TEST_F(RawlogSourceTest, a_missing_file_does_not_stop_the_next)
{
  write(folder_.file("2"), serialize({imuAt(2)}));
  const Reading reading = readAll({folder_.file("1"), folder_.path().string(), folder_.file("2")});
  EXPECT_EQ(reading.seconds.size(), 1U);
  ASSERT_EQ(reading.problems.size(), 2U);
  EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::NotFound);
  EXPECT_EQ(reading.problems[0].file, folder_.file("1"));
  EXPECT_EQ(reading.problems[1].kind, ReadProblemKind::NotFound);
}

TEST_F(RawlogSourceTest, sorts_within_the_window)
{
  const std::string file = fileOf(serialize(
      {imuAt(1.0, "a"), imuAt(1.1, "a"), imuAt(1.0, "b"), imuAt(0.95, "b"), imuAt(2.0, "a"),
       imuAt(0.5, "late"), imuAt(3.0, "a")}));
  EXPECT_EQ(readAll({file}).seconds, (std::vector<double>{0.95, 1.0, 1.0, 1.1, 0.5, 2.0, 3.0}));
  EXPECT_EQ(
      readAll({file}).labels, (std::vector<std::string>{"b", "a", "b", "a", "late", "a", "a"}));
  EXPECT_EQ(
      readAll({file}, {0.0, true}).seconds,
      (std::vector<double>{1.0, 1.1, 1.0, 0.95, 2.0, 0.5, 3.0}));
}

TEST_F(RawlogSourceTest, stamps_that_jump_back_or_make_no_sense_lose_nothing)
{
  auto objects = samples(50);
  for (int i = 0; i < 50; ++i)
    objects.push_back(imuAt(-3600 + 0.005 * i));
  objects.insert(objects.begin() + 20, imuAt(1e6));
  auto unset = imuAt(0);
  unset->timestamp = INVALID_TIMESTAMP;
  objects.insert(objects.begin() + 10, unset);
  auto absurd = imuAt(0);
  absurd->timestamp = mrpt::Clock::time_point::max();
  objects.push_back(absurd);
  EXPECT_EQ(readAll({fileOf(serialize(objects))}).seconds.size(), 103U);
}

TEST_F(RawlogSourceTest, memory_is_bounded_where_time_stands_still)
{
  std::vector<Object> objects(5000, imuAt(1.0));
  EXPECT_EQ(readAll({fileOf(gzip(serialize(objects)))}).seconds.size(), 5000U);
}

TEST_F(RawlogSourceTest, plain_file_cut_anywhere_keeps_all_whole_objects)
{
  const auto objects = samples(4);
  const auto ends = endsOf(objects);
  const std::string bytes = serialize(objects);
  for (std::size_t length = 1; length < bytes.size(); ++length)
  {
    const Reading reading = readAll({fileOf(bytes.substr(0, length))});
    EXPECT_EQ(reading.seconds.size(), wholeObjects(ends, length)) << length;
    const bool at_boundary = std::count(ends.begin(), ends.end(), length) > 0;
    EXPECT_EQ(reading.problems.size(), at_boundary ? 0U : 1U) << length;
    for (const ReadProblem& problem : reading.problems)
    {
      EXPECT_EQ(problem.kind, ReadProblemKind::Truncated) << length << problem.message;
      EXPECT_EQ(problem.object_index, wholeObjects(ends, length));
    }
  }
}

TEST_F(RawlogSourceTest, gzip_file_cut_anywhere_is_truncated)
{
  const auto objects = samples(40);
  const std::string bytes = gzip(serialize(objects));
  std::size_t most = 0;
  for (std::size_t length = 1; length < bytes.size(); ++length)
  {
    const Reading reading = readAll({fileOf(bytes.substr(0, length))});
    ASSERT_EQ(reading.problems.size(), 1U) << length;
    const ReadProblemKind kind = reading.problems[0].kind;
    EXPECT_TRUE(
        kind == ReadProblemKind::Truncated ||
        (reading.seconds.empty() && kind == ReadProblemKind::NotARawlog))
        << length << reading.problems[0].message;
    EXPECT_GE(reading.seconds.size(), most) << length;
    most = reading.seconds.size();
  }
  EXPECT_EQ(most, objects.size());  // only the trailer was missing
}

TEST_F(RawlogSourceTest, cut_inside_a_frame_saves_its_whole_observations)
{
  auto frame = mrpt::obs::CSensoryFrame::Create();
  for (int i = 0; i < 5; ++i)
    frame->insert(imuAt(0.01 * i));
  const std::string bytes = serialize({imuAt(-1), frame});
  const Reading reading = readAll({fileOf(bytes.substr(0, bytes.size() - 50))});
  EXPECT_EQ(reading.seconds.size(), 5U);
  ASSERT_FALSE(reading.problems.empty());
  EXPECT_EQ(reading.problems.back().kind, ReadProblemKind::Truncated);
}

TEST_F(RawlogSourceTest, a_broken_object_in_the_middle_costs_only_itself)
{
  const auto objects = samples(20);
  const auto ends = endsOf(objects);
  std::string bytes = serialize(objects);
  bytes[ends[9] - 1] = 'x';  // the end flag of object 9
  const Reading reading = readAll({fileOf(gzip(bytes))});
  EXPECT_EQ(reading.seconds.size(), 19U);
  ASSERT_EQ(reading.problems.size(), 1U);
  EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::Corrupt);
  EXPECT_EQ(reading.problems[0].object_index, 9U);
  EXPECT_EQ(reading.problems[0].byte_offset, ends[8]);
  EXPECT_EQ(reading.problems[0].class_name, "mrpt::obs::CObservationIMU");

  const Reading strict = readAll({fileOf(gzip(bytes))}, {0.2, false});
  EXPECT_EQ(strict.seconds.size(), 9U);
}

TEST_F(RawlogSourceTest, any_single_wrong_byte_costs_at_most_two_objects)
{
  const auto objects = samples(12);
  const std::string bytes = serialize(objects);
  std::mt19937 random(1);
  for (std::size_t at = 0; at < bytes.size(); ++at)
  {
    std::string wrong = bytes;
    wrong[at] = static_cast<char>(wrong[at] ^ static_cast<char>(1U << (random() % 8)));
    const Reading reading = readAll({fileOf(wrong)});
    EXPECT_GE(reading.seconds.size(), objects.size() - 2) << at;
  }
}

TEST_F(RawlogSourceTest, damaged_gzip_is_corrupt_and_keeps_what_came_before)
{
  const auto objects = samples(3000);
  const std::string bytes = gzip(serialize(objects));
  std::mt19937 random(2);
  int noticed = 0;
  for (int i = 0; i < 30; ++i)
  {
    std::string wrong = bytes;
    const std::size_t at = bytes.size() / 2 + random() % (bytes.size() / 4);
    wrong[at] = static_cast<char>(~wrong[at]);
    const Reading reading = readAll({fileOf(wrong)});
    EXPECT_GE(reading.seconds.size(), 1000U);
    noticed += reading.problems.empty() ? 0 : 1;
  }
  EXPECT_EQ(noticed, 30);  // at the latest by the checksum
}

TEST_F(RawlogSourceTest, noise_never_crashes)
{
  std::mt19937 random(3);
  const std::string bytes = serialize(samples(30));
  for (int i = 0; i < 100; ++i)
  {
    std::string wrong = bytes;
    for (int k = 0; k < 20; ++k)
      wrong[random() % wrong.size()] = static_cast<char>(random());
    readAll({fileOf(i % 2 == 0 ? wrong : gzip(wrong))});
  }
}

TEST_F(RawlogSourceTest, other_files_are_not_rawlogs)
{
  fastlio::registerBridgeClasses();
  const std::string map = serialize({mrpt::maps::CSimplePointsMap::Create()});
  for (const std::string& content :
       {std::string(), std::string("t x y z\n0 0 0 0\n"), std::string(5000, '\0'), gzip("text"),
        gzip(""), map, std::string("\x28\xB5\x2F\xFD zstd")})
  {
    const Reading reading = readAll({fileOf(content)});
    ASSERT_EQ(reading.problems.size(), 1U);
    EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::NotARawlog) << reading.problems[0].message;
    EXPECT_NE(reading.problems[0].message.find("log.rawlog"), std::string::npos);
  }
}

TEST_F(RawlogSourceTest, zstd_is_named)
{
  const Reading reading = readAll({fileOf("\x28\xB5\x2F\xFD.......")});
  ASSERT_EQ(reading.problems.size(), 1U);
  EXPECT_NE(reading.problems[0].message.find("zstd -d"), std::string::npos);
}

TEST_F(RawlogSourceTest, unknown_classes_are_named_counted_and_skipped)
{
  std::vector<Object> objects;
  for (int i = 0; i < 10; ++i)
  {
    objects.push_back(imuAt(i));
    objects.push_back(mrpt::obs::CObservationComment::Create());
  }
  std::string bytes = serialize(objects);
  replaceAll(bytes, "mrpt::obs::CObservationComment", "mrpt::obs::CObservationFutures");
  const Reading reading = readAll({fileOf(bytes)});
  EXPECT_EQ(reading.seconds.size(), 10U);
  ASSERT_EQ(reading.problems.size(), 1U);
  EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::UnknownClass);
  EXPECT_EQ(reading.problems[0].class_name, "mrpt::obs::CObservationFutures");
  EXPECT_EQ(reading.problems[0].occurrences, 10U);
  EXPECT_NE(reading.problems[0].message.find("newer"), std::string::npos);
}

TEST_F(RawlogSourceTest, unknown_class_inside_an_observation_is_named)
{
  auto cloud = mrpt::obs::CObservationPointCloud::Create();
  cloud->sensorLabel = "lidar";
  cloud->pointcloud = mrpt::maps::CSimplePointsMap::Create();
  std::string bytes = serialize({imuAt(0), cloud, imuAt(1)});
  replaceAll(bytes, "mrpt::maps::CSimplePointsMap", "mrpt::maps::CGenericxxxxxMap");
  const Reading reading = readAll({fileOf(bytes)});
  EXPECT_EQ(reading.seconds.size(), 2U);
  ASSERT_EQ(reading.problems.size(), 1U);
  EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::UnknownClass);
  EXPECT_EQ(reading.problems[0].class_name, "mrpt::maps::CGenericxxxxxMap");
}

TEST_F(RawlogSourceTest, external_clouds_are_loaded_from_beside_the_file)
{
  std::filesystem::create_directory(folder_.path() / "log_Images");
  const auto points = fastlio::makeXyzirt(fastlio::CloudColumns{{1}, {2}, {3}, {4}, {5}, {0.5F}});
  write((folder_.path() / "log_Images" / "scan.bin").string(), gzip(serialize({points})));
  const auto cloudIn = [](const std::string& file)
  {
    auto cloud = mrpt::obs::CObservationPointCloud::Create();
    cloud->timestamp = fastlio::toMrptTime(kStart);
    cloud->setAsExternalStorage(
        file, mrpt::obs::CObservationPointCloud::ExternalStorageFormat::MRPT_Serialization);
    return cloud;
  };
  RawlogSource source({fileOf(serialize({cloudIn("scan.bin"), cloudIn("gone.bin")}))});
  const auto read = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(source.next());
  ASSERT_TRUE(read && read->pointcloud) << source.problems().front().message;
  EXPECT_EQ(fastlio::readColumns(*read->pointcloud).time_s, std::vector<float>{0.5F});
  EXPECT_EQ(source.next(), nullptr);
  ASSERT_EQ(source.problems().size(), 1U);
  EXPECT_EQ(source.problems()[0].kind, ReadProblemKind::ExternalFile);
  EXPECT_NE(source.problems()[0].message.find("gone.bin"), std::string::npos);
}

TEST_F(RawlogSourceTest, progress_reaches_the_size_of_the_files)
{
  const std::string content = gzip(serialize(samples(1000)));
  RawlogSource source({fileOf(content)});
  EXPECT_EQ(source.progress().bytes_total, content.size());
  while (source.next())
  {
    EXPECT_LE(source.progress().bytes_read, content.size());
  }
  EXPECT_EQ(source.progress().bytes_read, content.size());
  EXPECT_EQ(source.progress().objects_read, 1000U);
  EXPECT_EQ(source.progress().observations_read, 1000U);
}

TEST(RawlogSourceOptions, are_checked)
{
  EXPECT_THROW(RawlogSource({}), std::invalid_argument);
  EXPECT_THROW(RawlogSource({"a"}, {-1.0, true}), std::invalid_argument);
}
