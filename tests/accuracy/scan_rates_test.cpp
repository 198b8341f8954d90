// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_rates_test.cpp Nothing assumes 10 scans per second. */

#include "simulated_run.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace fastlio::testing
{
namespace
{
/** A sensor at a rate, and what must be kept. */
struct RateCase
{
  const char* scenario;
  double rate;      // [Hz]
  double duration;  // [s]
  double ape;       // RMSE [m]: 2 to 3 times the largest figure of seeds 1 to 3
};

std::ostream& operator<<(std::ostream& out, const RateCase& c)
{
  return out << c.scenario << " at " << c.rate << " Hz";
}

constexpr RateCase kCases[] = {{"office", 5, 12, 0.009},  {"office", 20, 12, 0.007},
                               {"office", 50, 10, 0.005}, {"office", 100, 8, 0.004},
                               {"uav", 5, 10, 0.03},      {"uav", 50, 10, 0.04}};
}  // namespace

class ScanRate : public ::testing::TestWithParam<RateCase>
{
};

TEST_P(ScanRate, TracksEveryScan)
{
  const RateCase& c = GetParam();
  SimulationSettings settings = defaultSettings(c.scenario);
  settings.duration = c.duration;
  settings.lidar.rate = c.rate;
  settings.lidar.stride = 2;
  const SimulatedRun run = runOdometry(settings);
  // Every complete sweep has a result, at the rate of the sensor.
  EXPECT_NEAR(static_cast<double>(run.scans.size()), c.rate * c.duration, 2.0);
  EXPECT_EQ(countOf(run, ScanStatus::Diverged), 0U);
  EXPECT_EQ(countOf(run, ScanStatus::PredictionOnly), 0U);
  const auto first = run.scans[run.scans.size() / 2].result.stamp_ns;
  const auto second = run.scans[run.scans.size() / 2 + 1].result.stamp_ns;
  EXPECT_NEAR(1e9 / static_cast<double>(second - first), c.rate, 0.15 * c.rate);
  EvaluationOptions options;
  options.alignment = Alignment::First;
  const EvaluationReport report = evaluate(estimateOf(run), truthOf(run), options);
  EXPECT_LT(report.ape.translation.rmse, c.ape) << "m";
}

INSTANTIATE_TEST_SUITE_P(
    Case, ScanRate, ::testing::ValuesIn(kCases),
    [](const auto& parameter)
    {
      return std::string(parameter.param.scenario) + "_" +
             std::to_string(static_cast<int>(parameter.param.rate)) + "Hz";
    });

}  // namespace fastlio::testing
