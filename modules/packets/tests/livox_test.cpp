// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "lidar_packets.h"
#include "recording_test_support.h"

#include <cmath>

namespace
{
using namespace fastlio;
using namespace fastlio::testing;
using mrpt::obs::CObservationIMU;

class Livox : public RecordingTest
{
};

/** Of the first generation, in spherical coordinates: pulses with \a returns each, 2 m, 3 m, ...
 * away, all 90 deg from the z axis and 30 deg from the x axis. */
std::string sphericalPacket(int pulses, int returns, std::uint8_t type)
{
  constexpr std::uint16_t kZenith = 9000, kAzimuth = 3000;  // [0.01 deg]
  WireWriter out = little();
  out.number(std::uint8_t{5}).raw(std::string(7, '\0')).number(std::uint8_t{1});
  out.number(type).number(static_cast<std::uint64_t>(kStart));
  for (int i = 0; i < pulses; ++i)
  {
    if (returns > 1) out.number(kZenith).number(kAzimuth);
    for (int k = 0; k < returns; ++k)
    {
      out.number(static_cast<std::uint32_t>(2000 + 1000 * k));
      if (returns == 1) out.number(kZenith).number(kAzimuth);
      out.number(static_cast<std::uint8_t>(10 + k)).number(std::uint8_t{0});
    }
  }
  return out.bytes();
}

TEST_F(Livox, OfTheSecondGenerationGivesScansAndSamples)
{
  std::vector<SentPacket> packets;
  for (int i = 0; i < 500; ++i)
    packets.push_back({kStart, 56301, mid360Packet(kStart + i * 480'000, 96)});
  std::string head = mid360Packet(kStart + 5'000'000, 2).substr(0, 36);
  head[1] = 60;
  head[10] = '\0';
  packets.push_back({kStart, 56401, imuOf(head, {0.1F, 0.2F, 0.3F, 0, 0, 1})});
  const Recorded capture = readRecording(fileOf(captureOf(packets)));
  ASSERT_EQ(capture.count("livox_192.168.1.201"), 3U);  // 240 ms in scans of 100 ms
  ASSERT_EQ(capture.count("livox_192.168.1.201_imu"), 1U);
  const CloudColumns columns = columnsOf(*capture.observations[0]);
  EXPECT_EQ(columns.x[1], 2.0F);
  EXPECT_EQ(columns.y[1], -0.5F);
  EXPECT_EQ(columns.z[1], 0.25F);
  EXPECT_EQ(columns.intensity[1], 77.0F);
  EXPECT_NEAR(columns.time[1], 5e-6, 1e-12);
  EXPECT_NEAR(columns.time[96], 480e-6, 1e-12);
  for (const auto& observation : capture.observations)
    if (const auto* imu = dynamic_cast<const CObservationIMU*>(observation.get()))
    {
      EXPECT_NEAR(imu->get(mrpt::obs::IMU_WY), 0.2, 1e-6);
      EXPECT_NEAR(imu->get(mrpt::obs::IMU_Z_ACC), 9.80665, 1e-6);
      EXPECT_EQ(toNanoseconds(imu->timestamp), kStart + 5'000'000);
    }
}

TEST_F(Livox, OfTheFirstGenerationGivesScans)
{
  std::vector<SentPacket> packets;
  for (int i = 0; i < 300; ++i)
    packets.push_back({kStart, 60001, aviaPacket(kStart + i * 400'000)});
  const Recorded capture = readRecording(fileOf(captureOf(packets)));
  ASSERT_EQ(capture.observations.size(), 2U);
  const CloudColumns columns = columnsOf(*capture.observations[0]);
  EXPECT_EQ(columns.size(), 250U * 96);
  EXPECT_NEAR(columns.time[24], 1e-4, 1e-9);  // 240 kHz
  EXPECT_EQ(columns.ring[7], 1U);
}

TEST_F(Livox, SphericalReturnsOfAPulseShareItsAnglesAndItsTime)
{
  const auto read = [&](int pulses, int returns, std::uint8_t type)
  {
    const std::string packet = sphericalPacket(pulses, returns, type);
    const Recorded capture = readRecording(fileOf(captureOf({{kStart, 60001, packet}})));
    EXPECT_EQ(capture.observations.size(), 1U);
    return capture.observations.empty() ? CloudColumns{} : columnsOf(*capture.observations[0]);
  };
  const CloudColumns single = read(96, 1, 3), dual = read(48, 2, 5);
  ASSERT_EQ(single.size(), 96U);
  ASSERT_EQ(dual.size(), 96U);
  EXPECT_NEAR(single.x[7], 2.0 * std::cos(M_PI / 6), 1e-6);
  EXPECT_NEAR(single.y[7], 2.0 * std::sin(M_PI / 6), 1e-6);
  EXPECT_NEAR(single.z[7], 0.0, 1e-6);
  EXPECT_EQ(single.intensity[7], 10.0F);
  for (const std::size_t k : {0U, 1U})
  {
    const double range = k == 0 ? 2.0 : 3.0;
    EXPECT_NEAR(dual.x[14 + k], range * std::cos(M_PI / 6), 1e-6);
    EXPECT_NEAR(dual.y[14 + k], range * std::sin(M_PI / 6), 1e-6);
    EXPECT_EQ(dual.intensity[14 + k], 10.0F + static_cast<float>(k));
    EXPECT_EQ(dual.ring[14 + k], 1U);
    EXPECT_NEAR(dual.time[14 + k], 7.0 / 240'000, 1e-9);
  }
}
}  // namespace
