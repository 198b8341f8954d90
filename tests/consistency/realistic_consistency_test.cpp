// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file realistic_consistency_test.cpp Does the covariance tell the truth for sensors as people have
 * them, and is the height as good as the rest? */

#include "consistency_case.h"
#include "repeats.h"
#include <fastlio/scenarios/realistic.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <vector>

namespace fastlio::testing
{
namespace
{
/** Mean NEES of a pose; 6 when the covariance is true. The covariance may be 1.4 times too large
 * and as much too small, in standard deviations. Before the errors of the calibration were
 * considered, the means were beyond 100. */
constexpr double kRealisticLower = 3.0, kRealisticUpper = 12.0;

constexpr std::uint64_t kAllRealisticRuns = 20;

struct RealisticCase : ConsistencyCase
{
  // A short ride tells little of how the LiDAR is mounted: the covariance may be larger.
  bool tells_mounting = true;
  bool level = true;       // the way is, so the height has no error of scale
  std::uint64_t runs = 6;  // of different seeds; twenty when everything is asked for
};

constexpr RealisticCase kRealisticCases[] = {
    {{"OfficeVlp16", "office", LidarKind::Vlp16, 2}, true, true, 10},
    {{"CampusVlp16", "campus", LidarKind::Vlp16, 2}},
    {{"CampusOs64", "campus", LidarKind::Os64, 4}},
};
/** Only when everything is asked for. */
constexpr RealisticCase kMoreRealisticCases[] = {
    {{"OfficeOs64", "office", LidarKind::Os64, 4}},
    {{"OfficeLivox", "office", LidarKind::Livox, 2}},
    {{"CampusLivox", "campus", LidarKind::Livox, 2}},
    {{"CarVlp16", "car", LidarKind::Vlp16, 2}, false},
    {{"CarOs64", "car", LidarKind::Os64, 4}, false},
    {{"CarLivox", "car", LidarKind::Livox, 2}, false},
    {{"UavVlp16", "uav", LidarKind::Vlp16, 2}, false},
    {{"UavOs64", "uav", LidarKind::Os64, 4}, false},
    {{"UavLivox", "uav", LidarKind::Livox, 2}, false},
    {{"StairsVlp16", "stairs", LidarKind::Vlp16, 2}, false, false},
    {{"StairsOs64", "stairs", LidarKind::Os64, 4}, false, false},
    {{"StairsLivox", "stairs", LidarKind::Livox, 2}, false, false},
};

std::vector<RealisticCase> realisticCases()
{
  std::vector<RealisticCase> cases(std::begin(kRealisticCases), std::end(kRealisticCases));
  if (everything())
    cases.insert(cases.end(), std::begin(kMoreRealisticCases), std::end(kMoreRealisticCases));
  return cases;
}

/** Sensors with what their datasheets admit, of which the odometry is told nothing. */
class RealisticConsistency : public ::testing::TestWithParam<RealisticCase>
{
};

constexpr double kRealisticInstants[] = {10.0, 20.0};

/** NEES of the pose; 6 is true. */
double poseNees(const SimulatedRun& run, const JudgedScan& scan)
{
  const Vector6 e = stateError(run, scan).head<6>();
  const Matrix6 P = scan.result.filter.P.topLeftCorner<6, 6>();
  return e.dot(solveSymmetric(P, e));
}

/** Squares of the errors that are left when all positions are aligned, summed over runs. */
struct DriftSquares
{
  double horizontal = 0.0, height = 0.0;  // [m^2]

