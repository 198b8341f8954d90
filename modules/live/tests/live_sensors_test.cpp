// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// From a socket to observations.

#include "failure_message.h"
#include <fastlio/live/live_sensors.h>
#include <fastlio/live/udp_receiver.h>
#include <fastlio/scenarios/scenario.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/simulation/observations.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <arpa/inet.h>
#include <cstring>
#include <ctime>
#include <netinet/in.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

namespace fastlio
{
namespace
{
using testing::failureOf;

constexpr std::int64_t kArrival = 1'700'000'000'000'000'000;
constexpr std::chrono::milliseconds kPatience(2000);

UdpPacket packetOf(const std::string& bytes, std::uint16_t port, std::int64_t stamp_ns = kArrival)
{
  return {
      "127.0.0.1", port, stamp_ns, reinterpret_cast<const std::uint8_t*>(bytes.data()),
      bytes.size()};
}

void sendTo(std::uint16_t port, const std::string& bytes)
{
  const int handle = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const ssize_t sent = sendto(
      handle, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&address),
      sizeof address);
  close(handle);
  ASSERT_EQ(sent, static_cast<ssize_t>(bytes.size()));
}

TEST(UdpReceiver, GetsPacketsOfAllItsPortsWithTheTimeOfTheirArrival)
{
  UdpReceiver receiver({0, 0});
  ASSERT_NE(receiver.ports()[0], receiver.ports()[1]);
  for (const std::size_t index : {1U, 0U})
  {
    timespec before{}, after{};
    clock_gettime(CLOCK_REALTIME, &before);
    sendTo(receiver.ports()[index], "hello " + std::to_string(index));
    const auto packet = receiver.next(kPatience);
    clock_gettime(CLOCK_REALTIME, &after);
    ASSERT_TRUE(packet.has_value());
    EXPECT_EQ(packet->port, receiver.ports()[index]);
    EXPECT_EQ(packet->source, "127.0.0.1");
    EXPECT_EQ(
        std::string(reinterpret_cast<const char*>(packet->data), packet->size),
        "hello " + std::to_string(index));
    // The clock of the network may count in steps of the system's timer.
    EXPECT_GE(packet->stamp_ns, before.tv_sec * 1'000'000'000LL + before.tv_nsec - 10'000'000);
    EXPECT_LE(packet->stamp_ns, after.tv_sec * 1'000'000'000LL + after.tv_nsec);
  }
  EXPECT_FALSE(receiver.next(std::chrono::milliseconds(1)).has_value());
}

TEST(UdpReceiver, TextThatIsNoPortIsNamed)
{
  EXPECT_EQ(udpPort("2368"), 2368);
  EXPECT_EQ(udpPort("65535"), 65535);
  for (const char* text : {"", "0", "65536", "-1", "23x", "eth0"})
  {
    const auto message = failureOf<std::invalid_argument>([&] { (void)udpPort(text); });
    EXPECT_EQ(
        message, "'" + std::string(text) + "' is no UDP port; give a whole number from 1 to 65535");
  }
}

TEST(UdpReceiver, APortInUseIsNamed)
{
  const UdpReceiver first({0});
  const std::uint16_t port = first.ports()[0];
  const std::string refusal =
      failureOf<std::runtime_error>([&] { const UdpReceiver second({port}); });
  EXPECT_NE(refusal.find(std::to_string(port)), std::string::npos) << refusal;
}

TEST(LiveSensors, ASampleIsALineOfText)
{
  LiveSensors sensors(5000);
  ObservationQueue out;
  const std::string lines =
      "1700000000123456789,0.1,-0.2,0.3,1,2,9.8\n\n0 0 0 1e-3 0 0 9.81\r\nstamp,wx,wy\n1 2 3\n"
      "5,0,0,0,0,0,nan\n6 1 2 3 4 5 6 7\n-1 0 0 0 0 0 0\n";
  sensors.take(packetOf(lines, 5000), out);
  ASSERT_EQ(out.size(), 2U);
  EXPECT_EQ(sensors.badLines(), 5U);
  const auto& sample = dynamic_cast<const mrpt::obs::CObservationIMU&>(*out[0]);
  EXPECT_EQ(toNanoseconds(sample.timestamp),
            1'700'000'000'123'456'800);  // MRPT counts 100 ns
  EXPECT_EQ(sample.get(mrpt::obs::IMU_WY), -0.2);
  EXPECT_EQ(sample.get(mrpt::obs::IMU_Z_ACC), 9.8);
  EXPECT_EQ(sample.sensorLabel, "imu_127.0.0.1");
  EXPECT_EQ(toNanoseconds(out[1]->timestamp), kArrival);
}

/** Packets of a simulated VLP-16 that arrive late by a varying time. */
TEST(LiveSensors, AVelodynesScansGetStampsOfThisMachine)
{
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 3.0;
  const Simulation simulation(settings);
  LiveSensors sensors;
  ObservationQueue out;
  std::vector<std::int64_t> sent_ns;
  int count = 0;
  for (std::size_t sweep = 0; sweep < simulation.scanCount(); ++sweep)
  {
    const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservationVelodyneScan>(
        toLidarObservation(simulation, sweep));
    sent_ns.push_back(toNanoseconds(scan->timestamp));
    for (const auto& packet : scan->scan_packets)
    {
      const std::int64_t late_ns = 1'000'000LL * (count++ % 7);
      const std::int64_t after_ns =
          1000LL * (packet.gps_timestamp() - scan->scan_packets.front().gps_timestamp());
      const std::string bytes(reinterpret_cast<const char*>(&packet), sizeof packet);
      sensors.take(packetOf(bytes, 2368, sent_ns.back() + after_ns + late_ns), out);
    }
  }
  sensors.flush(out);
  ASSERT_GE(out.size(), sent_ns.size() - 1);
  for (std::size_t i = 1; i < sent_ns.size() - 1; ++i)
    EXPECT_NEAR(
        static_cast<double>(toNanoseconds(out[i]->timestamp)), static_cast<double>(sent_ns[i]),
        1.5e6)
        << i;
}
}  // namespace
}  // namespace fastlio
