// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// A VLP-16 and an IMU that send now, over the loopback interface, at the pace of the sensors.

#include "process.h"
#include "temporary_folder.h"
#include <fastlio/evaluation/evaluate.h>
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/live/udp_receiver.h>
#include <fastlio/scenarios/scenario.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace fastlio::testing
{
namespace
{
/** Two ports that are free now. */
std::vector<std::uint16_t> freePorts()
{
  return UdpReceiver({0, 0}).ports();
}

/** The example, and a recording that is sent to it. */
class LiveUse : public ::testing::Test
{
 protected:
  void SetUp() override
  {
    SimulationSettings settings = defaultSettings("office");
    settings.duration = kSeconds;
    recording_ = writeRecording(Simulation(settings), folder_.file("walk"));
    // Over the network the sensors have other labels.
    std::ifstream config(recording_.config);
    std::ofstream without_labels(folder_.file("live.yaml"));
    for (std::string line; std::getline(config, line);)
      if (line.find("sensor_label") == std::string::npos) without_labels << line << '\n';
  }

  [[nodiscard]] ProcessResult liveWhileSending(const std::string& speed)
  {
    const auto ports = freePorts();
    const std::string lidar = std::to_string(ports[0]), imu = std::to_string(ports[1]);
    Process live(
        {"/bin/sh", "-c", R"(exec "$0" "$1" "$2" "$3" >"$4")", FASTLIO_LIVE_EXAMPLE, lidar, imu,
         folder_.file("live.yaml"), folder_.file("poses.txt")},
        folder_.file("live.log"));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    sent_ = Process(
                {FASTLIO_SENDER_EXAMPLE, recording_.rawlog, lidar, imu, speed},
                folder_.file("sender.log"))
                .wait();
    return live.wait();
  }

  /** The poses with the stamps of the recording. */
  [[nodiscard]] std::string shiftedPoses() const
  {
    const std::int64_t shift_ns = std::stoll(sent_.output.substr(sent_.output.find(' ') + 1));
    std::ifstream poses(folder_.file("poses.txt"));
    std::ofstream shifted(folder_.file("shifted.tum"));
    for (std::string line; std::getline(poses, line);)
    {
      std::string stamp = line.substr(0, line.find(' '));
      stamp.erase(stamp.find('.'), 1);
      const std::int64_t stamp_ns = std::stoll(stamp) - shift_ns;
      const std::string decimals = std::to_string(1'000'000'000 + stamp_ns % 1'000'000'000);
      shifted << stamp_ns / 1'000'000'000 << '.' << decimals.substr(1)
              << line.substr(line.find(' ')) << '\n';
    }
    return folder_.file("shifted.tum");
  }

  static constexpr double kSeconds = 6.0;
  TemporaryFolder folder_;
  RecordingFiles recording_;
  ProcessResult sent_;
};

TEST_F(LiveUse, GivesThePosesOfTheRecording)
{
  const ProcessResult live = liveWhileSending("1");
  ASSERT_EQ(sent_.exit_status, 0) << sent_.output;
  ASSERT_EQ(live.exit_status, 0) << live.output;
  EXPECT_NE(live.output.find("bad lines: 0"), std::string::npos) << live.output;
  const auto poses = readTum(shiftedPoses());
  // A machine that is busy with other work may drop scans.
  EXPECT_GE(poses.poses.size(), 30U) << live.output;
  const auto result = evaluate(poses, readTum(recording_.ground_truth));
  EXPECT_LT(result.ape.translation.rmse, 0.02) << live.output;
  std::cout << live.output;
}

TEST_F(LiveUse, AnOverloadIsCountedAndEnds)
{
  const ProcessResult live = liveWhileSending("200");
  ASSERT_EQ(live.exit_status, 0) << live.output;
  EXPECT_NE(live.output.find("dropped because newer ones waited"), std::string::npos);
}

TEST_F(LiveUse, WrongUsageIsReported)
{
  const ProcessResult nothing = Process({FASTLIO_LIVE_EXAMPLE}, folder_.file("log.txt")).wait();
  EXPECT_EQ(nothing.exit_status, 1);
  EXPECT_NE(nothing.output.find("Usage: live"), std::string::npos) << nothing.output;
  const UdpReceiver taken({0});
  const std::string port = std::to_string(taken.ports()[0]);
  const ProcessResult busy =
      Process({FASTLIO_LIVE_EXAMPLE, port, "5000"}, folder_.file("log.txt")).wait();
  EXPECT_EQ(busy.exit_status, 1);
  EXPECT_NE(busy.output.find(port), std::string::npos) << busy.output;
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{FASTLIO_LIVE_EXAMPLE, "eth0", "5000"},
        {FASTLIO_SENDER_EXAMPLE, recording_.rawlog, "5000", "eth0"}})
  {
    const ProcessResult no_port = Process(command, folder_.file("log.txt")).wait();
    EXPECT_EQ(no_port.exit_status, 1);
    EXPECT_NE(no_port.output.find("'eth0' is no UDP port; give a whole number"), std::string::npos)
        << no_port.output;
  }
  const ProcessResult no_speed =
      Process(
          {FASTLIO_SENDER_EXAMPLE, recording_.rawlog, "5000", "5001", "fast"},
          folder_.file("log.txt"))
          .wait();
  EXPECT_EQ(no_speed.exit_status, 1);
  EXPECT_NE(no_speed.output.find("'fast' is no speed; give a number"), std::string::npos)
      << no_speed.output;
}
}  // namespace
}  // namespace fastlio::testing
