// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// A simulated recording in every format gives the trajectory of its rawlog, to the bit.

#include "bag_writers.h"
#include "folder_writers.h"
#include "ros2_writers.h"
#include "simulated_walk.h"
#include "wire_writer.h"
#include <fastlio/sensors/xyzirt_access.h>

#include <mrpt/obs/CObservationPointCloud.h>

namespace fastlio::testing
{
namespace
{
class EveryFormat : public SimulatedWalk
{
 protected:
  /** Directly, and by way of fastlio-import. */
  void expectSameTrajectory(const std::string& recording, const std::string& expected)
  {
    EXPECT_EQ(trajectoryOf(recording), expected) << recording;
    const auto import = Process(
                            {FASTLIO_IMPORT_PROGRAM, recording, "-o",
                             folder_.file("imported.rawlog"), "--overwrite"},
                            folder_.file("log"))
                            .wait();
    EXPECT_EQ(import.exit_status, 0) << import.output;
    EXPECT_EQ(trajectoryOf(folder_.file("imported.rawlog")), expected) << recording;
  }
};

TEST_F(EveryFormat, GivesTheTrajectoryOfARawlogOfPackets)
{
  const std::string rawlog = rawlogOf();
  const std::string expected = trajectoryOf(rawlog);
  ASSERT_GT(expected.size(), 1000U);
  const std::vector<Object> objects = objectsOf(rawlog);
  expectSameTrajectory(
      fileOf("packets.bag", bagOf(messagesOf(objects, Wire::Ros1), {"lz4", 100, true})), expected);
  expectSameTrajectory(
      fileOf("packets.mcap", mcapOf(messagesOf(objects, Wire::Cdr), {"lz4", 100, true})), expected);
}

TEST_F(EveryFormat, GivesTheTrajectoryOfARawlogOfClouds)
{
  const std::string rawlog = rawlogOf({{"lidar.kind", "os64"}, {"lidar.columns", "256"}});
  const std::vector<Object> objects = objectsOf(rawlog);
  const std::string expected = trajectoryOf(rawlog);
  ASSERT_GT(expected.size(), 1000U);
  const auto ros1 = messagesOf(objects, Wire::Ros1);
  expectSameTrajectory(fileOf("lz4.bag", bagOf(ros1, {"lz4", 100, true})), expected);
  expectSameTrajectory(fileOf("bz2.bag", bagOf(ros1, {"bz2", 100, false})), expected);
  const auto cdr = messagesOf(objects, Wire::Cdr);
  expectSameTrajectory(fileOf("zstd.mcap", mcapOf(cdr, {"zstd", 100, true})), expected);
  writeDb3(folder_.file("walk.db3"), messagesOf(objects, Wire::CdrBigEndian));
  expectSameTrajectory(folder_.file("walk.db3"), expected);
}
TEST_F(EveryFormat, ACaptureAndATableOfSamplesMergeIntoTheRawlog)
{
  const std::string rawlog = rawlogOf();
  const std::vector<Object> objects = objectsOf(rawlog);
  const std::string expected = trajectoryOf(rawlog);
  const std::string capture = fileOf("walk.pcap", captureOf(packetsOf(objects)));
  const std::string table = fileOf("imu.csv", imuTableOf(objects));
  const auto import =
      Process(
          {FASTLIO_IMPORT_PROGRAM, "--merge", capture, table, "-o", folder_.file("merged.rawlog")},
          folder_.file("log"))
          .wait();
  ASSERT_EQ(import.exit_status, 0) << import.output;
  EXPECT_EQ(trajectoryOf(folder_.file("merged.rawlog")), expected);
}

TEST_F(EveryFormat, FoldersGiveTheTrajectoryOfTheRawlog)
{
  const std::string rawlog = rawlogOf({{"lidar.kind", "os64"}, {"lidar.columns", "256"}});
  const std::vector<Object> objects = objectsOf(rawlog);
  writePcdFolder(folder_.file("walk"), objects);
  expectSameTrajectory(folder_.file("walk"), trajectoryOf(rawlog));

  // KITTI stores no times of points: neither does the rawlog that it is compared with.
  for (const Object& object : objects)
    if (auto* cloud = dynamic_cast<mrpt::obs::CObservationPointCloud*>(object.get()))
    {
      CloudColumns columns = readColumns(*cloud->pointcloud);
      columns.time.clear();
      cloud->pointcloud = makeXyzirt(columns);
    }
  const std::string timeless = fileOf("timeless.rawlog", serialize(objects));
  writeKittiDrive(folder_.file("drive"), objects);
  expectSameTrajectory(folder_.file("drive"), trajectoryOf(timeless));
}
}  // namespace
}  // namespace fastlio::testing
