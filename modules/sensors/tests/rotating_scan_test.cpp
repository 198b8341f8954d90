// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Rotating scans in both layouts of their stream, with points of their own and with ranges only.

#include "bridge_recording.h"
#include "failure_message.h"
#include "rawlog_reading.h"
#include "rotating_scans.h"
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/sensors/rotating_scan.h>

#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;
class RotatingScanTest : public BridgeTest
{
 protected:
  std::vector<mrpt::obs::CObservation::Ptr> readAll(const std::string& bytes)
  {
    const std::string file = folder_.file("rotating.rawlog");
    write(file, bytes);
    RawlogSource source({file});
    std::vector<mrpt::obs::CObservation::Ptr> all;
    while (auto observation = source.next())
      all.push_back(observation);
    problems_ = source.problems();
    return all;
  }

  std::shared_ptr<Scan> readOne(const std::string& bytes)
  {
    const auto all = readAll(bytes);
    return all.empty() ? nullptr : std::dynamic_pointer_cast<Scan>(all.front());
  }

  std::vector<ReadProblem> problems_;
};

void expectRanges(const Scan& scan)
{
  EXPECT_EQ(scan.sensorLabel, "lidar");
  EXPECT_EQ(scan.lidarModel, "VLP-16");
  EXPECT_EQ(scan.sensorPose.z(), 3.0);
  ASSERT_EQ(scan.rangeImage.rows(), kRows);
  ASSERT_EQ(scan.rangeImage.cols(), kColumns);
  EXPECT_EQ(scan.rangeImage(15, 99), 2500);
  EXPECT_EQ(scan.rangeImage(3, 7), 0);
  EXPECT_EQ(scan.intensityImage(2, 42), 42);
  EXPECT_EQ(scan.rangeOtherLayers.count("LAST"), 1U);
}
}  // namespace

TEST_F(RotatingScanTest, BothLayoutsAreRead)
{
  const auto original = rangeScan();
  for (const std::string& bytes : {before2_11_4(*original), since2_11_4(*original)})
  {
    const auto scan = readOne(bytes + bytes);  // and what follows is found
    ASSERT_TRUE(scan);
    EXPECT_TRUE(problems_.empty()) << problems_.front().message;
    expectRanges(*scan);
    EXPECT_EQ(readAll(bytes + bytes).size(), 2U);
  }
}

TEST_F(RotatingScanTest, OwnPointsGoThroughWithTheTimesOfTheirColumns)
{
  const auto scan = readOne(since2_11_4(*rangeScan()));
  ASSERT_TRUE(scan);
  const RotatingScanPoints read = pointsOf(*scan);
  EXPECT_TRUE(read.has_point_times);
  EXPECT_EQ(read.no_return, 16U);
  ASSERT_EQ(read.points.size(), std::size_t{kRows} * (kColumns - 1));
  const std::size_t last = read.points.size() - 1;
  EXPECT_NEAR(read.points.x[last], 5.0 * std::cos(0.06 * 99), 1e-5);
  EXPECT_NEAR(read.points.z[last], 1.5, 1e-6);
  EXPECT_EQ(read.points.time_offset_ns[last], 99'000'000);
  EXPECT_EQ(read.points.intensity[last], 99.0F);
  EXPECT_EQ(read.points.ring[last], 15);
  EXPECT_EQ(read.points.time_offset_ns[0], 0);
}

TEST_F(RotatingScanTest, RangesOfKnownModelsBecomePoints)
{
  const auto scan = readOne(before2_11_4(*rangeScan()));
  ASSERT_TRUE(scan);
  const RotatingScanPoints read = pointsOf(*scan);
  EXPECT_EQ(read.no_return, 16U);
  ASSERT_EQ(read.points.size(), std::size_t{kRows} * (kColumns - 1));
  // Laser 1 of the VLP-16 looks 1 degree up and fires 2.304 us after laser 0.
  const double azimuth = 0.5 + 60.0 * 2.304e-6, elevation = 0.017453292519943295;
  EXPECT_NEAR(read.points.x[1], 5.0 * std::cos(elevation) * std::cos(azimuth), 1e-4);
  EXPECT_NEAR(read.points.y[1], -5.0 * std::cos(elevation) * std::sin(azimuth), 1e-4);
  EXPECT_NEAR(read.points.z[1], 5.0 * std::sin(elevation), 1e-3);
  EXPECT_EQ(read.points.time_offset_ns[1], 2304);
  EXPECT_EQ(read.points.time_offset_ns[16], 1'000'000);
}

TEST_F(RotatingScanTest, ADurationThatNoSweepHasGivesNoTimes)
{
  for (const double duration : {-1.0, 0.0, 3.0, 1e9, std::numeric_limits<double>::infinity()})
  {
    auto scan = rangeScan();
    scan->sweepDuration = duration;
    const RotatingScanPoints read = pointsOf(*scan);
    EXPECT_FALSE(read.has_point_times) << duration;
    ASSERT_EQ(read.points.size(), std::size_t{kRows} * (kColumns - 1));
    EXPECT_EQ(read.points.time_offset_ns.back(), 0) << duration;
    EXPECT_TRUE(std::isfinite(read.points.x.back())) << duration;
    EXPECT_FALSE(select({scan, imuAt(0)}).lidar.times_by_sensor) << duration;
  }
}

TEST_F(RotatingScanTest, ImagesOfAnySizeInAnotherFileAreRefused)
{
  std::string bytes = properties(*rangeScan()) + '\2';   // as text
  bytes.replace(bytes.find("lidar") + 5, 4, 4, '\xFF');  // rows and columns
  const std::string name = "scan.txt";
  put(bytes, static_cast<std::uint32_t>(name.size()));
  EXPECT_FALSE(readOne(bytes + name + '\x88'));
  ASSERT_EQ(problems_.size(), 1U);
  EXPECT_EQ(problems_[0].kind, ReadProblemKind::Corrupt);
  EXPECT_TRUE(contains(problems_[0].message, "65535")) << problems_[0].message;
}

