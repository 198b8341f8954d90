// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What a run has found, in MCAP.

#include "import_fixture.h"
#include "mcap_file.h"
#include <fastlio/messages/ros_messages.h>
#include <fastlio/sensors/xyzirt_access.h>

#include <mrpt/obs/CObservationPointCloud.h>

#include <array>
#include <filesystem>
#include <map>

namespace fastlio::testing
{
namespace
{
class ImportResults : public ImportFixture
{
 protected:
  /** Writes the folder of a run with one pose, three points and three scans. */
  void SetUp() override
  {
    std::filesystem::create_directory(folder_.file("run"));
    // Turned by 90 deg to the left: the axis x of the vehicle is y of the world.
    file(
        "run/covariance.csv",
        "# poses\nstamp_ns,x,y,z,qx,qy,qz,qw,c_rx_rx,c_rx_ry,c_rx_rz,c_rx_px,c_rx_py,c_rx_pz,"
        "c_ry_ry,c_ry_rz,c_ry_px,c_ry_py,c_ry_pz,c_rz_rz,c_rz_px,c_rz_py,c_rz_pz,c_px_px,c_px_py,"
        "c_px_pz,c_py_py,c_py_pz,c_pz_pz\n1700000000100000000,1,2,3,0,0,0.7071067811865476,"
        "0.7071067811865476,0.25,0,0,0,0,0,0.5,0,0,0,0,0.125,0,0,0,4,0,0,9,0,16\n");
    file(
        "run/map.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nend_header\n1 2 3\n4 5 6\n7 8 9\n");
    file(
        "run/timing.csv",
        "# scans\nstamp_ns,status,health,health_cause\n1700000000100000000,tracking,1.000,none\n"
        "1700000000200000000,tracking,0.400,few_points\n1700000000300000000,tracking,0.900,none\n");
    file(
        "run/untrusted.csv",
        "begin_ns,end_ns,begin_s,end_s,scans,cause\n"
        "1700000000300000000,1700000000300000000,0.3,0.3,1,degenerate_direction\n");
  }

  std::string recordingFile()
  {
    return file("in.bag", bagOf(messagesOf(recording(30), Wire::Ros1)));
  }
};

/** By topic. */
std::map<std::string, std::vector<Bytes>> messagesIn(const std::string& mcap)
{
  std::map<std::string, std::vector<Bytes>> messages;
  McapFile in(mcap);
  for (;;)
  {
    const NextMessage next = in.next([](const RosTopic&) { return true; });
    if (std::holds_alternative<EndOfRecording>(next)) return messages;
    const auto* message = std::get_if<RosMessage>(&next);
    EXPECT_NE(message, nullptr);
    if (message != nullptr) messages[message->topic->name].push_back(*message->data);
  }
}

WireReader readerOf(const Bytes& bytes)
{
  return {bytes.data(), bytes.size(), WireFormat::Cdr};
}

void expectDiagnostics(const std::vector<Bytes>& messages)
{
  const std::array<std::pair<int, std::string>, 3> expected{
      {{0, "tracking"},
       {1, "tracking: few_points"},
       {2, "not to be relied on: degenerate_direction"}}};
  for (std::size_t i = 0; i < 3; ++i)
  {
    WireReader status = readerOf(messages[i]);
    (void)status.number<std::int32_t>();
    (void)status.number<std::uint32_t>();
    EXPECT_EQ(status.text(), "");
    EXPECT_EQ(status.number<std::uint32_t>(), 1U);
    EXPECT_EQ(status.number<std::uint8_t>(), expected.at(i).first);
    EXPECT_EQ(status.text(), "odometry");
    EXPECT_EQ(status.text(), expected.at(i).second);
  }
}

TEST_F(ImportResults, ARunIsWrittenWithItsCovarianceMapAndDiagnostics)
{
  const auto to = import({recordingFile(), "-o", out("b.mcap"), "--run", folder_.file("run")});
  ASSERT_EQ(to.exit_status, 0) << to.output;
  auto content = messagesIn(out("b.mcap"));
  ASSERT_EQ(content["/odometry"].size(), 1U);
  WireReader odometry = readerOf(content["/odometry"][0]);
  (void)odometry.number<std::int32_t>();
  (void)odometry.number<std::uint32_t>();
  EXPECT_EQ(odometry.text(), "odom");
  EXPECT_EQ(odometry.text(), "base_link");
  for (int i = 0; i < 7; ++i)
    (void)odometry.number<double>();
  const std::array<double, 6> diagonal{4, 9, 16, 0.5, 0.25, 0.125};
  for (std::size_t i = 0; i < 36; ++i)
    EXPECT_NEAR(odometry.number<double>(), i % 7 == 0 ? diagonal.at(i / 7) : 0.0, 1e-12) << i;

  ASSERT_EQ(content["/map"].size(), 1U);
  WireReader map = readerOf(content["/map"][0]);
  const auto cloud = readPointCloud2(map, "map");
  EXPECT_EQ(cloud.frame, "odom");
  const auto points = readColumns(
      *std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(cloud.observation)->pointcloud);
  EXPECT_EQ(points.y, (std::vector<float>{2, 5, 8}));
  ASSERT_EQ(content["/diagnostics"].size(), 3U);
  expectDiagnostics(content["/diagnostics"]);
}

TEST_F(ImportResults, WhatIsNoRunIsRefused)
{
  const std::string bag = recordingFile(), run = folder_.file("run");
  EXPECT_EQ(import({bag, "-o", out("c.mcap"), "--run", folder_.file("nothing")}).exit_status, 1);
  EXPECT_EQ(import({bag, "-o", out(), "--run", run}).exit_status, 1);
  EXPECT_EQ(import({bag, "-o", out("c.mcap"), "--run", run, "--trajectory", run}).exit_status, 1);
  file("run/timing.csv", "stamp_ns,status\n17,tracking\n18");
  EXPECT_EQ(import({bag, "-o", out("c.mcap"), "--run", run}).exit_status, 1);
  EXPECT_FALSE(std::filesystem::exists(out("c.mcap")));
}
}  // namespace
}  // namespace fastlio::testing
