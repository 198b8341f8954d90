// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Runs of a search, judged against those of the base.

#include "tune_fixture.h"

namespace fastlio::testing
{
namespace
{
TEST_F(Tune, ARunThatIsMuchShorterThanThatOfTheBaseIsTruncated)
{
  Evaluator evaluator(command_, inputs_);
  const std::vector<Trial> sets = knownSets(command_, inputs_);
  const Trial shorter = trialOf(inputs_, {"1", "0.5"});
  const Trial about_as_long = trialOf(inputs_, {"1", "1"});
  const std::vector<Trial> tried = {sets.front(), shorter, about_as_long};
  evaluator.add(tried, {0, 1});
  finishRuns(
      [](const Config& config, const std::string& recording)
      {
        if (config.odometry.lidar.min_range != 1.0) return outcomeOf(0.1, 100.0);
        const bool cut = config.odometry.map.voxel_size == 0.5 && recording == "/b.rawlog";
        return outcomeOf(0.01, cut ? 89.0 : 91.0);
      });
  const std::vector<JudgedRuns> runs = evaluator.run(tried, {0, 1});
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0][1].state, RunState::Complete);
  EXPECT_EQ(runs[1][0].state, RunState::Complete);
  EXPECT_EQ(runs[1][1].state, RunState::Truncated);
  EXPECT_EQ(runs[2][1].state, RunState::Complete);
  EXPECT_EQ(bestTrial(runs, {0, 1}), 2U) << "its error is small because it ends early";
}

TEST_F(Tune, ARunWithoutTheMeasureHasFailed)
{
  Evaluator evaluator(command_, inputs_);
  const std::vector<Trial> base = {knownSets(command_, inputs_).front()};
  evaluator.add(base, {0, 1});
  finishRuns(
      [](const Config&, const std::string&) {
        return RunOutcome{RunState::Complete, {{"duration", 100.0}}, "", 0.5};
      });
  EXPECT_EQ(evaluator.run(base, {0}).front()[0].state, RunState::Failed);
}
}  // namespace
}  // namespace fastlio::testing
