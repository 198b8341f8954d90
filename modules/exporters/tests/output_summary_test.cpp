// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "output_test_support.h"
#include <fastlio/exporters/standard_exporters.h>

#include <nlohmann/json.hpp>

namespace fastlio
{
namespace
{
using testing::contentOf;
using testing::goodRun;
using testing::resultAt;
using testing::TemporaryFolder;
using Json = nlohmann::json;

TEST(RunStatistics, AddsUpAWalk)
{
  RunStatistics statistics;
  statistics.add(resultAt(0, ScanStatus::Initializing, 99.0, 500.0));
  for (int i = 1; i <= 101; ++i)
    statistics.add(
        resultAt(i, i == 1 ? ScanStatus::FirstScan : ScanStatus::Tracking, 0.5 * (i - 1), i));
  EXPECT_EQ(statistics.scans(), 102U);
  EXPECT_EQ(statistics.poses(), 101U);
  EXPECT_DOUBLE_EQ(statistics.pathLength(), 50.0);  // the position before the first pose is none
  EXPECT_DOUBLE_EQ(statistics.duration(), 10.2);
  EXPECT_DOUBLE_EQ(statistics.scanTimes().median, 51.0);
  EXPECT_DOUBLE_EQ(statistics.scanTimes().p99, 100.0);
  EXPECT_DOUBLE_EQ(statistics.scanTimes().max, 500.0) << "of all scans";
  EXPECT_EQ(statistics.points().in, 102U * 20000U);
  EXPECT_FALSE(statistics.firstTrouble());
}

TEST(RunSummary, NamesTheReasonWhereMostOfASensorIsLost)
{
  RunSummary run;
  EXPECT_TRUE(lossSentences(run).empty());
  run.input_counts = {{"imu_samples", 0}, {"imu_not_finite", 3001}, {"scans", 149}};
  EXPECT_EQ(
      lossSentences(run),
      (std::vector<std::string>{
          "3001 inertial samples were dropped: they hold values that are not finite"}));
  run.input_counts = {{"imu_samples", 100}, {"imu_duplicate", 50}, {"scans", 3}};
  EXPECT_TRUE(lossSentences(run).empty()) << "each one twice";
  run.input_counts.push_back({"scans_out_of_order", 2});
  ASSERT_EQ(lossSentences(run).size(), 1U);
  EXPECT_EQ(lossSentences(run)[0].find("2 scans were dropped"), 0U);
}

TEST(RunStatistics, RemembersTheFirstTroubleOnlySoMany)
{
  RunStatistics statistics;
  statistics.add(resultAt(0, ScanStatus::Tracking, 0, 1));
  for (int i = 1; i < 100; ++i)
    statistics.add(resultAt(i, ScanStatus::PredictionOnly, 0, 1));
  ASSERT_TRUE(statistics.firstTrouble());
  EXPECT_EQ(statistics.firstTrouble()->scan_index, 1U);
  EXPECT_EQ(statistics.troubles().size(), RunStatistics::kMaxTroubles);
  EXPECT_EQ(statistics.count(ScanStatus::PredictionOnly), 99U);
}

TEST(RunStatistics, WithoutAnyPoseTellsWhy)
{
  RunStatistics statistics;
  EXPECT_EQ(statistics.scanTimes().median, 0.0);
  EXPECT_FALSE(statistics.firstTrouble());
  statistics.add(resultAt(0, ScanStatus::Initializing, 0, 1));
  ASSERT_TRUE(statistics.firstTrouble());
  EXPECT_EQ(statistics.firstTrouble()->message, "because of \"this\"");
}

/** A scan in a tunnel along x. */
ScanResult tunnelScan(double signal_to_noise)
{
  ScanResult result = resultAt(1, ScanStatus::Tracking, 0, 1);
  ScanConstraints& constraints = result.statistics.constraints;
  constraints.unconstrained = 1;
  constraints.directions.col(0) = Vector6::Unit(3);
  constraints.information[0] = signal_to_noise;
  constraints.noise_information[0] = 1.0;
  return result;
}

TEST(RunStatistics, KnowsWhereDirectionsWereOpen)
{
  RunStatistics statistics;
  statistics.add(resultAt(0, ScanStatus::Tracking, 0, 1));
  EXPECT_EQ(statistics.degenerateDirections().scans, 0U);
  for (const double signal_to_noise : {4.0, 2.0, 3.0})
    statistics.add(tunnelScan(signal_to_noise));
  EXPECT_EQ(statistics.degenerateDirections().scans, 3U);
  EXPECT_EQ(statistics.degenerateDirections().signal_to_noise, 2.0);
  EXPECT_FALSE(statistics.degenerateDirections().weakest.is_rotation);
  EXPECT_EQ(statistics.degenerateDirections().weakest.axis, Vec3::UnitX());
}

Json writtenSummary(const RunSummary& run)
{
  const TemporaryFolder folder;
  const auto exporter = makeSummaryExporter(folder.file("summary.json"));
  const OutputMap map;
  exporter->finish({run, map});
  return Json::parse(contentOf(folder.file("summary.json")));
}

TEST(SummaryJson, DescribesTheRun)
{
  RunSummary run = goodRun();
  run.program = "fastlio-replay";
  run.inputs = {{"a \"quoted\" file.rawlog", 42}};
  run.input_counts = {{"imu_not_finite", 3}};
  run.sensors = {"LiDAR", "IMU"};
  run.wall_seconds = 0.01;
  run.outputs = {{"trajectory.tum", 7}};
  run.statistics.add(resultAt(1, ScanStatus::PredictionOnly, 3.0, 2));
  const Json json = writtenSummary(run);
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["exit_status"], 0);
  EXPECT_EQ(json["input"]["files"][0]["path"], "a \"quoted\" file.rawlog");
  EXPECT_EQ(json["input"]["counts"]["imu_not_finite"], 3);
  EXPECT_EQ(json["scans"]["prediction_only"], 1);
  EXPECT_EQ(json["scans"]["with_pose"], 2);
  EXPECT_DOUBLE_EQ(json["path_length_m"], 3.0);
  EXPECT_DOUBLE_EQ(json["time"]["real_time_factor"], 20.0);
  EXPECT_EQ(json["first_trouble"]["message"], "because of \"this\"");
  EXPECT_EQ(json["first_trouble"]["scan"], 1);
  EXPECT_EQ(json["outputs"][0]["bytes"], 7);
}

TEST(SummaryJson, HoldsEveryParameterWithItsType)
{
  RunSummary run = goodRun();
  run.options = {
      {"lidar.max_range", "77.5"},
      {"lidar.deskew", "true"},
      {"input.lidar_sensor_label", "[1]", true},
      {"map.type", "planes"},
      {"threads", "2"}};
  const Json parameters = writtenSummary(run)["parameters"];
  EXPECT_EQ(parameters["map"]["type"], "planes");
  EXPECT_EQ(parameters["threads"], 2);
  EXPECT_DOUBLE_EQ(parameters["lidar"]["max_range"], 77.5);
  EXPECT_EQ(parameters["lidar"]["deskew"], true);
  EXPECT_EQ(parameters["input"]["lidar_sensor_label"], "[1]");
}

TEST(SummaryJson, GivesTheFirstBadSecondAndItsCause)
{
  RunSummary run;
  ScanResult starting = resultAt(0, ScanStatus::Initializing, 0, 1);
  starting.health = {0.0, HealthCause::Starting, "collecting"};
  run.statistics.add(starting);
  run.statistics.add(resultAt(1, ScanStatus::Tracking, 0, 1));
  EXPECT_TRUE(writtenSummary(run)["health"]["first_trouble"].is_null());
  for (const double value : {0.4, 0.1})
  {
    ScanResult bad = resultAt(2, ScanStatus::Tracking, 0, 1);
    bad.health = {value, HealthCause::FewMatches, "few of them"};
    run.statistics.add(bad);
  }
  run.imu.spikes = 7;
  run.diagnostics = {{1'000'000'000, "the run is split"}};
  const Json json = writtenSummary(run);
  EXPECT_EQ(json["health"]["scans"], 3);
  EXPECT_EQ(json["health"]["troubled"], 2);
  EXPECT_DOUBLE_EQ(json["health"]["worst"], 0.1);
  EXPECT_EQ(json["health"]["causes"]["few_matches"], 2);
  const Json& first = json["health"]["first_trouble"];
  EXPECT_EQ(first["scan"], 2);
  EXPECT_DOUBLE_EQ(first["value"], 0.4);
  EXPECT_EQ(first["cause"], "few_matches");
  EXPECT_EQ(first["reason"], "few of them");
  EXPECT_EQ(json["imu"]["spikes"], 7);
  EXPECT_EQ(json["diagnostics"][0]["text"], "the run is split");
}

TEST(SummaryJson, SurvivesTextThatIsNotUtf8)
{
  RunSummary run = goodRun();
  run.input_problems = {"label '\xff\xfe'"};
  EXPECT_EQ(writtenSummary(run)["status"], "input_broken");
}

TEST(Summary, HasTheCalibrationThatWasAskedFor)
{
  RunSummary run;
  ScanResult result = resultAt(0, ScanStatus::Tracking, 0, 1);
  result.filter.x.time_offset = 0.004;
  result.filter.P(kTimeOffset, kTimeOffset) = 1e-6;
  result.filter.x.extrinsic_correction.p = {0.01, 0.02, 0.03};
  run.statistics.add(result);
  run.odometry.calibration.estimate_time_offset = false;
  EXPECT_TRUE(writtenSummary(run)["calibration"].is_null());
  run.odometry.lidar.time_offset = 0.001;
  run.odometry.calibration.estimate_time_offset = true;
  run.odometry.calibration.estimate_extrinsic = true;
  const Json calibration = writtenSummary(run)["calibration"];
  EXPECT_NEAR(double(calibration["time_offset_s"]), 0.005, 1e-12);
  EXPECT_NEAR(double(calibration["time_offset_sigma_s"]), 0.001, 1e-12);
  EXPECT_EQ(calibration["translation_correction_m"][2], 0.03);
  EXPECT_TRUE(calibration.contains("rotation_sigma_deg"));
}

TEST(Summary, GivesTheTimeOffsetOfTheOptionsUntilItIsObservable)
{
  RunSummary run;
  ScanResult result = resultAt(0, ScanStatus::Tracking, 0, 1);
  result.filter.P(kTimeOffset, kTimeOffset) = 0.0;
  run.statistics.add(result);
  const Json calibration = writtenSummary(run)["calibration"];
  EXPECT_EQ(calibration["time_offset_s"], 0.0);
  EXPECT_EQ(calibration["time_offset_sigma_s"], run.odometry.calibration.time_offset_std);
}

}  // namespace
}  // namespace fastlio
