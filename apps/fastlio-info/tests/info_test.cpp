// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The program on simulated recordings whose truth is known: what it says is so.

#include "process.h"
#include "temporary_folder.h"
#include <fastlio/config/config_yaml.h>
#include <fastlio/scenarios/settings_table.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace fastlio::testing
{
namespace
{
using Json = nlohmann::json;
using Overrides = std::vector<std::pair<std::string, std::string>>;

constexpr double kRough = 0.01;  // motion within a scan is taken as steady [s]

class Info : public ::testing::Test
{
 protected:
  /** A short recording of a scenario. */
  std::string record(const std::string& scenario, const Overrides& overrides = {})
  {
    SimulationSettings settings = defaultSettings(scenario);
    settings.duration = 12.0;
    for (const auto& [key, value] : overrides)
      settings = withSetting(settings, key, value);
    return writeRecording(Simulation(settings), folder_.file(scenario)).rawlog;
  }

  /** Hand-held through rooms, with turns in all directions. */
  std::string walk(Overrides overrides)
  {
    overrides.insert(
        overrides.begin(), {{"lidar.kind", "os64"},
                            {"lidar.columns", "512"},
                            {"lidar.lines", "32"},
                            {"duration", "16"}});
    return record("office", overrides);
  }

  ProcessResult info(std::vector<std::string> arguments)
  {
    arguments.insert(arguments.begin(), FASTLIO_INFO_PROGRAM);
    return Process(arguments, folder_.file("log.txt")).wait();
  }

  Json jsonOf(const std::string& rawlog, int status = 0)
  {
    const auto result = info({rawlog, "--json", folder_.file("info.json")});
    EXPECT_EQ(result.exit_status, status) << result.output;
    table_ = result.output;
    return Json::parse(contentOf(folder_.file("info.json")));
  }

  void expectInTable(const std::string& text) const
  {
    EXPECT_NE(table_.find(text), std::string::npos) << "no '" << text << "' in:\n" << table_;
  }

  TemporaryFolder folder_;
  std::string table_;
};
}  // namespace

TEST_F(Info, ReportsSensorsAndImuOfAVelodyneRecording)
{
  const Json all = jsonOf(record("office"));
  ASSERT_EQ(all["sensors"].size(), 2U);
  const Json& lidar = all["lidars"][0];
  EXPECT_EQ(lidar["point_times"]["verdict"], "by_sensor");
  EXPECT_EQ(lidar["preset"], "velodyne_vlp16");
  EXPECT_EQ(lidar["lines"], 16);
  EXPECT_NEAR(lidar["elevation_deg"][1], 15.0, 0.5);
  EXPECT_GT(lidar["azimuth_coverage"], 0.9);
  for (const Json& sensor : all["sensors"])
  {
    const bool is_imu = sensor["kind"] == "imu";
    EXPECT_NEAR(sensor["rate_hz"], is_imu ? 200.0 : 10.0, 0.2);
    EXPECT_EQ(sensor["gaps"], 0);
  }
  const Json& imu = all["imu"];
  EXPECT_TRUE(imu["rests"]);
  EXPECT_NEAR(imu["rest_s"], 2.5, 0.6);
  EXPECT_EQ(imu["acceleration_unit"], "m/s^2");
  EXPECT_NEAR(imu["gravity"], 9.81, 0.1);
  EXPECT_NEAR(imu["gyro_noise_density"], 2e-4, 0.5e-4);
  EXPECT_NEAR(imu["acceleration_noise_density"], 2e-3, 0.5e-3);
  EXPECT_GT(all["overlap"]["share_of_lidar"], 0.95);
  expectInTable("fastlio-replay can run on this.");
  expectInTable("params/velodyne_vlp16.yaml");
}

TEST_F(Info, FindsTheTimeOffsetAndTheMounting)
{
  for (const char* offset : {"0", "0.06", "-0.15"})
  {
    const Json all = jsonOf(walk({{"lidar.time_offset", offset}}));
    const Json& motion = all["motion"];
    ASSERT_TRUE(motion["conclusive"]) << table_;
    // The lead of the LiDAR's clock has to be taken off its stamps.
    EXPECT_NEAR(motion["time_offset_s"], -std::stod(offset), kRough) << table_;
    EXPECT_NEAR(motion["imu_rate_over_lidar_rate"], 1.0, 0.1);
    // A walk turns about the vertical mostly, which does not determine the whole mounting.
    EXPECT_LT(motion.value("mounting_error_deg", 0.0), 5.0);
    const bool warned = all["warnings"].dump().find("lidar.time_offset") != std::string::npos;
    EXPECT_EQ(warned, std::string(offset) != "0") << all["warnings"];
  }
}

TEST_F(Info, IsNotMisledByTurnsThatChangeWithinAScan)
{
  const Json all = jsonOf(record("shake"));
  const Json& motion = all["motion"];
  ASSERT_TRUE(motion["conclusive"]) << table_;
  EXPECT_NEAR(motion["time_offset_s"], 0.0, 0.004) << table_;
  EXPECT_NEAR(motion["time_offset_s"], 0.0, 2 * motion["time_offset_std_s"].get<double>());
}

TEST_F(Info, SeesStampsAtTheEndOfScansWhoseTimesStartAtZero)
{
  // A driver that stamps scans at their end but counts times from their start.
  const Json all = jsonOf(walk({{"lidar.time_offset", "0.1"}}));
  EXPECT_EQ(all["lidars"][0]["point_times"]["reference"], "stamp");
  EXPECT_NEAR(all["motion"]["time_offset_s"], -0.1, kRough) << table_;
  expectInTable("input.point_time_reference");
}

TEST_F(Info, ReportsTheMeaningOfPointTimes)
{
  const Json all = jsonOf(record(
      "shake", {{"lidar.cloud", "generic"},
                {"lidar.point_time_unit", "us"},
                {"lidar.point_time_reference", "absolute"}}));
  const Json& times = all["lidars"][0]["point_times"];
  EXPECT_EQ(times["verdict"], "found");
  EXPECT_EQ(times["unit"], "us");
  EXPECT_EQ(times["reference"], "absolute");
  EXPECT_NEAR(times["end_s"], 0.1, 0.01);
  expectInTable("us since 1970");
  const Json none = jsonOf(record("shake", {{"lidar.cloud", "xyzi"}}));
  EXPECT_EQ(none["lidars"][0]["point_times"]["verdict"], "absent");
  expectInTable("times are made from the azimuth");
}

TEST_F(Info, SaysWhyReplayCannotRun)
{
  const auto missing = info({folder_.file("missing.rawlog")});
  EXPECT_EQ(missing.exit_status, 2);
  EXPECT_NE(missing.output.find("does not exist"), std::string::npos) << missing.output;
  const auto usage = info({});
  EXPECT_EQ(usage.exit_status, 1);
  // A clock of the LiDAR that is a minute ahead: the odometry gets nothing to do.
  const Json apart = jsonOf(record("shake", {{"lidar.time_offset", "10"}}));
  EXPECT_LT(apart["overlap"]["share_of_lidar"], 0.9);
  expectInTable("of the LiDAR's time only");
}

TEST_F(Info, ADamagedRecordingIsSaidToBeDamaged)
{
  const std::string rawlog = record("office", {{"duration", "6"}, {"lidar.stride", "4"}});
  std::filesystem::resize_file(rawlog, std::filesystem::file_size(rawlog) * 3 / 4);
  const Json all = jsonOf(rawlog);
  EXPECT_FALSE(all["problems"].empty());
  EXPECT_EQ(table_.find("can run on this."), std::string::npos) << table_;
  expectInTable("The recording is damaged");
  expectInTable("exit status 3");
}

TEST_F(Info, NumbersHaveUnitsAndNoSignOfZero)
{
  const Json all = jsonOf(record(
      "rest", {{"duration", "4"}, {"lidar.stride", "8"}, {"lidar.pose", "[0,0,0,0,-0.001,0]"}}));
  EXPECT_EQ(table_.find("-0.00 "), std::string::npos) << table_;
  expectInTable("rad/s at rest");
  expectInTable("m/s^2 at rest, up is");
  expectInTable("rad/s/sqrt(Hz), acceleration ");
}

TEST_F(Info, TheReportDoesNotReplaceTheRecording)
{
  const std::string rawlog = record("rest", {{"duration", "1"}, {"lidar.stride", "20"}});
  const std::string before = contentOf(rawlog);
  const auto result = info({rawlog, "--json", rawlog});
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_NE(result.output.find("is the same file as the input"), std::string::npos);
  EXPECT_TRUE(contentOf(rawlog) == before);
}

TEST_F(Info, GapsAreFound)
{
  const Json all = jsonOf(record("office", {{"imu.gap_interval", "3"}, {"imu.gap_length", "0.2"}}));
  for (const Json& sensor : all["sensors"])
    if (sensor["kind"] == "imu")
    {
      EXPECT_GE(sensor["gaps"], 2);
      EXPECT_NEAR(sensor["longest_interval_s"], 0.2, 0.02);
    }
  expectInTable("gaps, the longest of 0.2");
  jsonOf(record("rest", {{"duration", "8"}, {"imu.gap_interval", "4"}, {"imu.gap_length", "0.2"}}));
  expectInTable("1 gap of 0.2");
}

TEST_F(Info, RealRecordingsOfTheFolder)
{
  namespace fs = std::filesystem;
  const fs::path folder = MRPT_FASTLIO_RECORDINGS_DIR;
  if (folder.empty() || !fs::exists(folder / "euroc_v102.rawlog"))
    GTEST_SKIP() << "no recordings: MRPT_FASTLIO_RECORDINGS_DIR";
  const Json euroc = jsonOf((folder / "euroc_v102.rawlog").string());
  EXPECT_TRUE(euroc["usable"]);
  EXPECT_EQ(euroc["lidars"][0]["preset"], "velodyne_vlp16");
  EXPECT_EQ(euroc["imu"]["acceleration_unit"], "m/s^2");
  EXPECT_NEAR(euroc["imu"]["up"][0], 1.0, 0.1);  // its x axis points up
  // Vibration and fast turns: what is not certain is not claimed.
  if (euroc["motion"]["conclusive"])
  {
    EXPECT_NEAR(euroc["motion"]["time_offset_s"], 0.0, 0.01) << table_;
  }
  const Json office = jsonOf((folder / "office_vlp16.rawlog").string());
  ASSERT_TRUE(office["motion"]["conclusive"]) << table_;
  EXPECT_NEAR(office["motion"]["time_offset_s"], 0.0, 0.01);
  EXPECT_LT(office["motion"]["mounting_error_deg"], 5.0);
  const Json uav = jsonOf((folder / "uav_livox_xyzirt.rawlog").string());
  EXPECT_FALSE(uav["motion"]["conclusive"]) << "some of its scans match badly";
  ASSERT_TRUE(uav["motion"].contains("mounting_error_deg")) << table_;
  EXPECT_LT(uav["motion"]["mounting_error_deg"], 3.0);
}

TEST_F(Info, WritesTheParametersThatTheRecordingTells)
{
  const std::string rawlog = walk({{"imu.gyro_noise", "0.002"}, {"lidar.time_offset", "0.03"}});
  const std::string yaml = folder_.file("my.yaml");
  const auto written = info({rawlog, "--write-config", yaml});
  ASSERT_EQ(written.exit_status, 0) << written.output;
  const Config config = loadConfigFromFile(yaml);
  EXPECT_NO_THROW(validate(config));
  EXPECT_EQ(config.sensors.lidar_sensor_label, "lidar");
  EXPECT_EQ(config.sensors.imu_sensor_label, "imu");
  EXPECT_NE(config.sensors.point_time_unit, PointTimeUnit::Auto);
  EXPECT_GT(config.odometry.imu.noise.gyro_noise_density, 0.004);
  EXPECT_LT(config.odometry.imu.noise.gyro_noise_density, 0.006);
  EXPECT_NEAR(config.odometry.lidar.time_offset, -0.03, kRough);
  // Somebody may have edited it.
  const std::string before = contentOf(yaml);
  const auto again = info({rawlog, "--write-config", yaml});
  EXPECT_EQ(again.exit_status, 1);
  EXPECT_NE(again.output.find("is there already"), std::string::npos) << again.output;
  EXPECT_EQ(contentOf(yaml), before);
  EXPECT_EQ(info({rawlog, "--write-config", rawlog}).exit_status, 1);
}

TEST_F(Info, WrittenParametersKeepWhatIsGiven)
{
  const std::string rawlog = walk({});
  const std::string given = folder_.file("given.yaml"), yaml = folder_.file("my.yaml");
  std::ofstream(given) << "imu:\n  gyro_noise_density: 0.007\nmap:\n  voxel_size: 0.3\n";
  ASSERT_EQ(info({rawlog, "-c", given, "--write-config", yaml, "--no-motion"}).exit_status, 0);
  const Config config = loadConfigFromFile(yaml);
  EXPECT_EQ(config.odometry.imu.noise.gyro_noise_density, 0.007);
  EXPECT_NE(contentOf(yaml).find("voxel_size: 0.3  # given"), std::string::npos);
}

TEST_F(Info, NoParametersAreWrittenForWhatCannotBeUsed)
{
  const std::string empty = folder_.file("empty.rawlog"), yaml = folder_.file("my.yaml");
  std::ofstream(empty) << "";
  EXPECT_EQ(info({empty, "--write-config", yaml}).exit_status, 2);
  EXPECT_FALSE(std::filesystem::exists(yaml));
}

}  // namespace fastlio::testing
