// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file modes_test.cpp The odometry on features: accuracy, what edges add, both gains, threads. */

#include "simulated_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

namespace fastlio::testing
{
namespace
{
SimulationSettings shortRun(const char* scenario, double duration)
{
  SimulationSettings settings = defaultSettings(scenario);
  settings.duration = duration;
  return settings;
}

OdometryOptions withFeatures(const SimulationSettings& settings, FeatureMode mode)
{
  OdometryOptions parameters = matchingParameters(settings);
  parameters.threads = 1;
  parameters.features.mode = mode;
  return parameters;
}

EvaluationReport evaluated(const SimulatedRun& run)
{
  EvaluationOptions options;
  options.alignment = Alignment::First;
  return evaluate(estimateOf(run), truthOf(run), options);
}

/** The limits of a scenario in both feature modes. */
struct FeatureGate
{
  const char* scenario;
  double duration;  // [s]
  double ape;       // RMSE [m]: 2 to 3 times the largest figure of seeds 1 to 3 and both modes
};

std::ostream& operator<<(std::ostream& out, const FeatureGate& gate)
{
  return out << gate.scenario;
}

constexpr FeatureGate kGates[] = {
    {"campus", 12, 0.008}, {"office", 12, 0.012}, {"shake", 7, 0.016}, {"uav", 9, 0.055}};
}  // namespace

class FeatureAccuracy : public ::testing::TestWithParam<FeatureGate>
{
};

TEST_P(FeatureAccuracy, IsKeptInBothModes)
{
  const SimulationSettings settings = shortRun(GetParam().scenario, GetParam().duration);
  const Simulation simulation(settings);
  for (const FeatureMode mode : {FeatureMode::Planar, FeatureMode::PlanarAndEdge})
  {
    const SimulatedRun run = runOdometry(simulation, withFeatures(settings, mode));
    EXPECT_EQ(countOf(run, ScanStatus::Diverged), 0U);
    EXPECT_LT(evaluated(run).ape.translation.rmse, GetParam().ape) << "m, mode " << int(mode);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenario, FeatureAccuracy, ::testing::ValuesIn(kGates),
    [](const auto& parameter) { return std::string(parameter.param.scenario); });

TEST(FeatureModes, EdgesAloneHoldThePose)
{
  const SimulationSettings settings = shortRun("office", 10.0);
  const Simulation simulation(settings);
  OdometryOptions parameters = withFeatures(settings, FeatureMode::PlanarAndEdge);
  parameters.downsampling.target_points = 1;  // next to nothing for planes
  parameters.features.half_width = 0.5;       // clear edges only: nothing else is left
  parameters.recovery.enabled = false;        // its search would take more points
  const SimulatedRun with_edges = runOdometry(simulation, parameters);
  EXPECT_EQ(countOf(with_edges, ScanStatus::Diverged), 0U);
  EXPECT_LT(evaluated(with_edges).ape.translation.rmse, 0.1);
  EXPECT_GT(with_edges.scans.back().result.statistics.points_effective, 40U);

  parameters.features.mode = FeatureMode::Planar;
  const SimulatedRun without = runOdometry(simulation, parameters);
  EXPECT_GT(countOf(without, ScanStatus::Diverged), 10U);
}

TEST(FeatureModes, PlanarLeavesOutWhatIsNotSmooth)
{
  const SimulationSettings settings = shortRun("office", 4.0);
  const Simulation simulation(settings);
  OdometryOptions parameters = withFeatures(settings, FeatureMode::None);
  parameters.downsampling.target_points = 0;
  const SimulatedRun direct = runOdometry(simulation, parameters);
  parameters.features.mode = FeatureMode::Planar;
  const SimulatedRun planar = runOdometry(simulation, parameters);
  const ScanStatistics& all = direct.scans.back().result.statistics;
  const ScanStatistics& smooth = planar.scans.back().result.statistics;
  EXPECT_LT(smooth.points_downsampled, all.points_downsampled * 9 / 10);
  EXPECT_GT(smooth.points_downsampled, all.points_downsampled / 4);
  EXPECT_EQ(smooth.dropped_near, all.dropped_near);
  EXPECT_EQ(smooth.dropped_far, all.dropped_far);
  EXPECT_EQ(smooth.dropped_invalid, all.dropped_invalid);
}

TEST(FeatureModes, BothGainsAgree)
{
  const SimulationSettings settings = shortRun("office", 5.0);
  const Simulation simulation(settings);
  OdometryOptions parameters = withFeatures(settings, FeatureMode::PlanarAndEdge);
  parameters.downsampling.target_points = 200;
  const SimulatedRun information = runOdometry(simulation, parameters);
  parameters.gain = GainForm::Standard;
  const SimulatedRun standard = runOdometry(simulation, parameters);
  ASSERT_EQ(information.scans.size(), standard.scans.size());
  const NavState &a = information.scans.back().result.filter.x,
                 &b = standard.scans.back().result.filter.x;
  EXPECT_LT((a.p - b.p).norm(), 1e-4);
  EXPECT_LT(logSO3(a.R.transpose() * b.R).norm(), 1e-5);
}

TEST(FeatureModes, GiveTheSameBitsOnAnyNumberOfThreads)
{
  const SimulationSettings settings = shortRun("office", 5.0);
  const Simulation simulation(settings);
  OdometryOptions parameters = withFeatures(settings, FeatureMode::PlanarAndEdge);
  const SimulatedRun one = runOdometry(simulation, parameters);
  parameters.threads = 3;
  const SimulatedRun three = runOdometry(simulation, parameters);
  ASSERT_EQ(one.scans.size(), three.scans.size());
  for (std::size_t i = 0; i < one.scans.size(); ++i)
  {
    const FilterState &a = one.scans[i].result.filter, &b = three.scans[i].result.filter;
    EXPECT_TRUE(a.x.p == b.x.p && a.x.R == b.x.R && a.P == b.P) << "scan " << i;
  }
}

}  // namespace fastlio::testing
