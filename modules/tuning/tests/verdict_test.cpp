// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/tuning/statistics.h>
#include <fastlio/tuning/verdict.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace fastlio
{
namespace
{
JudgedRuns runsOf(const std::vector<double>& errors)
{
  JudgedRuns runs;
  for (const double error : errors)
    runs.push_back({RunState::Complete, error});
  return runs;
}

const std::vector<std::size_t> kAll = {0, 1, 2};

TEST(Verdict, IncompleteRunsRankBehindEveryCompleteOne)
{
  const JudgedRuns base = runsOf({1, 1, 1});
  const Score slow = scoreOf(base, runsOf({9, 9, 9}), kAll);
  JudgedRuns previous = runsOf({9, 9, 9});
  for (const RunState state : {RunState::Degraded, RunState::Lost, RunState::Failed})
  {
    JudgedRuns runs = runsOf({0.1, 0.1, 0.1});
    runs[1].state = state;
    if (state == RunState::Failed) runs[1].error.reset();
    EXPECT_TRUE(slow < scoreOf(base, runs, kAll)) << toText(state);
    EXPECT_TRUE(scoreOf(base, previous, kAll) < scoreOf(base, runs, kAll)) << toText(state);
    EXPECT_EQ(bestTrial({base, runs}, kAll), 0U) << toText(state);
    previous = runs;
  }
}

TEST(Verdict, RunThatIsTruncatedForAllCountsByItsError)
{
  JudgedRuns base = runsOf({1, 1, 1});
  JudgedRuns other = runsOf({0.5, 0.5, 0.5});
  base[0].state = other[0].state = RunState::Truncated;
  EXPECT_EQ(bestTrial({base, other}, kAll), 1U);
}

TEST(Verdict, TrialThatEndsAFailureOfTheBaseIsBetter)
{
  JudgedRuns base = runsOf({1, 1, 1});
  base[2] = {};
  const JudgedRuns other = runsOf({1.02, 1.0, 0.3});
  EXPECT_EQ(bestTrial({base, other}, kAll), 1U);
  EXPECT_EQ(concludeFrom(base, other, other), Conclusion::Better);
}

TEST(Verdict, FewPosesBeforeALossAreNoError)
{
  JudgedRuns base = runsOf({0.001, 0.001, 0.001});
  for (Judged& run : base)
    run.state = RunState::Lost;
  const std::vector<JudgedRuns> trials = {base, runsOf({0.2, 0.2, 0.2}), runsOf({0.1, 0.1, 0.1})};
  EXPECT_EQ(bestTrial(trials, kAll), 2U);
  EXPECT_FALSE(ratioOf(base[0], trials[1][0]));
  EXPECT_EQ(concludeFrom(base, trials[2], trials[1]), Conclusion::Better);
}

TEST(Verdict, BetterStateDoesNotExcuseALargerError)
{
  JudgedRuns base = runsOf({1, 1, 1});
  base[1].state = RunState::Degraded;
  EXPECT_TRUE(isWorse(base[1], {RunState::Complete, 1.06}));
  EXPECT_FALSE(isWorse(base[1], {RunState::Complete, 1.04}));
  EXPECT_EQ(bestTrial({base, runsOf({1, 1.5, 1}), runsOf({1, 0.9, 1})}, kAll), 2U);
}

TEST(Verdict, BestMakesNoRecordingWorse)
{
  EXPECT_EQ(
      bestTrial({runsOf({1, 1, 1}), runsOf({0.1, 0.1, 1.2}), runsOf({0.9, 0.9, 0.9})}, kAll), 2U);
  EXPECT_EQ(bestTrial({runsOf({1, 1, 1}), runsOf({0.1, 0.1, 1.2})}, {0, 1}), 1U);
}

TEST(Verdict, ConcludesFromRecordingsLeftOut)
{
  const JudgedRuns base = runsOf({1, 1, 1});
  const JudgedRuns good = runsOf({0.5, 0.6, 0.5});
  EXPECT_EQ(concludeFrom(base, good, good), Conclusion::Better);
  EXPECT_EQ(concludeFrom(base, good, runsOf({0.5, 0.6, 1.06})), Conclusion::WorseOnLeftOut);
  EXPECT_EQ(concludeFrom(base, good, runsOf({1.0, 0.98, 1.0})), Conclusion::NothingBetter);
  EXPECT_EQ(concludeFrom(base, runsOf({0.97, 1, 0.96}), good), Conclusion::NothingBetter);
  EXPECT_EQ(concludeFrom(base, base, base), Conclusion::NothingBetter);
  EXPECT_EQ(concludeFrom(runsOf({1}), runsOf({0.5}), {}), Conclusion::TooFewRecordings);
  JudgedRuns lost = good;
  lost[1].state = RunState::Degraded;
  EXPECT_EQ(concludeFrom(base, good, lost), Conclusion::WorseOnLeftOut);
}

TEST(Statistics, RankCorrelation)
{
  EXPECT_DOUBLE_EQ(rankCorrelation({1, 2, 3, 4}, {10, 20, 30, 1000}), 1.0);
  EXPECT_DOUBLE_EQ(rankCorrelation({1, 2, 3}, {3, 2, 1}), -1.0);
  EXPECT_DOUBLE_EQ(rankCorrelation({1, 2, 3}, {5, 5, 5}), 0.0);
  // Ranks 0 1.5 1.5 3 and 0 1 3 2: 3 / sqrt(4.5 * 5).
  EXPECT_NEAR(rankCorrelation({1, 2, 2, 3}, {1, 2, 4, 3}), 3.0 / std::sqrt(22.5), 1e-12);
  EXPECT_THROW((void)rankCorrelation({1}, {1, 2}), std::invalid_argument);
}

TEST(Statistics, MainEffectFindsTheKeyThatMatters)
{
  SearchSpace space(2);
  space[0].key = "a.list";
  space[0].values = {"on", "off"};
  space[1].key = "b.range";
  space[1].min = 0;
  space[1].max = 9;
  std::vector<TriedPoint> points;
  for (int i = 0; i < 20; ++i)
    for (int b = 0; b < 9; ++b)
      points.push_back(
          {{i % 2 == 0 ? "on" : "off", std::to_string(b)}, std::exp(0.1 * b + 0.01 * (i % 2))});
  const auto effects = keyEffects(space, points);
  ASSERT_EQ(effects.size(), 2U);
  EXPECT_EQ(effects[0].key, "b.range");
  ASSERT_EQ(effects[0].levels.size(), 3U);
  EXPECT_EQ(effects[0].levels[1].values, "3 to 5");
  EXPECT_EQ(effects[0].levels[1].trials, 60U);
  EXPECT_NEAR(effects[0].levels[1].mean_ratio, 1.0, 1e-9);
  EXPECT_NEAR(effects[0].levels[0].mean_ratio, std::exp(-0.3), 1e-9);
  EXPECT_NEAR(effects[0].effect, std::exp(0.6), 1e-9);
  EXPECT_TRUE(effects[0].certain);
  EXPECT_NEAR(effects[1].effect, std::exp(0.01), 1e-9);
  EXPECT_FALSE(effects[1].certain);
}
}  // namespace
}  // namespace fastlio
