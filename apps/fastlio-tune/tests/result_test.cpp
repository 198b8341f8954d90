// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What is written of a result: only what is needed, and whatever the paths are.

#include "../needed_changes.h"
#include "../tuning_text.h"
#include "tune_fixture.h"

#include <nlohmann/json.hpp>

namespace fastlio::testing
{
namespace
{
class TuneResult : public Tune
{
 protected:
  /** The base, and the best set: other values of both keys. Neither effect is certain. */
  TuningResult better()
  {
    TuningResult result;
    const Trial base = knownSets(command_, inputs_).front();
    result.trials.sets = {base, trialOf(inputs_, {"1", "1"})};
    result.trials.runs = {judged(0.1), judged(0.05)};
    result.best = 1;
    result.left_out = judged(0.05);
    result.chosen = {result.trials.sets[1].values, result.trials.sets[1].values};
    result.conclusion = Conclusion::Better;
    result.effects = {{"lidar.min_range", {}, 1.9, false}, {"map.voxel_size", {}, 1.1, false}};
    return result;
  }

  static JudgedRuns judged(double error)
  {
    return {{RunState::Complete, error}, {RunState::Complete, error}};
  }

  /** Errors of the sets between the base and the best one. */
  void finish(double only_range, double only_voxel)
  {
    Evaluator evaluator(command_, inputs_);
    evaluator.add({trialOf(inputs_, {"1", base(1)}), trialOf(inputs_, {base(0), "1"})}, {0, 1});
    evaluator.add(
        {trialOf(inputs_, {base(0), base(1)}), knownSets(command_, inputs_).front()}, {0, 1});
    const double range = 1.0, voxel = 1.0;
    finishRuns(
        [&](const Config& config, const std::string&)
        {
          const bool new_range = config.odometry.lidar.min_range == range;
          const bool new_voxel = config.odometry.map.voxel_size == voxel;
          return outcomeOf(new_range ? only_range : new_voxel ? only_voxel : 0.1, 100.0);
        });
  }

  std::string base(std::size_t key) { return knownSets(command_, inputs_).front().values[key]; }
};

TEST_F(TuneResult, AKeyWhoseEffectMayBeChanceKeepsTheValueOfTheBase)
{
  finish(0.0505, 0.09);
  TuningResult result = better();
  Evaluator evaluator(command_, inputs_);
  keepNeededChanges(inputs_, evaluator, result);
  EXPECT_EQ(result.at_base, std::vector<std::string>{"map.voxel_size"});
  EXPECT_EQ(result.trials.sets[result.best].values, (Candidate{"1", base(1)}));
  EXPECT_EQ(result.conclusion, Conclusion::Better);
  for (const std::string& text :
       {toTable(command_, inputs_, result), toParameterFile(command_, inputs_, result)})
    EXPECT_NE(text.find(atBaseText(result)), std::string::npos) << text;
  const std::string file = toParameterFile(command_, inputs_, result);
  EXPECT_NE(file.find("lidar.min_range: " + base(0) + " -> 1\n"), std::string::npos) << file;
  EXPECT_EQ(file.find("map.voxel_size: " + base(1) + " -> "), std::string::npos) << file;
  EXPECT_EQ(
      nlohmann::json::parse(toJson(command_, inputs_, result))["kept_at_base"].dump(),
      R"(["map.voxel_size"])");
}

TEST_F(TuneResult, AKeyThatIsNeededStays)
{
  finish(0.06, 0.09);
  TuningResult result = better();
  Evaluator evaluator(command_, inputs_);
  keepNeededChanges(inputs_, evaluator, result);
  EXPECT_TRUE(result.at_base.empty()) << atBaseText(result);
  EXPECT_EQ(result.best, 1U);
}

TEST_F(TuneResult, CertainEffectsAreNotTriedAgain)
{
  TuningResult result = better();
  for (KeyEffect& effect : result.effects)
    effect.certain = true;
  Evaluator evaluator(command_, inputs_);
  keepNeededChanges(inputs_, evaluator, result);
  EXPECT_TRUE(result.at_base.empty());
}

TEST_F(TuneResult, APathThatIsNoUtf8IsWritten)
{
  inputs_.recordings[0].path = "/walk\xFF.rawlog";
  const TuningResult result = better();
  const auto json = nlohmann::json::parse(toJson(command_, inputs_, result));
  EXPECT_EQ(json["recordings"].size(), 2U);
  EXPECT_EQ(json["recordings"][1]["path"], "/b.rawlog");
}
}  // namespace
}  // namespace fastlio::testing