  void add(const SimulatedRun& run)
  {
    const Trajectory estimate = estimateOf(run), truth = truthOf(run);
    const Pose T_ref_est = evaluate(estimate, truth, EvaluationOptions{}).alignment.T_ref_est;
    for (const JudgedScan& scan : run.scans)
    {
      const Vec3 error = T_ref_est * scan.result.filter.x.p - scan.truth.T_world_imu.p;
      horizontal += error.head<2>().squaredNorm();
      height += error.z() * error.z();
    }
  }
};

/** Of the height over the horizontal: what all lasers below the horizon have in common is in the
 * height alone. */
constexpr double kMostHeightDrift = 2.0;

TEST_P(RealisticConsistency, IsKeptWithDefaultParameters)
{
  const RealisticCase& c = GetParam();
  std::vector<double> nees[std::size(kRealisticInstants)];
  DriftSquares drift;
  const std::uint64_t runs = repeats(everything() ? kAllRealisticRuns : c.runs);
  for (std::uint64_t seed = 1; seed <= runs; ++seed)
  {
    SimulationSettings settings = defaultSettings(c.scenario);
    settings.lidar.kind = c.lidar;
    settings.lidar.stride = c.stride;
    settings.duration = kRealisticInstants[1];
    settings.seed = seed;
    settings = realistic(settings);
    OdometryOptions parameters = matchingParameters(settings);
    parameters.threads = 1;
    const SimulatedRun run = runOdometry(Simulation(settings), parameters);
    drift.add(run);
    for (std::size_t i = 0; i < std::size(kRealisticInstants); ++i)
      nees[i].push_back(poseNees(run, estimateAt(run, settings.start_ns, kRealisticInstants[i])));
  }
  for (std::size_t i = 0; i < std::size(kRealisticInstants); ++i)
  {
    const NeesSummary summary = summarizeNees(nees[i], 6);
    const auto worst = std::max_element(nees[i].begin(), nees[i].end());
    std::printf(
        "%-13s %4.0f s  NEES of the pose %5.2f, the largest %6.2f (seed %d)\n", c.name,
        kRealisticInstants[i], summary.mean, *worst, static_cast<int>(worst - nees[i].begin()) + 1);
    if (fewRepeats()) continue;
    const double lower = c.tells_mounting ? kRealisticLower : 0.0;
    EXPECT_GE(summary.mean, lower) << "the covariance is too large";
    EXPECT_LE(summary.mean, kRealisticUpper) << "the covariance is too small";
  }
  const double height_drift = std::sqrt(drift.height / drift.horizontal);
  std::printf("%-13s error of the height over the horizontal one %.2f\n", c.name, height_drift);
  if (fewRepeats() || !c.level) return;
  EXPECT_LE(height_drift, kMostHeightDrift);
}

INSTANTIATE_TEST_SUITE_P(
    Scenario, RealisticConsistency, ::testing::ValuesIn(realisticCases()),
    [](const auto& parameter) { return std::string(parameter.param.name); });

// A street that is new all the way: the same errors of the sensor are in the map and in each scan,
// and turn the vehicle to the same side, minute after minute.
TEST(LongRides, AreNotTooSureOfThemselves)
{
  const std::uint64_t first = everything() ? 7 : 8, last = everything() ? 12 : 10;
  std::vector<double> nees;
  for (std::uint64_t seed = first; seed <= (fewRepeats() ? first : last); ++seed)
  {
    SimulationSettings settings = defaultSettings("town");
    settings.world.length = 5000.0;
    settings.lidar.stride = 8;
    settings.duration = everything() ? 300.0 : 120.0;
    settings.seed = seed;
    settings = realistic(settings);
    OdometryOptions parameters = matchingParameters(settings);
    parameters.threads = 1;
    const SimulatedRun run = runOdometry(Simulation(settings), parameters);
    nees.push_back(poseNees(run, run.scans.back()));
    std::printf("Seed %2d: NEES of the last pose %5.2f\n", static_cast<int>(seed), nees.back());
  }
  const NeesSummary summary = summarizeNees(nees, 6);
  std::printf("Mean NEES %.2f\n", summary.mean);
  if (fewRepeats()) return;
  EXPECT_LE(summary.mean, kRealisticUpper) << "the covariance is too small";
}

// A view that changes all the time, near surfaces all around: the same lasers see new floor ahead
// and old floor below, turn after turn. The height drifts as they make it.
TEST(LongRides, KnowHowTheHeightDriftsOnARoundRamp)
{
  constexpr double kSettled = 10.0;  // from then on the vehicle is on its way [s]
  const std::uint64_t first = everything() ? 1 : 5, last = 8;
  std::vector<double> nees;
  for (std::uint64_t seed = first; seed <= (fewRepeats() ? first : last); ++seed)
  {
    SimulationSettings settings = defaultSettings("ramp");
    settings.lidar.stride = 4;
    settings.duration = 80.0;
    settings.seed = seed;
    settings = realistic(settings);
    OdometryOptions parameters = matchingParameters(settings);
    parameters.threads = 1;
    const SimulatedRun run = runOdometry(Simulation(settings), parameters);
    std::vector<double> of_run;
    for (const JudgedScan& scan : run.scans)
      if (toSeconds(scan.result.stamp_ns - settings.start_ns) > kSettled)
        of_run.push_back(poseNees(run, scan));
    nees.push_back(summarizeNees(of_run, 6).mean);
    std::printf("Seed %2d: mean NEES of the poses %5.2f\n", static_cast<int>(seed), nees.back());
  }
  const NeesSummary summary = summarizeNees(nees, 6);
  std::printf("Mean NEES %.2f\n", summary.mean);
  if (fewRepeats()) return;
  EXPECT_LE(summary.mean, kRealisticUpper) << "the covariance is too small";
}
}  // namespace
}  // namespace fastlio::testing
