// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// From one instant on a sensor is wrong: a cable, a driver, a hand in front of the LiDAR. The run
// stays right, or it is reported.

#include "strange_inputs.h"

#include "repeats.h"
#include "walks.h"
#include <fastlio/math/time.h>
#include <fastlio/scenarios/realistic.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace fastlio::testing
{
namespace
{
AlteredInputs from(const StrangeInput& strange, std::int64_t begin_ns)
{
  const std::int64_t end_ns = begin_ns + toNanoseconds(strange.length_s);
  const auto hit = [=](std::int64_t ns) { return ns >= begin_ns && ns < end_ns; };
  AlteredInputs inputs;
  inputs.imu = [=, change = strange.imu](ImuSample& sample) mutable
  {
    if (hit(sample.stamp_ns)) change(sample);
    return true;
  };
  inputs.scan = [=, change = strange.scan](LidarScan& scan) mutable
  { return !hit(scan.stamp_ns) || change(scan); };
  return inputs;
}

/** The least variance of a pose along any direction, in units of the largest: of all scans. */
double leastVariance(const SimulatedRun& run)
{
  double least = 1.0;
  for (const JudgedScan& scan : run.scans)
  {
    using Pose6 = Eigen::Matrix<double, 6, 6>;
    const Pose6 P = scan.result.filter.P.topLeftCorner<6, 6>();
    const auto variances = Eigen::SelfAdjointEigenSolver<Pose6>(P).eigenvalues().eval();
    least = std::min(least, variances[0] / variances[5]);
  }
  return least;
}

/** Sensors as exact as their options, or as imperfect as their datasheets. */
class StrangeInputs : public ::testing::TestWithParam<bool>
{
};

TEST_P(StrangeInputs, EndRightOrAreReported)
{
  SimulationSettings settings = walk("office");
  settings.duration = everything() ? 24.0 : 14.0;
  settings.lidar.stride = 4;
  if (GetParam()) settings = realistic(settings);
  const Simulation simulation(settings);
  std::vector<LidarScan> scans;
  for (std::size_t i = 0; i < simulation.scanCount(); ++i)
    scans.push_back(simulation.scan(i));
  OdometryOptions options = matchingParameters(settings);
  options.threads = 1;
  std::vector<StrangeInput> all = strangeImus();
  for (StrangeInput& strange : strangeScans())
    all.push_back(std::move(strange));
  // A few of them on each walk, unless everything is asked for.
  for (std::size_t i = everything() || !GetParam() ? 0 : 2; i < all.size();
       i += everything() ? 1 : 4)
  {
    AlteredInputs inputs = from(all[i], settings.start_ns + toNanoseconds(10.0));
    inputs.cast = &scans;
    const SimulatedRun run = runOdometryWith(inputs, simulation, options);
    EXPECT_GE(leastVariance(run), -1e-12) << all[i].name;
    const bool ok = endsOk(run);
    std::printf(
        "%-28s %s, error at the end %.3f m, standard deviation %.3f m\n", all[i].name.c_str(),
        ok ? "ok" : "reported", positionError(run, run.scans.back()),
        positionStd(run.scans.back()));
    if (!ok) continue;
    EXPECT_EQ(confidentlyWrong(run), 0) << all[i].name;
  }
}

/** A motor starts, and the accelerometer or the gyro is off from then on. Before the odometry
 * noticed it, it followed the accelerometer through the floor: 42 m in 14 s, at a standard
 * deviation of 0.5 m. */
class StepOfTheImu : public ::testing::TestWithParam<std::pair<Vec3, Vec3>>
{
};

TEST_P(StepOfTheImu, IsLearnedFromTheScans)
{
  SimulationSettings settings = walk("office");
  settings.duration = 14.0;
  settings.lidar.stride = 4;
  const Simulation simulation(settings);
  OdometryOptions options = matchingParameters(settings);
  options.threads = 1;
  StrangeInput step{"step", kForever};
  step.imu = [](ImuSample& sample)
  {
    sample.gyro += GetParam().first;
    sample.accel += GetParam().second;
  };
  const SimulatedRun run =
      runOdometryWith(from(step, settings.start_ns + toNanoseconds(8.0)), simulation, options);
  std::size_t steps = 0;
  for (const JudgedScan& scan : run.scans)
    steps += scan.result.statistics.inertial_step ? 1 : 0;
  EXPECT_GT(steps, 0U);
  EXPECT_EQ(confidentlyWrong(run), 0);
  EXPECT_LT(positionError(run, run.scans.back()), 0.05);
  const NavState& x = run.scans.back().result.filter.x;
  const ImuBias truth = run.scans.back().true_bias;
  EXPECT_LT((x.accel_bias - truth.accel - GetParam().second).norm(), 0.1);
  EXPECT_LT((x.gyro_bias - truth.gyro - GetParam().first).norm(), 0.005);
}

INSTANTIATE_TEST_SUITE_P(
    Of, StepOfTheImu,
    ::testing::Values(
        std::pair<Vec3, Vec3>{Vec3::Zero(), {0.1, -0.2, 0.5}},
        std::pair<Vec3, Vec3>{{0.0, 0.03, -0.02}, Vec3::Zero()}));

// The ground left the gate before the step was found: 27 to 62 m off, and sure of it.
TEST(StepOfTheAccelerometer, LosesNoPlaneThatShowsIt)
{
  for (const char* scenario : {"campus", "office", "car"})
    for (const Vec3& step : {Vec3(0, 0, -0.5), Vec3(0, 0.5, 0), Vec3(1, 0, 0)})
    {
      SCOPED_TRACE(::testing::Message() << scenario << ", " << step.transpose());
      const CastWalk& walk = castWalk(scenario);
      AlteredInputs inputs;
      inputs.imu = [&](ImuSample& sample)
      {
        sample.accel += (walk.secondsAt(sample.stamp_ns) < 8.0 ? 0.0 : 1.0) * step;
        return true;
      };
      const SimulatedRun run = walk.runWith(std::move(inputs));
      EXPECT_EQ(confidentlyWrong(run), 0);
      EXPECT_LT(positionError(run, run.scans.back()), 0.1);
    }
}

// Before the time offset was released with the biases, these took in what the clock did: 22 m. In
// some turns the walls leave the gate before it is learned. Such a run is never sure of its pose.
TEST(StepOfTheClock, IsLearnedFromTheScans)
{
  SimulationSettings settings = walk("office");
  settings.duration = 20.0;
  settings.lidar.stride = 4;
  const Simulation simulation(settings);
  OdometryOptions options = matchingParameters(settings);
  options.threads = 1;
  StrangeInput late{"late", kForever};
  late.scan = [](LidarScan& scan)
  {
    scan.stamp_ns += 100'000'000;
    return true;
  };
  int learned = 0;
  for (double begin = 8.0; begin < 14.5; begin += 1.0)
  {
    const SimulatedRun run =
        runOdometryWith(from(late, settings.start_ns + toNanoseconds(begin)), simulation, options);
    EXPECT_EQ(confidentlyWrong(run), 0) << begin << " s";
    const JudgedScan& last = run.scans.back();
    const bool offset_is_right = std::abs(last.result.filter.x.time_offset + 0.1) < 0.001;
    learned += positionError(run, last) < 0.05 && offset_is_right ? 1 : 0;
  }
  EXPECT_GE(learned, 4) << "of 7";
}

INSTANTIATE_TEST_SUITE_P(On, StrangeInputs, ::testing::Values(false, true));

}  // namespace
}  // namespace fastlio::testing
