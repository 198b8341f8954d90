// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Lengths inside of objects are checked before MRPT allocates what they say.

#include "test_files.h"
#include "velodyne_packets.h"
#include <fastlio/archives/size_check.h>
#include <fastlio/compat/register_classes.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <gtest/gtest.h>
#include <mrpt/maps/CColouredPointsMap.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cstring>
#include <memory>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;

class SizeCheckTest : public ::testing::Test
{
 protected:
  SizeCheckTest() { registerBridgeClasses(); }

  SizeVerdict verdictOn(const std::string& bytes)
  {
    write(folder_.file("object"), bytes);
    ObjectStream stream(folder_.file("object"));
    stream.beginObject();
    return checkSizes(stream);
  }

  TemporaryFolder folder_;
};

mrpt::obs::CObservationVelodyneScan::Ptr scanWithCloud()
{
  auto scan = makeVlp16Scan({makePacket(0, 40, 0, 5000)});
  mrpt::obs::CObservationVelodyneScan::TGeneratePointCloudParameters everything;
  everything.generatePerPointTimestamp = true;
  everything.generatePerPointAzimuth = true;
  everything.generatePointsForLaserID = true;
  scan->generatePointCloud(everything);
  return scan;
}

mrpt::obs::CObservationPointCloud::Ptr observationOf(const mrpt::maps::CPointsMap::Ptr& cloud)
{
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  observation->sensorLabel = "lidar";
  observation->pointcloud = cloud;
  return observation;
}

// A sensory frame with one object.
std::string frameAround(const std::string& content)
{
  auto empty = serialize({mrpt::obs::CSensoryFrame::Create()});
  empty.resize(empty.size() - 5);  // without its count and its end flag
  return empty + std::string("\1\0\0\0", 4) + content + '\x88';
}

// Puts a length of 4 Gi - 1 at the given place.
std::string withHostileLength(std::string bytes, std::size_t at)
{
  const std::uint32_t hostile = 0xFFFFFFFFU;
  std::memcpy(bytes.data() + at, &hostile, sizeof hostile);
  return bytes;
}
}  // namespace

TEST_F(SizeCheckTest, EveryTruncationOfObservationsIsSeen)
{
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(imuAt(0));
  frame->insert(imuAt(1));
  for (const Object& object : std::vector<Object>{imuAt(0), frame, scanWithCloud()})
  {
    const std::string bytes = serialize({object});
    EXPECT_EQ(verdictOn(bytes), SizeVerdict::Plausible);
    for (std::size_t length = 40; length < bytes.size(); length += bytes.size() < 2000 ? 1 : 97)
      EXPECT_EQ(verdictOn(bytes.substr(0, length)), SizeVerdict::RunsOut) << length;
  }
}

TEST_F(SizeCheckTest, CloudsOfAllClassesArePlausible)
{
  const auto filled = [](const mrpt::maps::CPointsMap::Ptr& map)
  {
    map->resize(100);
    return map;
  };
  for (const auto& map : std::vector<mrpt::maps::CPointsMap::Ptr>{
           filled(mrpt::maps::CSimplePointsMap::Create()),
           filled(mrpt::maps::CPointsMapXYZI::Create()),
           filled(mrpt::maps::CColouredPointsMap::Create()),
           filled(mrpt::maps::CPointsMapXYZIRT::Create())})
  {
    const std::string bytes = serialize({observationOf(map)});
    EXPECT_EQ(verdictOn(bytes), SizeVerdict::Plausible) << map->GetRuntimeClass()->className;
    EXPECT_EQ(verdictOn(bytes.substr(0, 600)), SizeVerdict::RunsOut);
    // The number of points stands behind the class name and version.
    const std::string name = map->GetRuntimeClass()->className;
    EXPECT_EQ(
        verdictOn(withHostileLength(bytes, bytes.find(name) + name.size() + 1)),
        SizeVerdict::RunsOut);
  }
  EXPECT_EQ(verdictOn(serialize({observationOf(nullptr)})), SizeVerdict::Plausible);
}

TEST_F(SizeCheckTest, HostileLengthsAreSeenWhereverTheyAre)
{
  const std::string bytes = serialize({scanWithCloud()});
  const std::size_t label = bytes.find("lidar") - 4;
  const std::size_t pose_end = bytes.find("mrpt::poses::CPose3D") + 20 + 1 + 96 + 1;
  for (const std::size_t at : {label, pose_end, pose_end + 4 + 1206})
    EXPECT_EQ(verdictOn(withHostileLength(bytes, at)), SizeVerdict::RunsOut);
  std::string shifted = bytes;
  shifted.erase(pose_end + 100, 1);
  EXPECT_NE(verdictOn(shifted + "more of the file"), SizeVerdict::Plausible);
}

TEST_F(SizeCheckTest, FramesHoldObservationsAndCloudsHoldPoints)
{
  const std::string frame = frameAround(serialize({imuAt(0)}));
  EXPECT_EQ(verdictOn(frame), SizeVerdict::Plausible);
  EXPECT_EQ(verdictOn(frameAround(frame)), SizeVerdict::Misaligned);
  const std::string points = serialize({mrpt::maps::CSimplePointsMap::Create()});
  EXPECT_EQ(verdictOn(frameAround(points)), SizeVerdict::Misaligned);
  std::string cloud = serialize({observationOf(nullptr)});
  const std::string none = "\x87nullptr\x88";
  ASSERT_NE(cloud.rfind(none), std::string::npos);
  cloud.replace(cloud.rfind(none), none.size(), frame);
  EXPECT_EQ(verdictOn(cloud), SizeVerdict::Misaligned);
}

TEST_F(SizeCheckTest, ObjectsInObjectsEndAtSomeDepth)
{
  // Each sample stands where the one around it has its pose.
  const std::string sample = serialize({imuAt(0)});
  std::string nested;
  for (int i = 0; i < 12; ++i)
    nested += sample.substr(0, 1 + 26 + 1);
  EXPECT_EQ(verdictOn(nested + sample), SizeVerdict::Misaligned);
}

TEST_F(SizeCheckTest, OtherClassesAreLeftToMrpt)
{
  auto unknown_version = serialize({imuAt(0)});
  unknown_version[1 + 26] = 77;
  EXPECT_EQ(verdictOn(unknown_version), SizeVerdict::Plausible);
}
