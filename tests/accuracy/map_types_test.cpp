// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_types_test.cpp The fast map of planes against the paper's exact neighbours: speed is
 * not bought with accuracy. */

#include "simulated_run.h"

#include <gtest/gtest.h>

#include <ostream>

namespace fastlio::testing
{
namespace
{
/** A scenario, and how long and how densely it is run. */
struct Comparison
{
  const char* scenario;
  double duration;  // [s]
  int stride;       // of the LiDAR's columns
};

std::ostream& operator<<(std::ostream& out, const Comparison& comparison)
{
  return out << comparison.scenario;
}

// All but the tunnel, where both slide alike along an axis that nothing holds, and the places at
// rest, where both errors are below a millimetre or two.
constexpr Comparison kComparisons[] = {
    {"campus", 14, 6}, {"office", 14, 6}, {"uav", 12, 6},       {"car", 12, 8},   {"shake", 8, 16},
    {"spin", 8, 6},    {"stairs", 14, 6}, {"open_area", 14, 4}, {"crowd", 12, 6},
};

/** RMSE of the position with a map type [m]; first poses aligned. */
double positionError(const Simulation& simulation, MapType type)
{
  OdometryOptions parameters = matchingParameters(simulation.settings());
  parameters.threads = 1;
  parameters.map.type = type;
  const SimulatedRun run = runOdometry(simulation, parameters);
  EvaluationOptions options;
  options.alignment = Alignment::First;
  return evaluate(estimateOf(run), truthOf(run), options).ape.translation.rmse;
}
}  // namespace

class MapTypes : public ::testing::TestWithParam<Comparison>
{
};

TEST_P(MapTypes, PlanesAreAsAccurateAsExactNeighbors)
{
  const Comparison& comparison = GetParam();
  SimulationSettings settings = defaultSettings(comparison.scenario);
  settings.duration = comparison.duration;
  settings.lidar.stride = comparison.stride;
  settings.seed = 1;
  const Simulation simulation(settings);
  const double planes = positionError(simulation, MapType::Planes);
  const double reference = positionError(simulation, MapType::Knn);
  RecordProperty("planes_mm", std::to_string(1e3 * planes));
  RecordProperty("knn_mm", std::to_string(1e3 * reference));
  // A millimetre is chance: the errors of two seeds differ by more.
  EXPECT_LT(planes, 1.1 * reference + 0.001) << "m";
}

INSTANTIATE_TEST_SUITE_P(
    Scenario, MapTypes, ::testing::ValuesIn(kComparisons),
    [](const auto& parameter) { return std::string(parameter.param.scenario); });

}  // namespace fastlio::testing
