// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "short_simulation.h"
#include <fastlio/scenarios/realistic.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/velodyne_decoder.h>
#include <fastlio/simulation/observations.h>
#include <fastlio/simulation/recording.h>
#include <fastlio/simulation/vlp16.h>

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace fastlio
{
namespace
{
SimulationSettings exactCampus(double duration = 2.0, int stride = 1)
{
  return testing::withoutErrors(testing::shortSettings("campus", duration, stride));
}

TEST(FalseReturns, AreTheGivenShareAndLieBeforeTheSurface)
{
  SimulationSettings settings = exactCampus();
  const FiredSweep exact = Simulation(settings).fire(4);
  settings.lidar.beam.false_returns = 0.05;
  const FiredSweep dusty = Simulation(settings).fire(4);
  double changed = 0.0;
  for (std::size_t i = 0; i < exact.echoes.size(); ++i)
  {
    const double surface = exact.echoes[i].range, range = dusty.echoes[i].range;
    if (range == surface) continue;
    changed += 1.0;
    EXPECT_GE(range, settings.lidar.min_range);
    EXPECT_LE(range, surface > 0.0 ? std::min(surface, 10.0) : 10.0);
  }
  EXPECT_NEAR(changed / static_cast<double>(exact.echoes.size()), 0.05, 0.005);
}

/** Packets that arrive, out of those that are sent. */
struct PacketCount
{
  double sent = 0.0, arrived = 0.0;
};

PacketCount countPackets(const Simulation& simulation)
{
  PacketCount count;
  for (std::size_t i = 0; i < simulation.scanCount(); ++i)
  {
    const FiredSweep fired = simulation.fire(i);
    const std::size_t sent = fired.sweep.shots.size() / vlp16::kShotsPerPacket;
    count.sent += static_cast<double>(sent);
    count.arrived +=
        static_cast<double>(toVelodyneScan(fired, simulation.settings())->scan_packets.size());
  }
  return count;
}

TEST(PacketLoss, LosesTheGivenShareOneByOne)
{
  SimulationSettings settings = exactCampus(20.0, 400);
  settings.lidar.beam.packet_loss = 0.05;
  const PacketCount count = countPackets(Simulation(settings));
  EXPECT_NEAR(1.0 - count.arrived / count.sent, 0.05, 0.006);  // 15000 packets: 3 sigma
}

TEST(PacketLoss, LosesAllPacketsForAWhileOncePerInterval)
{
  SimulationSettings settings = exactCampus(24.0, 400);
  settings.lidar.beam.outage_interval = 8.0;
  settings.lidar.beam.outage_length = 0.05;
  const PacketCount count = countPackets(Simulation(settings));
  const double lost = (count.sent - count.arrived) * 1e-9 * static_cast<double>(vlp16::kPacketNs);
  EXPECT_NEAR(lost, 3 * 0.05, 3 * 0.0014);
}

TEST(PacketLoss, TakesNoPointsWithItThatArrived)
{
  SimulationSettings settings = exactCampus(3.0);
  settings.lidar.beam.packet_loss = 0.3;
  const Simulation simulation(settings);
  int first_lost = 0;
  for (std::size_t index = 0; index < 12; ++index)
  {
    const FiredSweep fired = simulation.fire(index);
    const PointColumns meant = pointsOf(fired);
    const auto observation = toVelodyneScan(fired, settings);
    const PointColumns found = decodeVelodyne(*observation).points;
    ASSERT_EQ(found.size(), meant.size());
    // Times count from the first packet that arrives, and so does the stamp.
    const auto late =
        static_cast<std::int32_t>(toNanoseconds(observation->timestamp) - fired.sweep.stamp_ns);
    first_lost += fired.packet_lost.front() ? 1 : 0;
    EXPECT_EQ(late > 1'000'000, fired.packet_lost.front());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      ASSERT_NEAR(std::hypot(found.x[i], found.y[i]), std::hypot(meant.x[i], meant.y[i]), 0.002);
      ASSERT_NEAR(found.time_offset_ns[i] + late, meant.time_offset_ns[i], 1200);
    }
  }
  EXPECT_GT(first_lost, 0);
}

/** Points within reach of the sensor, per sweep. */
std::size_t pointsWithin(const Simulation& simulation, std::size_t index, double reach)
{
  std::size_t count = 0;
  for (const Echo& echo : simulation.fire(index).echoes)
    count += echo.range > 0.0 && echo.range < reach ? 1 : 0;
  return count;
}

TEST(NearBodies, CarrierStaysBehindTheSensorOnTheWholeWay)
{
  SimulationSettings settings = exactCampus(12.0, 4);
  settings.lidar.min_range = 0.3;
  EXPECT_EQ(pointsWithin(Simulation(settings), 60, 1.0), 0U);
  settings.carrier.body = true;
  const Simulation simulation(settings);
  for (const std::size_t index : {2U, 60U, 110U})
  {
    EXPECT_GT(pointsWithin(simulation, index, 1.0), 300U);
    const PointColumns points = pointsOf(simulation.fire(index));
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_TRUE(std::hypot(points.x[i], points.y[i]) > 1.0F || points.x[i] < -0.3F);
  }
}

TEST(NearBodies, CrowdHidesAShareOfTheViewAndMoves)
{
  SimulationSettings settings = exactCampus(12.0, 4);
  settings.lidar.min_range = 0.3;
  settings.carrier.crowd = 6;
  const Simulation simulation(settings);
  const FiredSweep one = simulation.fire(2), later = simulation.fire(20);  // both at rest
  std::size_t near = 0, shots = 0, moved = 0;
  for (std::size_t i = 0; i < std::min(one.echoes.size(), later.echoes.size()); ++i)
  {
    if (one.sweep.shots[i].column % 4 != 0) continue;
    ++shots;
    near += one.echoes[i].range > 0.0 && one.echoes[i].range < 2.0 ? 1 : 0;
    moved += std::abs(one.echoes[i].range - later.echoes[i].range) > 0.02 ? 1 : 0;
  }
  // Six people of 0.22 m radius at 1.1 to 1.4 m: about 6 * 2 * asin(0.22 / 1.25) of the circle.
  EXPECT_NEAR(static_cast<double>(near) / static_cast<double>(shots), 0.34, 0.12);
  EXPECT_GT(moved, shots / 20);
}

TEST(Realistic, LeavesTheRandomNumbersOfIdealSensorsAsTheyWere)
{
  SimulationSettings settings = testing::shortSettings("office", 3.0);
  const Simulation ideal(settings);
  settings.lidar.beam.false_returns = 1e-9;
  settings.lidar.beam.packet_loss = 1e-9;
  settings.imu.errors.g_sensitivity_std = 1e-30;
  settings.lidar.hidden.clock_error = 0.004;
  const Simulation other(settings);
  EXPECT_EQ(ideal.scan(20).points.x, other.scan(20).points.x);
  for (std::size_t i = 0; i < ideal.imu().samples.size(); ++i)
    ASSERT_EQ(ideal.imu().samples[i].gyro, other.imu().samples[i].gyro);
}

TEST(Realistic, TurnsOnEverySettingOfImperfectionsButTheCrowd)
{
  const SimulationSettings ideal = defaultSettings("campus"), real = realistic(ideal);
  EXPECT_EQ(real.carrier.crowd, 0);
  const BeamSettings& b = real.lidar.beam;
  for (const double value :
       {b.laser_range_std,
        b.laser_elevation_std,
        -b.incidence_bias,
        b.dark_bias,
        -b.bright_bias,
        b.divergence_horizontal,
        b.divergence_vertical,
        b.false_returns,
        b.packet_loss,
        b.outage_interval,
        real.lidar.hidden.clock_error,
        real.lidar.hidden.rotation_std,
        real.lidar.hidden.position_std,
        real.imu.errors.gyro_scale_std,
        real.imu.errors.accel_scale_std,
        real.imu.errors.gyro_misalignment_std,
        real.imu.errors.accel_misalignment_std,
        real.imu.errors.g_sensitivity_std,
        real.imu.stamp_jitter,
        real.imu.dropout,
        real.imu.gap_interval,
        real.surface.glass,
        real.surface.mirrors,
        real.carrier.vibration_accel,
        real.carrier.vibration_gyro})
    EXPECT_GT(value, 0.0);
  EXPECT_EQ(real.imu.errors.bits, 16);
  EXPECT_TRUE(real.carrier.body);
  for (const char* alone : {"uav", "car", "town", "facades"})
    EXPECT_FALSE(realistic(defaultSettings(alone)).carrier.body) << alone;
}

TEST(Realistic, ConfigTellsNoneOfTheErrorsAndTheScenarioAll)
{
  SimulationSettings settings = realistic(testing::shortSettings("campus", 2.0));
  const Simulation simulation(settings);
  const Config config = matchingConfig(settings);
  EXPECT_EQ(config.odometry.lidar.time_offset, 0.0);
  EXPECT_EQ(config.sensors.T_vehicle_lidar->p, settings.lidar.T_imu_lidar.p);
  const auto truth = nlohmann::json::parse(scenarioJson(simulation))["truth"];
  EXPECT_EQ(truth["lidar_clock_minus_imu_clock_s"], 0.004);
  const Pose& mounting = simulation.lidarErrors().T_imu_lidar;
  EXPECT_NEAR(truth["T_imu_lidar"]["position_m"][0], mounting.p.x(), 1e-12);
  EXPECT_GT((mounting.p - settings.lidar.T_imu_lidar.p).norm(), 0.001);
  EXPECT_EQ(truth["laser_lines"]["range_offset_m"].size(), 16U);
  EXPECT_EQ(
      truth["laser_lines"]["elevation_offset_rad"][3],
      simulation.lidarErrors().elevation_offset[3]);
  EXPECT_EQ(truth["imu_errors"]["accel_matrix"][0][2], simulation.imu().errors.accel(0, 2));
}

TEST(Realistic, GivesTheSameDataInWhateverOrderThreadsMakeIt)
{
  const SimulationSettings settings = realistic(testing::shortSettings("office", 4.0, 10));
  const Simulation one(settings), other(settings);
  std::vector<LidarScan> scans;
  for (std::size_t i = 0; i < one.scanCount(); ++i)
    scans.push_back(one.scan(i));
  for (std::size_t i = other.scanCount(); i-- > 0;)
  {
    const LidarScan scan = other.scan(i);
    ASSERT_EQ(scan.points.x, scans[i].points.x);
    ASSERT_EQ(scan.points.z, scans[i].points.z);
    ASSERT_EQ(scan.points.intensity, scans[i].points.intensity);
  }
  EXPECT_EQ(groundTruthText(one), groundTruthText(other));
  EXPECT_EQ(scenarioJson(one), scenarioJson(other));
}

TEST(Realistic, EveryKindOfLidarFires)
{
  for (const char* scenario : {"campus", "shake", "uav", "car"})
  {
    const Simulation simulation(realistic(testing::shortSettings(scenario, 2.0, 10)));
    EXPECT_GT(simulation.scan(7).points.size(), 200U) << scenario;
  }
}
}  // namespace
}  // namespace fastlio
