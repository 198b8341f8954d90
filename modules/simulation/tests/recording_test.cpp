// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "file_size_limit.h"
#include "folder_listing.h"
#include "short_simulation.h"
#include <fastlio/config/config_yaml.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/imu_conversion.h>
#include <fastlio/sensors/point_cloud_conversion.h>
#include <fastlio/sensors/velodyne_decoder.h>
#include <fastlio/simulation/observations.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservationVelodyneScan;
using testing::contentOf;
using testing::filesIn;
using testing::TemporaryFolder;

TEST(VelodynePackets, OurDecoderFindsEveryPointWithItsTime)
{
  const Simulation simulation(testing::shortSettings("office", 6.0, 1));
  for (const std::size_t index : {0U, 33U, 50U})
  {
    const FiredSweep fired = simulation.fire(index);
    const PointColumns meant = pointsOf(fired);
    const PointColumns found = decodeVelodyne(*toVelodyneScan(fired, simulation.settings())).points;
    ASSERT_EQ(found.size(), meant.size());
    ASSERT_GT(found.size(), 20000U);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      const Eigen::Vector3f a(meant.x[i], meant.y[i], meant.z[i]);
      const Eigen::Vector3f b(found.x[i], found.y[i], found.z[i]);
      ASSERT_NEAR(a.norm(), b.norm(), 0.0011F);                      // half a unit of 2 mm
      ASSERT_LT((a.normalized() - b.normalized()).norm(), 1.5e-4F);  // azimuth unit 0.01 deg
      ASSERT_NEAR(meant.time_offset_ns[i], found.time_offset_ns[i], 1200);
      ASSERT_EQ(meant.ring[i], found.ring[i]);
      ASSERT_NEAR(meant.intensity[i], found.intensity[i], 0.51F);
    }
  }
}

TEST(VelodynePackets, MrptsDecoderFindsThePointsOfEachBlocksFirstFiring)
{
  const Simulation simulation(testing::shortSettings("office", 4.0, 1));
  const FiredSweep fired = simulation.fire(20);
  auto scan = toVelodyneScan(fired, simulation.settings());
  CObservationVelodyneScan::TGeneratePointCloudParameters parameters;
  parameters.minDistance = 0.0F;
  scan->generatePointCloud(parameters);
  const auto& cloud = scan->point_cloud;
  std::size_t next = 0;
  for (std::size_t i = 0; i < fired.echoes.size(); ++i)
  {
    const bool second_firing = fired.sweep.shots[i].column % 2 == 1;
    if (second_firing || fired.echoes[i].range <= 0.0) continue;
    ASSERT_LT(next, cloud.size());
    const Vec3 meant = fired.echoes[i].range * fired.sweep.shots[i].direction;
    const Vec3 found(cloud.x[next], cloud.y[next], cloud.z[next]);
    // MRPT rounds azimuths to its sine table.
    ASSERT_LT((meant - found).norm(), 0.0015 + 5e-4 * meant.norm()) << "point " << next;
    ++next;
  }
  EXPECT_EQ(next, cloud.size());
  EXPECT_GT(next, 10000U);
}

/** Microseconds since the hour; the packet's own function binds a reference to a packed member. */
std::uint32_t timeOf(const mrpt::obs::CObservationVelodyneScan::TVelodyneRawPacket& packet)
{
  constexpr std::size_t kOffset = 1200;
  std::uint32_t time = 0;
  std::memcpy(&time, reinterpret_cast<const unsigned char*>(&packet) + kOffset, sizeof(time));
  return time;
}

TEST(VelodynePackets, TimesWrapAtTheHour)
{
  SimulationSettings settings = testing::shortSettings("rest", 2.0);
  settings.start_ns = 1'700'002'800'000'000'000 - 1'060'000'000;  // a full hour is 1.06 s away
  const Simulation simulation(settings);
  const std::int64_t hour_ns = settings.start_ns + 1'060'000'000;
  ASSERT_EQ(hour_ns % 3'600'000'000'000, 0);
  bool wrapped = false;
  for (std::size_t i = 8; i < 13; ++i)
  {
    const FiredSweep fired = simulation.fire(i);
    const auto scan = toVelodyneScan(fired, settings);
    wrapped = wrapped || timeOf(scan->scan_packets.back()) < timeOf(scan->scan_packets.front());
    const auto decoded = decodeVelodyne(*scan);
    EXPECT_EQ(decoded.counts.bad_packet_times, 0U);
    ASSERT_FALSE(decoded.points.time_offset_ns.empty());
    EXPECT_LT(decoded.points.time_offset_ns.back(), 102'000'000);
    EXPECT_GT(decoded.points.time_offset_ns.back(), 90'000'000);
  }
  EXPECT_TRUE(wrapped);
}