TEST_F(RotatingScanTest, ColumnsThatMrptLeavesEmptyTakeNoTime)
{
  auto scan = rangeScan();
  mrpt::math::CMatrix_u16 wide(kRows, kColumns * kRows);
  wide.setZero(kRows, kColumns * kRows);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      wide(row, column) = 2500;
  scan->rangeImage = wide;
  scan->columnCount = kColumns * kRows;
  const RotatingScanPoints read = pointsOf(*scan);
  EXPECT_EQ(read.points.size(), std::size_t{kRows} * kColumns);
  EXPECT_NEAR(read.points.time_offset_ns.back(), 99'000'000, 50'000);
}

TEST_F(RotatingScanTest, WhatHasNoPointsSaysWhy)
{
  const auto errorOf = [](const Scan& scan)
  { return failureOf<std::runtime_error>([&] { (void)pointsOf(scan); }); };
  auto scan = rangeScan();
  scan->lidarModel = "OS1-16";
  EXPECT_TRUE(contains(errorOf(*scan), "elevations are not known")) << errorOf(*scan);
  scan->rowCount = 1;
  scan->rangeImage.setZero(1, kColumns);
  EXPECT_TRUE(contains(errorOf(*scan), "2D LiDAR"));
  scan->rangeImage.resize(0, 0);
  EXPECT_TRUE(contains(errorOf(*scan), "neither points nor a range image"));
}

TEST_F(RotatingScanTest, EveryTruncationAndHostileSizesAreProblems)
{
  const auto original = rangeScan();
  for (const std::string& bytes : {before2_11_4(*original), since2_11_4(*original)})
  {
    for (std::size_t length = 40; length < bytes.size(); length += 997)
    {
      EXPECT_EQ(readAll(bytes.substr(0, length)).size(), 0U);
      EXPECT_EQ(problems_.size(), 1U) << length;
    }
    std::string hostile = bytes;  // the intensity image claims 4 G pixels
    const std::size_t at = properties(*original).size() +
                           (bytes.size() > before2_11_4(*original).size() ? 1 : 0) + 4 +
                           std::size_t{2} * kRows * kColumns;
    hostile.replace(at, 4, "\xFF\xFF\xFF\xFF");
    EXPECT_EQ(readAll(hostile).size(), 0U);
    EXPECT_FALSE(problems_.empty());
  }
}

TEST_F(RotatingScanTest, TheForeignLayoutIsSavedFromFrames)
{
  mrpt::obs::CSensoryFrame frame;
  frame.insert(imuAt(0));
  frame.insert(rangeScan());
  std::string bytes = serialize({std::make_shared<mrpt::obs::CSensoryFrame>(frame)});
  const std::string native = serialize({rangeScan()});
  const auto at = bytes.find(native);
  ASSERT_NE(at, std::string::npos);
#if FASTLIO_MRPT_HAS_ROTATING_POINTS
  bytes.replace(at, native.size(), before2_11_4(*rangeScan()));
#else
  bytes.replace(at, native.size(), since2_11_4(*rangeScan()));
#endif
  EXPECT_EQ(readAll(bytes + bytes).size(), 4U);
  EXPECT_EQ(problems_.size(), 1U);
}

TEST_F(RotatingScanTest, ServesAsALidar)
{
  auto first = rangeScan();
  const auto selection = select({first, imuAt(0)});
  EXPECT_TRUE(contains(selection.lidar.detail, "VLP-16, 16 rows"));
  EXPECT_TRUE(selection.lidar.times_by_sensor);
  ObservationBridge bridge(selection);
  const auto scan = std::get<LidarScan>(bridge.convert(*first));
  EXPECT_TRUE(scan.has_point_times);
  EXPECT_EQ(scan.points.size(), std::size_t{kRows} * (kColumns - 1));
  EXPECT_TRUE(scan.T_imu_lidar.p.isApprox(Vec3(1, 2, 3), 1e-9));
  EXPECT_EQ(bridge.statistics().points_no_return, 16U);
}

#if !FASTLIO_MRPT_HAS_ROTATING_POINTS
TEST_F(RotatingScanTest, ImagesInFilesOfTheirOwnAreLoaded)
{
  const auto original = rangeScan();
  const std::string folder = folder_.file("rotating_Images");
  std::filesystem::create_directory(folder);
  write(folder + "/scan.bin", gzip(images(*original) + points()));
  write(folder + "/scan.txt", "1 2 3 500 40 3 5\n4 5 6 600 41 15 99\n");
  for (const auto& [format, name] :
       {std::pair<char, std::string>{1, "scan.bin"}, {2, "scan.txt"}, {1, "lost.bin"}})
  {
    std::string bytes = properties(*original) + format;
    put(bytes, static_cast<std::uint32_t>(name.size()));
    const auto scan = readOne(bytes + name + '\x88');
    if (name == "lost.bin")
    {
      EXPECT_FALSE(scan);
      ASSERT_EQ(problems_.size(), 1U);
      EXPECT_EQ(problems_[0].kind, ReadProblemKind::ExternalFile);
      continue;
    }
    ASSERT_TRUE(scan) << name;
    EXPECT_TRUE(problems_.empty());
    EXPECT_EQ(pointsOf(*scan).points.size(), format == 1 ? 1584U : 2U);
    if (format == 1) expectRanges(*scan);
  }
}
#endif
