// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Every way in which a rawlog can be broken: what is whole is delivered, what is wrong is reported.

#include "rawlog_reading.h"
#include <fastlio/compat/register_classes.h>

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <sys/resource.h>

namespace
{
using namespace fastlio::testing;
using fastlio::ReadProblem;
using fastlio::ReadProblemKind;

class RawlogDamageTest : public RawlogTest
{
};

// Where each object ends.
std::vector<std::size_t> endsOf(const std::vector<Object>& objects)
{
  std::vector<std::size_t> ends;
  ends.reserve(objects.size());
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

long peakKb()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}
}  // namespace

TEST_F(RawlogDamageTest, PlainFileCutAnywhereKeepsAllWholeObjects)
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
      EXPECT_NE(
          problem.message.find(": object " + std::to_string(wholeObjects(ends, length)) + " "),
          std::string::npos)
          << problem.message;
    }
  }
}

TEST_F(RawlogDamageTest, GzipFileCutAnywhereIsTruncated)
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

TEST_F(RawlogDamageTest, CutInsideAFrameSavesItsWholeObservations)
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

TEST_F(RawlogDamageTest, ABrokenObjectInTheMiddleCostsOnlyItself)
{
  const auto objects = samples(20);
  const auto ends = endsOf(objects);
  std::string bytes = serialize(objects);
  bytes[ends[9] - 1] = 'x';  // the end flag of object 9
  const Reading reading = readAll({fileOf(gzip(bytes))});
  EXPECT_EQ(reading.seconds.size(), 19U);
  ASSERT_EQ(reading.problems.size(), 1U);
  EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::Corrupt);
  EXPECT_NE(
      reading.problems[0].message.find(
          ": object 9 (mrpt::obs::CObservationIMU) at byte " + std::to_string(ends[8]) + ":"),
      std::string::npos)
      << reading.problems[0].message;
  EXPECT_EQ(reading.problems[0].class_name, "mrpt::obs::CObservationIMU");
}

TEST_F(RawlogDamageTest, AnySingleWrongByteCostsAtMostTwoObjects)
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

TEST_F(RawlogDamageTest, DamagedGzipIsCorruptAndKeepsWhatCameBefore)
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

TEST_F(RawlogDamageTest, NoiseNeverCrashes)
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

TEST_F(RawlogDamageTest, OtherFilesAreNotRawlogs)
{
  fastlio::registerBridgeClasses();
  const std::string map = serialize({mrpt::maps::CSimplePointsMap::Create()});
  for (const std::string& content :
       {std::string(), std::string("t x y z\n0 0 0 0\n"), std::string(5000, '\0'), gzip("text"),
        gzip(""), map})
  {
    const Reading reading = readAll({fileOf(content)});
    ASSERT_EQ(reading.problems.size(), 1U);
    EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::NotARawlog) << reading.problems[0].message;
    EXPECT_NE(reading.problems[0].message.find("log.rawlog"), std::string::npos);
  }
}

TEST_F(RawlogDamageTest, DamagedZstandardIsReported)
{
  const std::string bytes = zstd(serialize(samples(300)));
  for (const std::size_t at : {std::size_t{5}, bytes.size() / 2})
  {
    std::string wrong = bytes;
    wrong[at] = static_cast<char>(~wrong[at]);
    const Reading reading = readAll({fileOf(wrong)});
    ASSERT_FALSE(reading.problems.empty());
    EXPECT_EQ(reading.problems.back().kind, ReadProblemKind::Corrupt)
        << reading.problems.back().message;
  }
  const Reading cut = readAll({fileOf(bytes.substr(0, bytes.size() - 3))});
  ASSERT_EQ(cut.problems.size(), 1U);
  EXPECT_EQ(cut.problems[0].kind, ReadProblemKind::Truncated) << cut.problems[0].message;
}

TEST_F(RawlogDamageTest, UnknownClassesAreNamedCountedAndSkipped)
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

TEST_F(RawlogDamageTest, UnknownClassInsideAnObservationIsNamed)
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

TEST_F(RawlogDamageTest, ATailOfZerosIsTruncatedAndTheNextFileIsRead)
{
  const std::string first = folder_.file("first.rawlog"), second = folder_.file("second.rawlog");
  write(first, serialize(samples(20)));
  constexpr std::uintmax_t kZeros = 1'200'000'000;  // a hole: takes no room on the disk
  std::filesystem::resize_file(first, std::filesystem::file_size(first) + kZeros);
  write(second, serialize(samples(20)));
  const Reading reading = readAll({first, second});
  EXPECT_EQ(reading.seconds.size(), 40U);
  ASSERT_EQ(reading.problems.size(), 1U);
  EXPECT_EQ(reading.problems[0].kind, ReadProblemKind::Truncated);
  EXPECT_NE(
      reading.problems[0].message.find("1200000000 zeros, as after a loss of power"),
      std::string::npos)
      << reading.problems[0].message;
}

TEST_F(RawlogDamageTest, RunsOfOneByteTakeNoMemory)
{
  const std::string objects = serialize(samples(20));
  for (const char byte : {'\0', '\x88', '\xFF', '\x85', 'x'})
  {
    const std::string run = gzip(std::string(std::size_t{64} << 20U, byte));
    std::string bytes = gzip(objects);
    for (int i = 0; i < 2; ++i)
      bytes += run;
    const std::string file = fileOf(bytes + gzip(objects));
    const long before = peakKb();
    EXPECT_EQ(readAll({file}).seconds.size(), 40U) << static_cast<int>(byte);
    EXPECT_LT(peakKb() - before, 32L * 1024L) << static_cast<int>(byte);
  }
}

TEST_F(RawlogDamageTest, ALengthThatZerosFulfilTakesBoundedMemory)
{
  auto cloud = mrpt::obs::CObservationPointCloud::Create();
  cloud->sensorLabel = "lidar";
  cloud->pointcloud = mrpt::maps::CSimplePointsMap::Create();
  std::string head = serialize({cloud});
  const std::size_t count =
      head.find("CSimplePointsMap") + std::string("CSimplePointsMap").size() + 1;
  head.resize(count);
  head += std::string("\xFF\xFF\xFF\x0F", 4);  // 3.2 GB of points
  std::string bytes = gzip(head);
  const std::string zeros = gzip(std::string(std::size_t{64} << 20U, '\0'));
  for (int i = 0; i < 12; ++i)
    bytes += zeros;
  const std::string file = fileOf(gzip(serialize(samples(5))) + bytes);
  const long before = peakKb();
  const Reading reading = readAll({file});
  EXPECT_EQ(reading.seconds.size(), 5U);
  EXPECT_EQ(reading.problems.size(), 1U);
  EXPECT_LT(peakKb() - before, 600L * 1024L);
}
