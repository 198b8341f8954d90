// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "sample_trajectories.h"
#include <fastlio/evaluation/report.h>

#include <nlohmann/json.hpp>

namespace fastlio
{
namespace
{
using testing::expectThrows;

/** 100 m along x at 10 m/s, estimated 1 % too long, with covariances. */
EvaluationReport scaleErrorReport()
{
  Trajectory estimate = testing::line();
  estimate.source = "a \"quoted\" <name>";
  for (StampedPose& pose : estimate.poses)
  {
    pose.T_world_body.p *= 1.01;
    estimate.covariances.emplace_back(Matrix6::Identity());
  }
  EvaluationOptions options;
  options.alignment = Alignment::First;
  return evaluate(estimate, testing::line(), options);
}

TEST(Gates, EachLimitIsComparedWithItsMeasure)
{
  GateLimits limits;
  limits["max-ape"] = 10.0;
  limits["max-rpe"] = 0.05;
  limits["max-drift"] = 0.99;
  limits["max-drift-percent"] = 1.01;
  limits["max-nees"] = 100.0;
  limits["min-coverage"] = 100.0;
  const auto gates = checkGates(scaleErrorReport(), limits);
  ASSERT_EQ(gates.size(), 6U);
  EXPECT_TRUE(gates[0].passed);
  EXPECT_EQ(gates[1].name, "max-rpe");
  EXPECT_FALSE(gates[1].passed);
  EXPECT_NEAR(gates[1].measured, 0.1, 1e-9);
  EXPECT_EQ(gates[2].name, "max-drift");
  EXPECT_FALSE(gates[2].passed);
  EXPECT_NEAR(gates[3].measured, 1.0, 1e-9);
  EXPECT_TRUE(gates[3].passed);
  EXPECT_TRUE(gates[4].passed);
  EXPECT_TRUE(gates[5].passed);
  EXPECT_TRUE(checkGates(scaleErrorReport(), {}).empty());
}

TEST(Gates, AnglesAreInDegreesAndSegmentsInPerCent)
{
  EvaluationReport report = scaleErrorReport();
  report.ape.rotation.rmse = M_PI / 180.0;
  report.rpe_second.rotation.rmse = M_PI / 90.0;
  GateLimits limits;
  limits["max-ape-rotation"] = 0.5;
  limits["max-rpe-rotation"] = 3.0;
  limits["max-segment-percent"] = 2.0;
  const auto gates = checkGates(report, limits);
  ASSERT_EQ(gates.size(), 3U);
  EXPECT_NEAR(gates[0].measured, 1.0, 1e-12);
  EXPECT_FALSE(gates[0].passed);
  EXPECT_NEAR(gates[1].measured, 2.0, 1e-12);
  EXPECT_NEAR(gates[2].measured, 1.0, 1e-9);
}

TEST(Gates, AMeasureThatIsNotANumberFails)
{
  EvaluationReport report = scaleErrorReport();
  report.ape.translation.rmse = std::nan("");
  GateLimits limits;
  limits["max-ape"] = 1e9;
  EXPECT_FALSE(checkGates(report, limits).at(0).passed);
}

TEST(Gates, WhatWasNotMeasuredCannotBeChecked)
{
  EvaluationReport report = scaleErrorReport();
  report.nees.reset();
  report.segment_average.reset();
  report.rpe_second = {};
  report.drift.path_length = 0.0;
  const auto checking = [&report](const char* limit) {
    return [&report, limit] { (void)checkGates(report, {{limit, 1.0}}); };
  };
  expectThrows<std::invalid_argument>(checking("max-nees"), {"max-nees", "covariance"});
  expectThrows<std::invalid_argument>(checking("max-rpe"), {"max-rpe", "shorter"});
  expectThrows<std::invalid_argument>(
      checking("max-segment-percent"), {"max-segment-percent", "segment"});
  expectThrows<std::invalid_argument>(
      checking("max-drift-percent"), {"max-drift-percent", "does not move"});
  expectThrows<std::invalid_argument>(checking("max-nonsense"), {"no limit 'max-nonsense'"});
}

TEST(Report, JsonHoldsTheFigures)
{
  const EvaluationReport report = scaleErrorReport();
  GateLimits limits;
  limits["max-drift"] = 0.5;
  const auto json = nlohmann::json::parse(toJson(report, checkGates(report, limits)));
  EXPECT_EQ(json["estimate"], "a \"quoted\" <name>");
  EXPECT_EQ(json["association"]["used"], 101);
  EXPECT_NEAR(json["path_length_m"].get<double>(), 100.0, 1e-9);
  EXPECT_NEAR(json["ape"]["translation_m"]["max"].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(json["rpe_per_second"]["translation_m_per_s"]["rmse"].get<double>(), 0.1, 1e-9);
  EXPECT_NEAR(json["rpe_per_metre"]["translation_percent"]["rmse"].get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(json["end_to_end_drift"]["percent"].get<double>(), 1.0, 1e-9);
  EXPECT_EQ(json["segments"]["per_length"].size(), 5U);
  EXPECT_EQ(json["nees"]["position"]["degrees_of_freedom"], 3);
  EXPECT_EQ(json["alignment"]["type"], "first");
  EXPECT_FALSE(json["gates"][0]["passed"].get<bool>());
}

TEST(Report, TableAndJsonNameAHoleOfTheEstimate)
{
  Trajectory estimate = testing::line();
  estimate.poses.erase(estimate.poses.begin() + 21, estimate.poses.begin() + 60);
  EvaluationOptions options;
  options.alignment = Alignment::First;
  const EvaluationReport report = evaluate(estimate, testing::line(), options);
  EXPECT_NE(
      toTable(report).find("60.0 % of the reference's time; longest hole 4.00 s"),
      std::string::npos);
  const auto json = nlohmann::json::parse(toJson(report));
  EXPECT_NEAR(json["association"]["longest_hole_s"].get<double>(), 4.0, 1e-9);
  EXPECT_EQ(toTable(scaleErrorReport()).find("hole"), std::string::npos);
}

TEST(Report, SaysThatANearlyStraightPathLeavesATurnOpen)
{
  std::mt19937 random(5);
  const Trajectory truth = testing::line();
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses)
    pose.T_world_body.p += testing::gaussian(random, 0.03);
  Trajectory reference = truth;
  for (StampedPose& pose : reference.poses)
    pose.T_world_body.p.z() = 0.03 * std::sin(pose.T_world_body.p.x());
  const EvaluationReport report = evaluate(estimate, reference, {});
  EXPECT_NE(toTable(report).find("nearly straight"), std::string::npos);
  EXPECT_NE(toTable({{"a", report}, {"b", report}}).find("nearly straight"), std::string::npos);
  const auto json = nlohmann::json::parse(toJson(report));
  EXPECT_GT(json["alignment"]["uncertain_turn_deg"].get<double>(), 1.0);
  EXPECT_EQ(toTable(scaleErrorReport()).find("straight"), std::string::npos);
}

TEST(Report, AbsentMeasuresAreNull)
{
  Trajectory two = testing::line(2);
  two.source = "bytes \xff that are not UTF-8";
  EvaluationOptions options;
  options.alignment = Alignment::First;
  const EvaluationReport report = evaluate(two, two, options);
  const auto json = nlohmann::json::parse(toJson(report));
  EXPECT_TRUE(json["nees"].is_null());
  EXPECT_TRUE(json["segments"].is_null());
  EXPECT_TRUE(json["rpe_per_second"]["translation_m_per_s"].is_null());
  EXPECT_NE(toTable(report).find("shorter than the span"), std::string::npos);
}

TEST(Report, TableHasUnitsAndFitsTheTerminal)
{
  EvaluationReport report = scaleErrorReport();
  GateLimits limits;
  limits["max-drift"] = 0.5;
  const std::string table = toTable(report, checkGates(report, limits));
  for (const char* part :
       {"APE translation            m         0.5788",
        "RPE translation over 1 s   m/s       0.1000", "1.0000 m (1.0000 % of 100.00 m)",
        "101 of 101", "FAILED  max-drift", "position"})
    EXPECT_NE(table.find(part), std::string::npos) << part << "\n" << table;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(line.size(), 100U) << line;
}

TEST(Report, SvgDrawsBothPathsTheHeightAndTheErrors)
{
  const std::string svg = toSvg(scaleErrorReport());
  EXPECT_EQ(svg.rfind("<svg ", 0), 0U);
  std::size_t lines = 0;
  for (auto at = svg.find("<polyline"); at != std::string::npos; at = svg.find("<polyline", at + 1))
    ++lines;
  EXPECT_EQ(lines, 6U);
  for (const char* part : {"reference", "start", "z [m]", "x [m]", "time [s]", "[deg]", "</svg>"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Report, SvgOfALongRunKeepsThePeakAndStaysSmall)
{
  const Trajectory truth = testing::curve(10'000, 5'000'000);
  Trajectory estimate = truth;
  estimate.poses[2'345].T_world_body.p.z() += 5.0;
  EvaluationOptions options;
  options.alignment = Alignment::None;
  const std::string svg = toSvg(evaluate(estimate, truth, options));
  EXPECT_LT(svg.size(), 300'000U);
  EXPECT_NE(svg.find(">4<"), std::string::npos);  // a tick that only the peak reaches
}

}  // namespace
}  // namespace fastlio
