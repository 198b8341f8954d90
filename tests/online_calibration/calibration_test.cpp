// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file calibration_test.cpp Does the odometry find a wrong extrinsic and a wrong clock? Simulated
 * recordings whose calibration the filter does not know. */

#include "repeats.h"
#include "simulated_run.h"
#include <fastlio/math/angles.h>
#include <fastlio/scenarios/realistic.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace fastlio::testing
{
namespace
{
SimulationSettings officeWalk()
{
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 20.0;
  settings.lidar.stride = 4;
  return settings;
}

/** OdometryOptions as of a user who trusts what the sensors' files say. */
OdometryOptions unawareParameters(const SimulationSettings& settings)
{
  OdometryOptions parameters = matchingParameters(settings);
  parameters.lidar.time_offset = 0.0;
  parameters.threads = 1;
  return parameters;
}

double positionError(const SimulatedRun& run)
{
  EvaluationOptions options;
  options.alignment = Alignment::Se3;
  return evaluate(estimateOf(run), truthOf(run), options).ape.translation.rmse;
}

TEST(Calibration, FindsTheTimeOffset)
{
  for (const double offset : {-0.008, 0.008})
  {
    SimulationSettings settings = officeWalk();
    settings.lidar.time_offset = offset;
    OdometryOptions parameters = unawareParameters(settings);
    const SimulatedRun with = runOdometry(Simulation(settings), parameters);
    parameters.calibration.estimate_time_offset = false;
    const SimulatedRun without = runOdometry(Simulation(settings), parameters);
    const FilterState& end = with.scans.back().result.filter;
    EXPECT_NEAR(end.x.time_offset, -offset, 0.001) << "s";
    EXPECT_LT(std::sqrt(end.P(kTimeOffset, kTimeOffset)), 0.001) << "s";
    EXPECT_LT(positionError(with), 0.7 * positionError(without)) << "m";
  }
}

// An offset that is taken for constant stays behind by milliseconds, and is sure of itself.
TEST(Calibration, FollowsClocksThatDrift)
{
  SimulationSettings settings = officeWalk();
  settings.duration = 45.0;
  settings.lidar.hidden.clock_drift = 5e-5;
  OdometryOptions parameters = unawareParameters(settings);
  const SimulatedRun follows = runOdometry(Simulation(settings), parameters);
  parameters.calibration.time_offset_walk = 0.0;
  const SimulatedRun constant = runOdometry(Simulation(settings), parameters);
  const double truth = -settings.lidar.hidden.clock_drift * settings.duration;
  const FilterState &following = follows.scans.back().result.filter,
                    &staying = constant.scans.back().result.filter;
  const auto deviations = [&](const FilterState& end)
  { return std::abs(end.x.time_offset - truth) / std::sqrt(end.P(kTimeOffset, kTimeOffset)); };
  EXPECT_NEAR(following.x.time_offset, truth, 0.0005) << "s";
  EXPECT_LT(deviations(following), 3.0);
  EXPECT_GT(std::abs(staying.x.time_offset - truth), 0.0005) << "s";
  EXPECT_GT(deviations(staying), 3.0);
}

// Sixteen lasers do not average their errors out: they bend the path, the height above all.
TEST(Calibration, TakesTheOffsetsOfTheLasersOff)
{
  double with = 0.0, without = 0.0;
  for (const std::uint64_t seed : {1U, 2U})
  {
    SimulationSettings settings = defaultSettings("campus");
    settings.seed = seed;
    settings.duration = 60.0;
    settings.lidar.stride = 3;
    settings.lidar.beam.laser_range_std = 0.01;
    settings.lidar.beam.laser_elevation_std = 0.05 * kRadPerDeg;
    settings.lidar.beam.laser_azimuth_std = 0.05 * kRadPerDeg;
    OdometryOptions parameters = unawareParameters(settings);
    const SimulatedRun corrected = runOdometry(Simulation(settings), parameters);
    parameters.calibration.estimate_beams = false;
    const SimulatedRun given = runOdometry(Simulation(settings), parameters);
    with += positionError(corrected);
    without += positionError(given);
    const CalibrationCheck& check = corrected.scans.back().result.statistics.calibration;
    EXPECT_NEAR(check.range_offset, settings.lidar.beam.laser_range_std, 0.006) << seed;
    EXPECT_NEAR(kDegPerRad * check.azimuth_offset, 0.05, 0.02) << seed;
  }
  std::printf("position %.4f m, %.4f m with the offsets as given\n", with / 2.0, without / 2.0);
  EXPECT_LT(with, 0.85 * without) << "m";
}

// While few points of a scan find planes, what they show is not to be blamed on the clock.
TEST(Calibration, HoldsTheTimeOffsetUntilTheMapCanTellIt)
{
  SimulationSettings settings = defaultSettings("open_area");
  settings.duration = 12.0;
  settings.lidar.stride = 2;
  const OdometryOptions parameters = unawareParameters(settings);
  const SimulatedRun run = runOdometry(Simulation(settings), parameters);
  const auto estimated = [](const JudgedScan& scan)
  { return scan.result.filter.P(kTimeOffset, kTimeOffset) > 0.0; };
  const auto fraction = [](const JudgedScan& scan)
  {
    const ScanStatistics& s = scan.result.statistics;
    return static_cast<double>(s.points_effective) / static_cast<double>(s.points_downsampled);
  };
  const auto first = std::find_if(run.scans.begin(), run.scans.end(), estimated);
  ASSERT_NE(first, run.scans.end());
  ASSERT_GT(first - run.scans.begin(), 5);
  constexpr double kInlierRatio = 0.3;  // of a map that shows them
  for (auto scan = run.scans.begin(); scan + 1 != first; ++scan)
    EXPECT_LT(fraction(*scan), kInlierRatio);
  EXPECT_GE(fraction(*(first - 1)), kInlierRatio);
  EXPECT_TRUE(std::all_of(first, run.scans.end(), estimated));
}

// At rest velocity and rate are the errors of the estimate. An offset of the clocks times them
// would fit the residuals, the better the more scans there are per second.
TEST(Calibration, RestTellsNothingOfTheTimeOffset)
{
  SimulationSettings settings = defaultSettings("uav");
  settings.lidar.rate = 50.0;
  settings.duration = 2.3;
  const SimulatedRun run = runOdometry(Simulation(settings), unawareParameters(settings));
  const FilterState& end = run.scans.back().result.filter;
  EXPECT_GT(end.P(kTimeOffset, kTimeOffset), 0.0);
  EXPECT_LT(std::abs(end.x.time_offset), 1e-5) << "s";
}

/** Runs on scans that come with a wrong extrinsic: the true one is \a correction times theirs. */
SimulatedRun miscalibratedRun(const Pose& correction, const OdometryOptions& parameters)
{
  return runOdometryWithScans(
      Simulation(officeWalk()), parameters,
      [&](LidarScan& scan)
      {
        scan.T_imu_lidar = correction.inverse() * scan.T_imu_lidar;
        return true;
      });
}

TEST(Calibration, FindsTheExtrinsic)
{
  const Pose correction{expSO3(Vec3(0.02, -0.015, 0.01)), Vec3(0.03, -0.02, 0.0)};
  OdometryOptions parameters = unawareParameters(officeWalk());
  parameters.calibration.estimate_extrinsic = true;
  parameters.calibration.extrinsic_rotation_std = 0.02;  // as a user admits who guessed the pose
  parameters.calibration.extrinsic_translation_std = 0.03;
  const SimulatedRun run = miscalibratedRun(correction, parameters);
  const FilterState& end = run.scans.back().result.filter;
  const Pose error = correction.inverse() * end.x.extrinsic_correction;
  EXPECT_LT(logSO3(error.R).norm(), 0.01) << "rad; it was 0.027";
  // The walk turns about the vertical: it determines the horizontal position, the height hardly,
  // and the covariance says so.
  EXPECT_LT(error.p.head<2>().norm(), 0.015) << "m; it was 0.036";
  const Vec3 sigma = end.P.diagonal().segment<3>(kExtrinsicTranslation).cwiseSqrt();
  EXPECT_LT(sigma.head<2>().maxCoeff(), 0.01);
  EXPECT_GT(sigma.z(), 2.0 * sigma.head<2>().minCoeff());
  const Vector6 pose_error = stateError(run, run.scans.back()).head<6>();
  const Matrix6 P = end.P.topLeftCorner<6, 6>();
  EXPECT_LT(pose_error.dot(solveSymmetric(P, pose_error)), 22.5) << "chi-square of 6: 0.1 %";
}

// The first seconds see the ground and hardly anything else: what they leave open must not be
// blamed on the calibration, which is unsure then.
TEST(Calibration, KeepsItsWayWhereTheStartSeesLittle)
{
  SimulationSettings settings = defaultSettings("open_area");
  settings.duration = 14.0;
  OdometryOptions parameters = unawareParameters(settings);
  parameters.calibration.estimate_extrinsic = true;
  const SimulatedRun run = runOdometry(Simulation(settings), parameters);
  std::size_t open = 0;
  for (const JudgedScan& scan : run.scans)
    open += scan.result.statistics.constraints.unconstrained > 0 ? 1 : 0;
  EXPECT_GT(open, 10U);
  EXPECT_LT(open, run.scans.size() / 2);
  EXPECT_LT(positionError(run), 0.05) << "m";
}

// Beams with errors of their own and a few turns fit many an extrinsic. What is as wrong as
// datasheets admit is left to the covariance and to fastlio-calibrate.
TEST(Calibration, TheExtrinsicDoesNotGetWorse)
{
  const std::uint64_t seeds = everything() ? 5 : 1;
  std::vector<const char*> scenarios{"campus"};
  if (everything()) scenarios = {"campus", "office", "car", "uav", "stairs", "open_area"};
  for (const char* scenario : scenarios)
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
    {
      SimulationSettings settings = defaultSettings(scenario);
      settings.duration = everything() ? 40.0 : 14.0;
      settings.lidar.stride = 4;
      settings.seed = seed;
      settings = realistic(settings);
      OdometryOptions parameters = unawareParameters(settings);
      const Simulation simulation(settings);
      const double without = positionError(runOdometry(simulation, parameters));
      parameters.calibration.estimate_extrinsic = true;
      const double with = positionError(runOdometry(simulation, parameters));
      std::printf(
          "%-10s %2d  %.4f m, estimated %.4f m\n", scenario, static_cast<int>(seed), without, with);
      EXPECT_LT(with, 1.1 * without) << scenario << ", seed " << seed;
    }
}

TEST(Calibration, StaysAsGivenUnlessAskedFor)
{
  const Pose correction{expSO3(Vec3(0.01, 0.0, 0.0)), Vec3(0.02, 0.0, 0.0)};
  OdometryOptions parameters = unawareParameters(officeWalk());
  parameters.calibration.estimate_time_offset = false;
  const FilterState end = miscalibratedRun(correction, parameters).scans.back().result.filter;
  EXPECT_EQ(end.x.extrinsic_correction.R, Mat3::Identity());
  EXPECT_EQ(end.x.extrinsic_correction.p, Vec3::Zero());
  EXPECT_EQ(end.x.time_offset, 0.0);
}

TEST(Degeneracy, TheTunnelIsReportedAndItsCovarianceGrows)
{
  SimulationSettings settings = defaultSettings("tunnel");
  settings.duration = 12.0;
  settings.lidar.stride = 4;
  OdometryOptions parameters = unawareParameters(settings);
  const auto sigmaAlong = [&](double min_signal_to_noise, std::size_t& open)
  {
    parameters.measurement.min_signal_to_noise = min_signal_to_noise;
    const SimulatedRun run = runOdometry(Simulation(settings), parameters);
    for (const JudgedScan& scan : run.scans)
      open += scan.result.statistics.constraints.unconstrained > 0 ? 1 : 0;
    const Mat3 P = run.scans.back().result.filter.P.block<3, 3>(kPosition, kPosition);
    return std::sqrt(P.diagonal().maxCoeff());
  };
  std::size_t open = 0, open_when_off = 0;
  const double aware = sigmaAlong(MeasurementOptions{}.min_signal_to_noise, open);
  const double fooled = sigmaAlong(0.0, open_when_off);
  EXPECT_GT(open, 50U);
  EXPECT_EQ(open_when_off, 0U);
  EXPECT_GT(aware, 3.0 * fooled) << "m";
}
}  // namespace
}  // namespace fastlio::testing
