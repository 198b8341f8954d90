// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Several estimates against one reference.

#include "eval_program.h"

#include <nlohmann/json.hpp>

namespace fastlio::testing
{
namespace
{
TEST_F(FastlioEval, SeveralEstimatesHaveARowEach)
{
  write("other.tum", tumLine(1.1));
  expectOutcome(
      "truth.tum estimate.tum other.tum -a first --plot p.svg", 0,
      {"reference   truth.tum", "APE max", "\nestimate.tum       101     100.0    0.5788    1.0000",
       "\nother.tum          101     100.0    5.7879   10.0000"});
  const std::string svg = contentOf(folder_.file("p.svg"));
  for (const char* part : {">estimate.tum<", ">other.tum<", ">reference<", ">start<", "Height"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  const auto json =
      nlohmann::json::parse(run("truth.tum -e estimate.tum -e other.tum -a first --json -").output);
  ASSERT_EQ(json["estimates"].size(), 2U);
  EXPECT_EQ(json["estimates"][1]["name"], "other.tum");
  EXPECT_NEAR(json["estimates"][1]["ape"]["translation_m"]["max"].get<double>(), 10.0, 1e-6);
}

TEST_F(FastlioEval, TheReferenceMayFollowTheEstimate)
{
  expectOutcome("-e estimate.tum truth.tum -a first", 0, {"estimate    estimate.tum"});
}

TEST_F(FastlioEval, AFolderOfARunIsItsTrajectory)
{
  std::filesystem::create_directory(folder_.file("one"));
  std::filesystem::create_directory(folder_.file("two"));
  std::filesystem::create_directory(folder_.file("empty"));
  write("one/trajectory.tum", tumLine(1.01));
  write("two/trajectory.tum", "damaged");
  write("two/covariance.csv", covarianceCsv());
  expectOutcome("truth.tum one -a first", 0, {"estimate    one/trajectory.tum"});
  expectOutcome("truth.tum one/ two -a first", 0, {"\none ", "\ntwo "});
  expectOutcome("truth.tum two -a first", 0, {"two/covariance.csv", "NEES"});
  expectOutcome("truth.tum one/trajectory.tum one -a first", 0, {"\ntrajectory.tum ", "\none "});
  expectOutcome("truth.tum one empty", 1, {"'empty' is a folder without covariance.csv"});
  expectOutcome(
      "truth.tum one two -a first --plot one/trajectory.tum", 1,
      {"'one/trajectory.tum' (--estimate)"});
}

TEST_F(FastlioEval, NamesThatAreTheSameAreGivenInFull)
{
  std::filesystem::create_directory(folder_.file("one"));
  write("one/estimate.tum", tumLine(1.1));
  expectOutcome(
      "truth.tum estimate.tum one/estimate.tum -a first", 0,
      {"\nestimate.tum ", "\none/estimate.tum "});
}

TEST_F(FastlioEval, WhatCannotBeUsedDoesNotKeepTheOthersFromBeingCompared)
{
  write("bad.tum", "damaged");
  write("other.tum", tumLine(1.1));
  expectOutcome(
      "truth.tum estimate.tum bad.tum other.tum -a first", 1,
      {"bad.tum is left out: ", "\nestimate.tum ", "\nother.tum "});
  expectOutcome("truth.tum bad.tum bad.tum", 1, {"bad.tum"});
}

TEST_F(FastlioEval, LimitsHoldForEachEstimate)
{
  write("other.tum", tumLine(1.1));
  expectOutcome(
      "truth.tum estimate.tum other.tum -a first --max-ape 1", 2,
      {"other.tum: limit not kept: --max-ape"});
}

}  // namespace
}  // namespace fastlio::testing
