// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Containers and messages that others have written: a simulated recording through Debian's
// python3-rosbag and npm's @mcap/core gives the trajectory of its rawlog, to the bit.

#include "folder_writers.h"
#include "simulated_walk.h"
#include "wire_writer.h"
#include <fastlio/options/number_text.h>

#include <mrpt/obs/CObservationPointCloud.h>

#include <algorithm>
#include <cstdlib>

namespace fastlio::testing
{
namespace
{
const std::string kPython = "/usr/bin/python3";

class Conformance : public SimulatedWalk
{
 protected:
  /** The files that the scripts read. */
  std::string dump(const std::vector<Object>& objects)
  {
    const std::string folder = folder_.file("dump");
    std::filesystem::create_directories(folder + "/scans");
    for (const Object& object : objects)
      if (dynamic_cast<const mrpt::obs::CObservationPointCloud*>(object.get()) != nullptr)
      {
        const LidarScan scan = scanOf(*object);
        write(folder + "/scans/" + std::to_string(scan.stamp_ns) + ".bin", bytesOf(scan.points));
      }
    write(folder + "/imu.csv", imuTableOf(objects));
    return folder;
  }

  ProcessResult run(const std::vector<std::string>& command)
  {
    return Process(command, folder_.file("log")).wait();
  }

  static std::string script(const char* name)
  {
    return std::string(FASTLIO_CONFORMANCE_DIR) + "/" + name;
  }

 private:
  static std::string bytesOf(const PointColumns& points)
  {
    WireWriter out(Wire::Ros1);
    for (std::size_t i = 0; i < points.size(); ++i)
      out.number(points.x[i])
          .number(points.y[i])
          .number(points.z[i])
          .number(points.intensity[i])
          .number(static_cast<std::uint32_t>(points.time_offset_ns[i]))
          .number(points.ring[i]);
    return out.bytes();
  }
};

TEST_F(Conformance, BagsOfPython3Rosbag)
{
  if (run({kPython, "-c", "import rosbag, sensor_msgs.msg"}).exit_status != 0)
    GTEST_SKIP() << "needs Debian's python3-rosbag and python3-sensor-msgs";
  const std::string rawlog = rawlogOf({{"lidar.kind", "os64"}, {"lidar.columns", "256"}});
  const std::string expected = trajectoryOf(rawlog), folder = dump(objectsOf(rawlog));
  ASSERT_GT(expected.size(), 1000U);
  for (const char* compression : {"none", "bz2", "lz4"})
  {
    const std::string bag = folder_.file(std::string(compression) + ".bag");
    const auto written = run({kPython, script("write_bag.py"), folder, bag, compression});
    ASSERT_EQ(written.exit_status, 0) << written.output;
    EXPECT_EQ(trajectoryOf(bag), expected) << compression;
  }
}

TEST_F(Conformance, McapOfMcapCore)
{
  const char* modules = std::getenv("FASTLIO_NODE_MODULES");
  if (modules == nullptr || run({"/usr/bin/env", "node", "--version"}).exit_status != 0)
    GTEST_SKIP() << "needs node, and FASTLIO_NODE_MODULES: a folder with npm's @mcap/core, "
                    "@foxglove/rosmsg2-serialization and @foxglove/rosmsg-msgs-common";
  const std::string rawlog = rawlogOf({{"lidar.kind", "os64"}, {"lidar.columns", "256"}});
  const std::string expected = trajectoryOf(rawlog), folder = dump(objectsOf(rawlog));
  ASSERT_GT(expected.size(), 1000U);
  for (const char* compression : {"none", "lz4", "zstd"})
  {
    if (std::string(compression) != "none" &&
        run({"/usr/bin/env", compression, "--version"}).exit_status != 0)
      continue;
    const std::string mcap = folder_.file(std::string(compression) + ".mcap");
    const auto written =
        run({"/usr/bin/env", "node", script("write_mcap.cjs"), folder, mcap, compression});
    ASSERT_EQ(written.exit_status, 0) << written.output;
    EXPECT_EQ(trajectoryOf(mcap), expected) << compression;
  }
}
TEST_F(Conformance, OurMcapIsReadByMcapCore)
{
  const char* modules = std::getenv("FASTLIO_NODE_MODULES");
  if (modules == nullptr || run({"/usr/bin/env", "node", "--version"}).exit_status != 0 ||
      run({"/usr/bin/env", "zstd", "--version"}).exit_status != 0)
    GTEST_SKIP() << "needs node, zstd, and FASTLIO_NODE_MODULES: a folder with npm's @mcap/core, "
                    "@foxglove/rosmsg and @foxglove/rosmsg2-serialization";
  const std::string rawlog = rawlogOf({{"lidar.kind", "os64"}, {"lidar.columns", "64"}});
  const std::string mcap = folder_.file("ours.mcap");
  ASSERT_EQ(run({FASTLIO_IMPORT_PROGRAM, rawlog, "-o", mcap}).exit_status, 0);
  double forces = 0;
  std::size_t samples = 0, clouds = 0, points = 0;
  for (const Object& object : objectsOf(rawlog))
    if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(object.get()))
    {
      forces += imu->get(mrpt::obs::IMU_Z_ACC);
      ++samples;
    }
    else
    {
      points += scanOf(*object).points.size();
      ++clouds;
    }
  const auto read = run({"/usr/bin/env", "node", script("read_mcap.cjs"), mcap});
  EXPECT_EQ(
      read.output, "/imu sensor_msgs/msg/Imu " + std::to_string(samples) + " " +
                       fixedText(forces, 3) + "\n/lidar sensor_msgs/msg/PointCloud2 " +
                       std::to_string(clouds) + " " + std::to_string(points) +
                       ".000\n/tf_static tf2_msgs/msg/TFMessage 2 2.000\n");
}

TEST_F(Conformance, ResultsOfARunAreReadByMcapCore)
{
  const char* modules = std::getenv("FASTLIO_NODE_MODULES");
  if (modules == nullptr || run({"/usr/bin/env", "node", "--version"}).exit_status != 0)
    GTEST_SKIP() << "needs node, and FASTLIO_NODE_MODULES, as OurMcapIsReadByMcapCore";
  const std::string rawlog = rawlogOf(), walk = folder_.file("walk"), mcap = folder_.file("w.mcap");
  ASSERT_EQ(run({FASTLIO_REPLAY_PROGRAM, rawlog, "-o", walk}).exit_status, 0);
  ASSERT_EQ(run({FASTLIO_IMPORT_PROGRAM, rawlog, "-o", mcap, "--run", walk}).exit_status, 0);
  const std::string poses = fastlio::testing::bytesOf(walk + "/trajectory.tum");
  const std::string n = std::to_string(std::count(poses.begin(), poses.end(), '\n'));
  const auto read = run({"/usr/bin/env", "node", script("read_mcap.cjs"), mcap});
  for (const std::string& line :
       {"/odometry nav_msgs/msg/Odometry " + n + " " + n + ".000\n",  // each with a covariance
        std::string("/diagnostics diagnostic_msgs/msg/DiagnosticArray "),
        std::string("/map sensor_msgs/msg/PointCloud2 1 ")})
    EXPECT_NE(read.output.find(line), std::string::npos) << line << read.output;
}
}  // namespace
}  // namespace fastlio::testing
