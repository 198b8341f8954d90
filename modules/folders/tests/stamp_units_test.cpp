// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What numbers in files and names of files count.

#include "cloud_files.h"
#include "failure_message.h"
#include "recording_test_support.h"
#include "stamp_text.h"

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

std::int64_t unitOf(std::int64_t first, std::int64_t step, const StampRhythm& rhythm)
{
  std::vector<std::string> texts;
  for (int i = 0; i < 50; ++i)
    texts.push_back(std::to_string(first + i * step));
  return stampUnitOf(texts, rhythm);
}

TEST(StampUnits, DatesAndClocksSinceAnythingElseAreTold)
{
  for (const std::int64_t unit : {std::int64_t{1}, std::int64_t{1000}, std::int64_t{1'000'000}})
    for (const std::int64_t seconds : {0, 100, 5000, 1'700'000'000})
    {
      const std::int64_t first = seconds * (kSecondNs / unit);
      EXPECT_EQ(unitOf(first, 5'000'000 / unit, kSampleRhythm), unit) << seconds;
      EXPECT_EQ(unitOf(first, 100'000'000 / unit, kCloudRhythm), unit) << seconds;
    }
  EXPECT_EQ(unitOf(1'700'000'000, 1, kCloudRhythm), kSecondNs);
  EXPECT_EQ(stampUnitOf({"0", "0.1", "0.2", "1"}, kCloudRhythm), kSecondNs);
  EXPECT_EQ(stampUnitOf({"no", "times"}, kCloudRhythm), kSecondNs);
}

TEST(StampUnits, NumbersAreExactInEveryUnit)
{
  EXPECT_EQ(stampOf("1234.5", 1'000'000), 1'234'500'000);
  EXPECT_EQ(stampOf("1700000000.123456789", kSecondNs), 1'700'000'000'123'456'789);
  EXPECT_FALSE(stampOf("4500000000", kSecondNs));
}

class TablesOfSamples : public RecordingTest
{
 protected:
  /** The stamps of a table whose first line is \a names [ns]. */
  std::vector<std::int64_t> stampsOf(const std::string& names, const std::string& samples)
  {
    std::vector<std::int64_t> stamps;
    const Recorded table = readRecording(fileOf(names + samples, "imu.csv"));
    EXPECT_TRUE(table.problems.empty());
    for (const auto& observation : table.observations)
      stamps.push_back(toNanoseconds(observation->timestamp));
    return stamps;
  }
};

TEST_F(TablesOfSamples, TheNameOfTheColumnGivesTheUnit)
{
  const std::string axes = ",wx,wy,wz,ax,ay,az\n", zeros = ",0,0,0,0,0,0\n";
  const std::string two = "5000000" + zeros + "6000000" + zeros;
  using Stamps = std::vector<std::int64_t>;
  EXPECT_EQ(stampsOf("timestamp [ns]" + axes, two), (Stamps{5'000'000, 6'000'000}));
  EXPECT_EQ(stampsOf("time_us" + axes, two), (Stamps{5'000'000'000, 6'000'000'000}));
  EXPECT_EQ(stampsOf("time (ms)" + axes, two), (Stamps{5'000'000'000'000, 6'000'000'000'000}));
  EXPECT_EQ(stampsOf("t" + axes, two), (Stamps{5'000'000, 6'000'000}));  // by the step
  // A name that cannot be right is not believed.
  EXPECT_EQ(
      stampsOf("timestamp [s]" + axes, "1700000000100000000" + zeros),
      (Stamps{1'700'000'000'100'000'000}));
}

TEST_F(TablesOfSamples, ACountSinceTheStartOfTheMachineKeepsItsUnit)
{
  std::string samples;
  for (int i = 0; i < 4; ++i)  // around 4.5e9, where the size of the numbers says another unit
    samples += std::to_string(4'490'000'000 + i * 5'000'000LL) + ",0,0,0,0,0,0\n";
  const auto stamps = stampsOf("", samples);
  ASSERT_EQ(stamps.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(stamps[i], 4'490'000'000 + static_cast<std::int64_t>(i) * 5'000'000);
}

TEST_F(TablesOfSamples, SecondsAndNanosecondsMayBeTwoColumns)
{
  const auto stamps = stampsOf(
      "sec,nanosec,wx,wy,wz,ax,ay,az\n",
      "1700000000,995000000,0,0,0,0,0,0\n1700000001,0,0,0,0,0,0,0\n");
  EXPECT_EQ(
      stamps, (std::vector<std::int64_t>{1'700'000'000'995'000'000, 1'700'000'001'000'000'000}));
}

class NamesOfClouds : public RecordingTest
{
 protected:
  void put(const std::string& name)
  {
    std::filesystem::create_directories(folder_.file("walk"));
    write(folder_.file("walk/" + name), std::string(16, '\0'));
  }
};

TEST_F(NamesOfClouds, NumbersOfCloudsAreNoTimes)
{
  for (const char* name : {"000000.bin", "000001.bin", "000003.bin"})
    put(name);
  const std::string refusal = failureOf([&] { (void)readRecording(folder_.file("walk")); });
  EXPECT_TRUE(contains(refusal, "times.txt")) << refusal;
  write(folder_.file("walk/times.txt"), "0.0\n0.1\n0.3\n");
  EXPECT_EQ(readRecording(folder_.file("walk")).count("lidar"), 3U);
}

TEST_F(NamesOfClouds, AllNamesHaveOneUnit)
{
  for (const char* name : {"4400000000.bin", "4500000000.bin", "4600000000.bin"})  // ns
    put(name);
  const Recorded walk = readRecording(folder_.file("walk"));
  ASSERT_EQ(walk.observations.size(), 3U);
  EXPECT_EQ(toNanoseconds(walk.observations[2]->timestamp), 4'600'000'000);
}

class AsciiClouds : public RecordingTest
{
 protected:
  static std::string headOf(const std::string& sizes, const std::string& counts)
  {
    return "VERSION 0.7\nFIELDS x y z\nSIZE " + sizes + "\nTYPE F F F\nCOUNT " + counts +
           "\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n";
  }
  CloudColumns read(const std::string& bytes) { return readPcdCloud(fileOf(bytes, "cloud.pcd")); }
};

TEST_F(AsciiClouds, BlankLinesAreNoPoints)
{
  const auto cloud = read(headOf("4 4 4", "1 1 1") + "\n1 2 3\n \r\n4 5 6\n\n");
  EXPECT_EQ(cloud.x, (std::vector<float>{1, 4}));
}

TEST_F(AsciiClouds, LinesAndSizesThatAreNoneAreRefused)
{
  const std::string points = "1 2 3\n4 5 6\n";
  EXPECT_EQ(read(headOf("4 4 4", "1 1 1") + points).x.size(), 2U);
  EXPECT_THROW((void)read(headOf("4 4 4", "1 1 1") + "1 2 3\n4 5\n"), std::runtime_error);
  EXPECT_THROW((void)read(headOf("4 4 4", "1 1 2") + points), std::runtime_error);
  for (const char* sizes : {"4 4 3", "4 4 0", "4 4 16"})
    EXPECT_THROW((void)read(headOf(sizes, "1 1 1") + points), std::runtime_error) << sizes;
  EXPECT_THROW((void)read(headOf("4 4 4", "1 1 0") + points), std::runtime_error);
}
}  // namespace
