// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The other models: HDL-32E, HDL-64E, and those that are not known.

#include "failure_message.h"
#include "velodyne_packets.h"
#include <fastlio/sensors/velodyne_decoder.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace
{
using namespace fastlio::testing;
using fastlio::decodeVelodyne;
using mrpt::obs::VelodyneCalibration;
}  // namespace

TEST(VelodyneModels, Hdl32eFires32LasersPerBlock)
{
  auto scan = makeVlp16Scan({makePacket(0, 17, 0, 5000, 0x37, 0x21)});
  for (const bool own_table : {false, true})
  {
    scan->calibration =
        own_table ? VelodyneCalibration{} : VelodyneCalibration::LoadDefaultCalibration("HDL32");
    const auto sweep = decodeVelodyne(*scan);
    ASSERT_EQ(sweep.points.size(), kBlocks * kReturns);
    EXPECT_NEAR(sweep.points.time_offset_ns[33], (46.08 + 1.152) * 1e3, 1.0);
    EXPECT_NEAR(elevationOf(sweep.points, 0), -30.67, 1e-2);
    EXPECT_NEAR(elevationOf(sweep.points, 1), -9.33, 1e-2);
    EXPECT_NEAR(elevationOf(sweep.points, 31), 10.67, 1e-2);
    EXPECT_EQ(sweep.points.ring[0], 0);
    EXPECT_EQ(sweep.points.ring[31], 31);
  }
}

TEST(VelodyneModels, SeveralThreadsLoadTheirCalibrationsAtOnce)
{
  // For the thread sanitizer, which sees what goes wrong only sometimes.
  const std::vector<std::pair<std::string, std::size_t>> models{{"VLP16", 16}, {"HDL32", 32}};
  std::vector<std::thread> threads;
  std::atomic<int> right{0};
  for (int i = 0; i < 6; ++i)
    threads.emplace_back(
        [&, i]
        {
          const auto& [model, lasers] = models.at(static_cast<std::size_t>(i) % models.size());
          const auto calibration = fastlio::defaultVelodyneCalibration(model);
          right += calibration.laser_corrections.size() == lasers ? 1 : 0;
        });
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_EQ(right, 6);
}

TEST(VelodyneModels, Hdl64eHasTwoBanksAtOnceAndNeedsItsCalibration)
{
  Packet packet = makePacket(0, 17, 0, 5000, 0xF7, 0x31, 2);
  for (std::size_t block = 1; block < kBlocks; block += 2)
    setHeader(packet, block, 0xDDFF);
  auto scan = makeVlp16Scan({packet});
  scan->calibration.laser_corrections.resize(64);
  for (std::size_t i = 0; i < 64; ++i)
  {
    auto& laser = scan->calibration.laser_corrections[i];
    laser.verticalCorrection = 2.0 - 0.4 * static_cast<double>(i);
    laser.sinVertCorrection = std::sin(laser.verticalCorrection * kDegree);
    laser.cosVertCorrection = std::cos(laser.verticalCorrection * kDegree);
    laser.azimuthCorrection = 5.0;
    laser.distanceCorrection = 1.0;
  }
  const auto sweep = decodeVelodyne(*scan);
  ASSERT_EQ(sweep.points.size(), kBlocks * kReturns);
  EXPECT_EQ(fastlio::velodyneModelName(*scan), "HDL-64E");
  EXPECT_EQ(sweep.points.time_offset_ns[0], sweep.points.time_offset_ns[kReturns]);
  EXPECT_NEAR(sweep.points.time_offset_ns[2 * kReturns], 48e3, 1.0);
  EXPECT_NEAR(rangeOf(sweep.points, 0), 11.0, 1e-5);
  EXPECT_NEAR(azimuthOf(sweep.points, 0), 355.0, 1e-4);
  EXPECT_NEAR(elevationOf(sweep.points, kReturns), 2.0 - 0.4 * 32, 1e-4);
  EXPECT_EQ(sweep.points.ring[0], 63);
}

TEST(VelodyneModels, UnknownModelsAndImpossibleCalibrationsAreNamed)
{
  auto scan = makeVlp16Scan({makePacket(0, 40, 0, 5000, 0x37, 0xA1)});
  scan->calibration.clear();
  EXPECT_EQ(fastlio::velodyneModelName(*scan), "unknown model");
  const std::string refusal = failureOf<std::runtime_error>([&] { (void)decodeVelodyne(*scan); });
  EXPECT_NE(refusal.find("161"), std::string::npos) << refusal;
  auto broken = makeVlp16Scan({makePacket(0, 40, 0, 5000)});
  broken->calibration.laser_corrections[3].distanceCorrection = NAN;
  EXPECT_THROW((void)decodeVelodyne(*broken), std::runtime_error);
}
