// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file consistency_test.cpp Is the covariance right? Repeated simulated runs whose
 * noise is the filter's, each with another start, other noise, biases and gravity, at the same
 * instants.
 *
 * Only one sample per run goes into a mean: those of one run hang together. */

#include "consistency_case.h"
#include "repeats.h"
#include "simulated_run.h"
#include <fastlio/initialization/static_initializer.h>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

namespace fastlio::testing
{
namespace
{
constexpr std::uint64_t kRuns = 20;
constexpr double kDuration = 10.0;  // [s]
constexpr double kInstants[] = {6.0, 10.0};

/** Allowed mean NEES; 3 when consistent. Twenty runs of a consistent filter give a mean within 2.02
 * and 4.16 in 95 % of all cases; all of the twenty means below are within these bounds in 99 % of
 * all cases (chi-square with 60 degrees of freedom at 0.01/20, two-sided). Processors differ in the
 * last bit of their sums, and so in which points a run takes: every kind of them draws anew. */
constexpr double kMeanNeesLower = 1.45, kMeanNeesUpper = 5.28;
// Soon after the rest, in the narrow view of a Livox: the noise of simulated beams averages as it
// does nowhere else, and the map counts repeated beams for less than that.
constexpr double kMeanNeesLowerOfNarrowView = 1.0;

/** Of the components of biases and gravity; consistent: 0.997. The run to come is short and begins
 * at rest: a few seconds of noise limit the knowledge of a bias. */
constexpr double kShareWithin3Sigma = 0.96;

constexpr ConsistencyCase kCases[] = {
    {"OfficeVlp16", "office", LidarKind::Vlp16, 2}, {"OfficeOs64", "office", LidarKind::Os64, 4},
    {"UavLivox", "uav", LidarKind::Livox, 2},       {"CampusVlp16", "campus", LidarKind::Vlp16, 2},
    {"CampusOs64", "campus", LidarKind::Os64, 4},
};

/** Each run starts elsewhere: on one path in one world the same planes would be met from the same
 * places, and what the map makes of them would not be a sample but one and the same error. */
double pathStart(const ConsistencyCase& c, std::uint64_t seed)
{
  const double whole = Simulation(defaultSettings(c.scenario)).settings().duration;
  const double fraction = static_cast<double>((seed - 1) % kRuns) / static_cast<double>(kRuns);
  return fraction * (whole - kDuration);
}

/** The noise is white and Gaussian, and gravity as well known as the filter takes it to be. */
SimulationSettings settingsOf(const ConsistencyCase& c, std::uint64_t seed)
{
  SimulationSettings settings = defaultSettings(c.scenario);
  settings.lidar.kind = c.lidar;
  settings.lidar.stride = c.stride;
  settings.imu.vibration_gyro = settings.imu.vibration_accel = 0.0;
  settings.duration = kDuration;
  settings.seed = seed;
  settings.path_start = pathStart(c, seed);
  std::mt19937_64 random(seed);
  const InitializationOptions prior;
  settings.gravity = std::normal_distribution<double>(prior.gravity, kGravityStd)(random);
  return settings;
}

OdometryOptions parametersOf(const SimulationSettings& settings)
{
  OdometryOptions parameters = matchingParameters(settings);
  parameters.initialization.gravity = InitializationOptions{}.gravity;
  // The simulated sensors are as the options describe them.
  CalibrationOptions& calibration = parameters.calibration;
  calibration.extrinsic_rotation_std = calibration.extrinsic_translation_std = 0.0;
  calibration.imu_scale_std = calibration.imu_misalignment_std = 0.0;
  parameters.threads = 1;
  return parameters;
}

/** NEES of a block of three. */
double nees(const StateVector& error, const StateMatrix& P, StateBlock block)
{
  const Vec3 e = error.segment<3>(block);
  const Mat3 covariance = P.block<3, 3>(block, block);
  return e.dot(covariance.llt().solve(e));
}

/** The errors of the runs at one instant: an entry per run. */
struct Samples
{
  std::vector<double> attitude, position;
  std::size_t within_3_sigma = 0, components = 0;  // of biases and gravity
};

void add(Samples& samples, const StateVector& error, const StateMatrix& P)
{
  samples.attitude.push_back(nees(error, P, kAttitude));
  samples.position.push_back(nees(error, P, kPosition));
  for (int i = kGyroBias; i < kNavigationDim; ++i, ++samples.components)
    samples.within_3_sigma += std::abs(error[i]) <= 3.0 * std::sqrt(P(i, i)) ? 1 : 0;
}

/** One entry per instant. */
std::vector<Samples> samplesOf(const ConsistencyCase& c)
{
  std::vector<Samples> samples(std::size(kInstants));
  for (std::uint64_t seed = 1; seed <= repeats(kRuns); ++seed)
  {
    const SimulationSettings settings = settingsOf(c, seed);
    const SimulatedRun run = runOdometry(Simulation(settings), parametersOf(settings));
    EXPECT_EQ(countOf(run, ScanStatus::Diverged), 0U) << "seed " << seed;
    for (std::size_t i = 0; i < samples.size(); ++i)
    {
      const JudgedScan& scan = estimateAt(run, settings.start_ns, kInstants[i]);
      add(samples[i], stateError(run, scan), scan.result.filter.P);
    }
  }
  return samples;
}

double shareWithin3Sigma(const Samples& samples)
{
  return static_cast<double>(samples.within_3_sigma) / static_cast<double>(samples.components);
}

void expectConsistent(const NeesSummary& nees, double lower, const char* what)
{
  EXPECT_GE(nees.mean, lower) << what << ": the covariance is too large";
  EXPECT_LE(nees.mean, kMeanNeesUpper) << what << ": the covariance is too small";
}

void report(const ConsistencyCase& c, double instant, const Samples& samples)
{
  const NeesSummary attitude = summarizeNees(samples.attitude, 3);
  const NeesSummary position = summarizeNees(samples.position, 3);
  std::printf(
      "%-13s %4.0f s  NEES of attitude %5.2f, position %5.2f (95 %%: %.2f to %.2f); biases and "
      "gravity within 3 sigma: %.1f %%\n",
      c.name, instant, attitude.mean, position.mean, attitude.mean_lower, attitude.mean_upper,
      100.0 * shareWithin3Sigma(samples));
}
}  // namespace

class Consistency : public ::testing::TestWithParam<ConsistencyCase>
{
};

TEST_P(Consistency, IsKept)
{
  const ConsistencyCase& c = GetParam();
  const std::vector<Samples> all = samplesOf(c);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    SCOPED_TRACE(std::to_string(kInstants[i]) + " s");
    report(c, kInstants[i], all[i]);
    if (fewRepeats()) continue;
    const bool narrow = c.lidar == LidarKind::Livox;
    const double lower = narrow ? kMeanNeesLowerOfNarrowView : kMeanNeesLower;
    expectConsistent(summarizeNees(all[i].attitude, 3), lower, "attitude");
    expectConsistent(summarizeNees(all[i].position, 3), lower, "position");
    EXPECT_GE(shareWithin3Sigma(all[i]), kShareWithin3Sigma);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenario, Consistency, ::testing::ValuesIn(kCases),
    [](const auto& parameter) { return std::string(parameter.param.name); });

// The measure sees what it shall see: a filter that does not know of 10 ms between the clocks is
// overconfident. The mean of sixty runs shows it.
TEST(ConsistencyGates, FailWhenTheClocksDisagree)
{
  constexpr std::uint64_t kRunsThatShowIt = 3 * kRuns;
  const ConsistencyCase c{"office", "office", LidarKind::Vlp16, 8};
  std::vector<double> attitude, position;
  for (std::uint64_t seed = 1; seed <= kRunsThatShowIt; ++seed)
  {
    SimulationSettings settings = settingsOf(c, seed);
    settings.duration = 6.0;
    settings.lidar.time_offset = 0.01;
    OdometryOptions parameters = parametersOf(settings);
    parameters.lidar.time_offset = 0.0;
    parameters.calibration.estimate_time_offset = false;
    const SimulatedRun run = runOdometry(Simulation(settings), parameters);
    const StateVector error = stateError(run, run.scans.back());
    attitude.push_back(nees(error, run.scans.back().result.filter.P, kAttitude));
    position.push_back(nees(error, run.scans.back().result.filter.P, kPosition));
  }
  const NeesSummary p = summarizeNees(position, 3), a = summarizeNees(attitude, 3);
  EXPECT_GT(std::max(p.mean, a.mean), p.mean_upper);
}

}  // namespace fastlio::testing