TEST(VelodynePackets, RangesBeyondAPacketAreNoReturns)
{
  FiredSweep fired = Simulation(testing::shortSettings("rest", 1.0, 1)).fire(0);
  for (auto& echo : fired.echoes)
    echo.range = 140.0;
  const auto scan = toVelodyneScan(fired, defaultSettings("rest"));
  EXPECT_EQ(decodeVelodyne(*scan).points.size(), 0U);
}

TEST(Observations, CloudsHoldThePointsWithTheirTimes)
{
  for (const char* scenario : {"shake", "uav"})
  {
    const Simulation simulation(testing::shortSettings(scenario, 4.0, 8));
    const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservationPointCloud>(
        toLidarObservation(simulation, 31));
    ASSERT_TRUE(observation);
    const LidarScan scan = simulation.scan(31);
    EXPECT_NEAR(
        static_cast<double>(toNanoseconds(observation->timestamp)),
        static_cast<double>(scan.stamp_ns), 300.0);
    const CloudConversion cloud =
        toTimedPoints(readColumns(*observation->pointcloud), toNanoseconds(observation->timestamp));
    EXPECT_EQ(cloud.times, PointTimes::PerPoint);
    EXPECT_EQ(cloud.points.x, scan.points.x);
    EXPECT_EQ(cloud.points.ring, scan.points.ring);
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
      ASSERT_NEAR(cloud.points.time_offset_ns[i], scan.points.time_offset_ns[i], 10);
  }
}

TEST(Observations, ImuSamplesSurviveTheRoundTrip)
{
  const ImuSample sample{1'700'000'000'123'456'700, {0.1, -0.2, 0.3}, {1.0, 2.0, 9.7}};
  const auto back = toImuSample(*toImuObservation(sample));
  ASSERT_TRUE(back.sample);
  EXPECT_EQ(back.sample->stamp_ns, sample.stamp_ns);
  EXPECT_EQ(back.sample->gyro, sample.gyro);
  EXPECT_EQ(back.sample->accel, sample.accel);
}

TEST(Recording, HoldsEverythingInTheOrderOfStamps)
{
  const TemporaryFolder directory;
  const Simulation simulation(testing::shortSettings("office", 3.0));
  std::size_t reported = 0;
  const RecordingFiles files = writeRecording(
      simulation, directory.path(),
      [&](std::size_t done, std::size_t total)
      {
        EXPECT_EQ(done, ++reported);
        EXPECT_EQ(total, simulation.scanCount());
      });
  EXPECT_EQ(reported, simulation.scanCount());

  RawlogSource source({files.rawlog});
  std::size_t scans = 0, samples = 0;
  std::int64_t last = 0;
  while (const auto observation = source.next())
  {
    EXPECT_GE(toNanoseconds(observation->timestamp), last);
    last = toNanoseconds(observation->timestamp);
    scans += observation->sensorLabel == kLidarLabel ? 1 : 0;
    samples += observation->sensorLabel == kImuLabel ? 1 : 0;
  }
  for (const auto& problem : source.problems())
    ADD_FAILURE() << problem.message;
  EXPECT_EQ(scans, simulation.scanCount());
  EXPECT_EQ(samples, simulation.imu().samples.size());
}

TEST(Recording, SameSettingsGiveTheSameBytes)
{
  for (const char* scenario : {"office", "uav"})
  {
    SimulationSettings settings = testing::shortSettings(scenario, 2.0, 10);
    const TemporaryFolder a, b, c;
    const RecordingFiles one = writeRecording(Simulation(settings), a.path());
    const RecordingFiles same = writeRecording(Simulation(settings), b.path());
    settings.seed = 77;
    const RecordingFiles other = writeRecording(Simulation(settings), c.path());
    for (const auto file :
         {&RecordingFiles::rawlog, &RecordingFiles::ground_truth, &RecordingFiles::config,
          &RecordingFiles::scenario})
      EXPECT_EQ(contentOf(one.*file), contentOf(same.*file));
    EXPECT_NE(contentOf(one.rawlog), contentOf(other.rawlog));
    EXPECT_EQ(contentOf(one.ground_truth), contentOf(other.ground_truth));
  }
}

