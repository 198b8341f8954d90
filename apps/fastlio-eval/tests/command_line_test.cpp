// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "eval_program.h"

#include <nlohmann/json.hpp>

namespace fastlio::testing
{
namespace
{
TEST_F(FastlioEval, PrintsATable)
{
  expectOutcome(
      "truth.tum estimate.tum --align first", 0,
      {"101 of 101 used", "APE translation", "1.0000 m (1.0000 % of 100.00 m)"});
  expectOutcome("-r truth.tum -e estimate.tum -a yaw", 0, {"alignment   yaw"});
}

TEST_F(FastlioEval, ANameWithPngGivesAPng)
{
  if (std::system("command -v rsvg-convert >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "there is no rsvg-convert (apt-get install librsvg2-bin)";
  expectOutcome("truth.tum estimate.tum -a first --plot p.png", 0, {"APE"});
  const std::string png = contentOf(folder_.file("p.png"));
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_GT(png.size(), 10'000U);
}

TEST_F(FastlioEval, WithoutItsProgramAPngIsRefusedAndNothingWritten)
{
  const Outcome outcome = runShell(
      "cd '" + folder_.path() +
      "' && PATH=/nowhere '" FASTLIO_EVAL_PROGRAM
      "' truth.tum estimate.tum -a first --plot p.png 2>&1");
  EXPECT_EQ(outcome.status, 1) << outcome.output;
  EXPECT_NE(outcome.output.find("librsvg2-bin"), std::string::npos) << outcome.output;
  EXPECT_FALSE(std::filesystem::exists(folder_.file("p.png")));
}

TEST_F(FastlioEval, APictureOfAnotherKindIsRefused)
{
  expectOutcome("truth.tum estimate.tum --plot p.jpg", 1, {"must end in .svg or .png", "p.jpg"});
  EXPECT_FALSE(std::filesystem::exists(folder_.file("p.jpg")));
}

TEST_F(FastlioEval, TooLittleMemoryIsSaidInWords)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizers reserve more than the limit";
#endif
  std::string text;
  for (int i = 0; i < 400'000; ++i)
    text += std::to_string(i) + " 1 2 3 0 0 0 1\n";
  write("long.tum", text);
  const Outcome outcome = runShell(
      "cd '" + folder_.path() +
      "' && ulimit -v 60000 && '" FASTLIO_EVAL_PROGRAM "' long.tum long.tum 2>&1");
  EXPECT_EQ(outcome.status, 1) << outcome.output;
  EXPECT_EQ(outcome.output, "fastlio-eval: there is not enough memory\n");
}

TEST_F(FastlioEval, HelpAndVersion)
{
  expectOutcome("--help", 0, {"--max-ape", "Exit status", "--kitti-times", "covariance.csv"});
  expectOutcome("--version", 0, {"fastlio-eval ", "."});
}

TEST_F(FastlioEval, JsonToStandardOutputAndToAFile)
{
  const Outcome outcome = run("truth.tum estimate.tum -a first --json -");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const auto json = nlohmann::json::parse(outcome.output);
  EXPECT_NEAR(json["end_to_end_drift"]["percent"].get<double>(), 1.0, 1e-9);

  expectOutcome("truth.tum estimate.tum -a first --json r.json --plot p.svg", 0, {"APE rotation"});
  EXPECT_EQ(nlohmann::json::parse(contentOf(folder_.file("r.json"))), json);
  EXPECT_EQ(contentOf(folder_.file("p.svg")).rfind("<svg ", 0), 0U);
}

TEST_F(FastlioEval, KeptLimitsExitWithZero)
{
  expectOutcome(
      "truth.tum estimate.tum -a first --max-ape 0.6 --max-ape-rotation 0.1 --max-rpe 0.11 "
      "--max-rpe-rotation 0.1 --max-drift 1.1 --max-drift-percent 1.1 --max-segment-percent 1.1 "
      "--min-coverage 99",
      0, {"passed  max-ape", "passed  min-coverage"});
}

TEST_F(FastlioEval, BrokenLimitsExitWithTwoAndSayWhich)
{
  const std::string evaluate = "truth.tum estimate.tum -a first ";
  expectOutcome(evaluate + "--max-drift 0.5", 2, {"--max-drift: 1 m, limit 0.5", "FAILED"});
  expectOutcome(
      evaluate + "--max-ape 0.1 --max-rpe 1 --max-drift-percent 0.5", 2,
      {"--max-ape: 0.578792 m, limit 0.1", "--max-drift-percent: 1 %, limit 0.5",
       "passed  max-rpe"});
  write("half.tum", tumLine(1.0).substr(0, 2000));
  expectOutcome("truth.tum half.tum -a first --min-coverage 90", 1, {"half.tum:", "columns"});
}

TEST_F(FastlioEval, AShortEstimateDoesNotPassForAGoodOne)
{
  const std::string text = tumLine(1.0);
  write("short.tum", text.substr(0, text.find("1700000005.0")));
  expectOutcome(
      "truth.tum short.tum -a first --max-ape 0.1 --min-coverage 90", 2, {"min-coverage"});
}

TEST_F(FastlioEval, CovariancesAddNees)
{
  write("covariance.csv", covarianceCsv());
  expectOutcome(
      "truth.tum covariance.csv -a first --max-nees 6 --max-nees-position 3 --max-nees-rotation 3",
      0, {"NEES", "pessimistic", "passed  max-nees "});
  expectOutcome("truth.tum covariance.csv -a first --max-nees-position 0.1", 2, {"limit 0.1"});
  expectOutcome("truth.tum estimate.tum -a first --max-nees 6", 1, {"covariance.csv"});
}

TEST_F(FastlioEval, KittiPosesNeedTimes)
{
  write("poses.txt", kittiLine());
  expectOutcome("poses.txt poses.txt -a first --kitti-rate 10", 0, {"101 of 101", "100.00 m"});
  expectOutcome("poses.txt poses.txt -a first", 1, {"poses.txt", "carry no time"});
  expectOutcome("poses.txt poses.txt --kitti-times none.txt", 1, {"none.txt", "does not exist"});
  expectOutcome("poses.txt poses.txt --kitti-times a --kitti-rate 10", 1, {"xclude"});
}

TEST_F(FastlioEval, WrongUsageExitsWithOne)
{
  expectOutcome("", 1, {"required"});
  expectOutcome("truth.tum", 1, {"estimate"});
  expectOutcome("truth.tum estimate.tum --nonsense", 1, {"--nonsense"});
  expectOutcome("truth.tum estimate.tum --align up", 1, {"up", "se3"});
  for (const char* limit : {"-1", "nan", "inf", "much"})
    expectOutcome(
        std::string("truth.tum estimate.tum --max-ape ") + limit, 1, {"a limit must be", limit});
  expectOutcome("truth.tum estimate.tum -a first --max-gap 0", 1, {"gap"});
  expectOutcome("truth.tum estimate.tum -a first --segment-lengths 5,-1", 1, {"segment"});
}

TEST_F(FastlioEval, UnusableInputExitsWithOneAndSaysWhere)
{
  expectOutcome("truth.tum none.tum", 1, {"none.tum", "does not exist"});
  expectOutcome("truth.tum .", 1, {"is a folder"});
  write("empty.tum", "");
  expectOutcome("truth.tum empty.tum", 1, {"empty.tum", "no data"});
  write("bad.tum", "1 0 0 0 0 0 0 1\n2 0 0 nan 0 0 0 1\n");
  expectOutcome("truth.tum bad.tum", 1, {"bad.tum:2", "finite"});
  write("early.tum", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  expectOutcome(
      "truth.tum early.tum", 1,
      {"1.000000000 to 2.000000000 s", "1700000000.000000000 to 1700000010.000000000 s"});
  expectOutcome("truth.tum estimate.tum -a se3", 1, {"on one line", "yaw"});
}

TEST_F(FastlioEval, UnwritableOutputExitsWithOne)
{
  const std::string evaluate = "truth.tum estimate.tum -a first ";
  expectOutcome(evaluate + "--json none/r.json", 1, {"none/r.json", "cannot write"});
  expectOutcome(evaluate + "--plot none/p.svg", 1, {"none/p.svg", "cannot write"});
  expectOutcome(evaluate + ">/dev/full", 1, {});
}

TEST_F(FastlioEval, ReportsDoNotReplaceInputsNorEachOther)
{
  const std::string estimate = contentOf(folder_.file("estimate.tum"));
  std::filesystem::create_hard_link(folder_.file("estimate.tum"), folder_.file("linked.tum"));
  std::filesystem::create_symlink("truth.tum", folder_.file("link.tum"));
  const std::string inputs = "truth.tum estimate.tum ";
  expectOutcome(inputs + "--json ./estimate.tum", 1, {"'estimate.tum' (--estimate)"});
  expectOutcome(inputs + "--plot linked.tum", 1, {"'linked.tum' (--plot)"});
  expectOutcome(inputs + "--plot link.tum", 1, {"'truth.tum' (--reference)"});
  expectOutcome(inputs + "--plot a --json ./a", 1, {"are the same file"});
  EXPECT_EQ(contentOf(folder_.file("estimate.tum")), estimate);
  expectOutcome(inputs + "-a yaw --plot /dev/null --json /dev/null", 0, {""});
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

}  // namespace
}  // namespace fastlio::testing