TEST(Recording, AFullDiskLeavesWhatWasThere)
{
  const TemporaryFolder around;
  const std::string folder = around.file("recording");
  SimulationSettings settings = testing::shortSettings("uav", 2.0, 10);
  const Simulation simulation(settings);
  settings.seed = 77;
  const Simulation other(settings);
  const auto write_on_full_disk = [&](const Simulation& s)
  {
    const testing::FileSizeLimit limit(20'000);
    EXPECT_THROW((void)writeRecording(s, folder, {}, true), std::runtime_error);
  };
  write_on_full_disk(simulation);
  EXPECT_FALSE(std::filesystem::exists(folder));
  writeRecording(simulation, folder);
  const auto before = filesIn(folder);
  ASSERT_GE(before.size(), 4U);
  write_on_full_disk(other);
  EXPECT_EQ(filesIn(folder), before);
}

TEST(Recording, SaysWhatIsTrue)
{
  SimulationSettings settings = testing::shortSettings("office", 3.0);
  settings.lidar.time_offset = 0.004;
  const Simulation simulation(settings);
  const auto json = nlohmann::json::parse(scenarioJson(simulation));
  EXPECT_EQ(json["scenario"], "office");
  EXPECT_EQ(json["settings"]["lidar.kind"], "vlp16");
  EXPECT_EQ(json["settings"]["imu.rate"], 200.0);
  EXPECT_EQ(json["truth"]["lidar_clock_minus_imu_clock_s"], 0.004);
  EXPECT_EQ(
      json["truth"]["initial_bias"]["gyro_rad_s"][1], simulation.imu().true_bias.front().gyro.y());
  EXPECT_EQ(json["counts"]["sweeps"], simulation.scanCount());
}

TEST(Recording, ConfigLoadsStrictly)
{
  const TemporaryFolder directory;
  const SimulationSettings settings = testing::shortSettings("uav", 1.0, 10);
  const RecordingFiles files = writeRecording(Simulation(settings), directory.path());
  const Config loaded = loadConfigFromFile(files.config);
  const Config meant = matchingConfig(settings);
  EXPECT_EQ(
      loaded.odometry.imu.noise.gyro_noise_density, meant.odometry.imu.noise.gyro_noise_density);
  EXPECT_EQ(loaded.sensors.imu_sensor_label, "imu");
}

TEST(Recording, GroundTruthIsThePoseAt200Hz)
{
  const Simulation simulation(testing::shortSettings("office", 4.0));
  std::istringstream lines(groundTruthText(simulation));
  std::string line;
  std::size_t count = 0;
  while (std::getline(lines, line))
  {
    if (line.front() == '#') continue;
    double t = 0, x = 0, y = 0, z = 0;
    std::istringstream(line) >> t >> x >> y >> z;
    const Vec3 p = simulation.motion().pose(0.005 * static_cast<double>(count)).p;
    ASSERT_LT((Vec3(x, y, z) - p).norm(), 2e-9);
    ++count;
  }
  EXPECT_EQ(count, 801U);
}

TEST(Recording, UnwritableDirectoriesAreNamed)
{
  const TemporaryFolder directory;
  const std::string file = directory.write("file", "no folder");
  const Simulation simulation(testing::shortSettings("rest", 0.5));
  try
  {
    (void)writeRecording(simulation, file + "/below");
    FAIL() << "a directory below a file was accepted";
  }
  catch (const std::runtime_error& e)
  {
    EXPECT_NE(std::string(e.what()).find(file), std::string::npos) << e.what();
  }
}

TEST(Recording, EveryScenarioGenerates)
{
  for (const auto& info : scenarioTable())
  {
    const TemporaryFolder directory;
    const Simulation simulation(testing::shortSettings(info.name, 3.5, 20));
    const RecordingFiles files = writeRecording(simulation, directory.path());
    EXPECT_GT(std::filesystem::file_size(files.rawlog), 50'000U) << info.name;
    EXPECT_GT(simulation.scan(20).points.size(), 200U) << info.name;
  }
}
}  // namespace
}  // namespace fastlio
