// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Both sensors fall silent at once for less than imu.max_gap: their data are lost, or the clock
// that stamps them was set ahead. The data look the same, only the motion tells.

#include "repeats.h"
#include "walks.h"
#include <fastlio/scenarios/realistic.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <utility>

namespace fastlio::testing
{
namespace
{
constexpr double kRight = 0.2;  // [m]

const CastWalk& realisticOffice()
{
  static const CastWalk walk(
      []
      {
        SimulationSettings settings = fastlio::testing::walk("office");
        settings.lidar.stride = 4;
        return realistic(settings);
      }());
  return walk;
}

SimulatedRun runWithLoss(const CastWalk& walk, double begin_s, double length_s)
{
  const auto arrives = [&walk, begin_s, length_s](std::int64_t stamp_ns)
  {
    const double t = walk.secondsAt(stamp_ns);
    return t < begin_s || t >= begin_s + length_s;
  };
  AlteredInputs inputs;
  inputs.imu = [arrives](ImuSample& sample) { return arrives(sample.stamp_ns); };
  inputs.scan = [arrives](LidarScan& scan) { return arrives(scan.stamp_ns); };
  return walk.runWith(std::move(inputs));
}

SimulatedRun runWithStep(const CastWalk& walk, double begin_s, double step_s)
{
  const std::int64_t begin_ns = walk.simulation.settings().start_ns + toNanoseconds(begin_s);
  const std::int64_t step_ns = toNanoseconds(step_s);
  const auto set = [=](std::int64_t& stamp_ns)
  {
    if (stamp_ns >= begin_ns) stamp_ns += step_ns;
    return true;
  };
  AlteredInputs inputs;
  inputs.imu = [set](ImuSample& sample) { return set(sample.stamp_ns); };
  inputs.scan = [set](LidarScan& scan) { return set(scan.stamp_ns); };
  inputs.true_ns = [=](std::int64_t stamp_ns)
  { return stamp_ns >= begin_ns + step_ns ? stamp_ns - step_ns : stamp_ns; };
  return walk.runWith(std::move(inputs));
}
bool saysClockStep(const SimulatedRun& run)
{
  return std::any_of(
      run.scans.begin(), run.scans.end(),
      [](const JudgedScan& scan) { return scan.result.statistics.clock_step > 0.0; });
}

/** Runs at several instants. \return the part of them that ends where it should; none is wrong and
 * sure of it */
double partThatEndsRight(const std::function<SimulatedRun(double begin_s)>& runAt)
{
  int runs = 0, right = 0;
  for (double begin = 5.0; begin < 22.0; begin += everything() ? 0.5 : 2.0)
  {
    const SimulatedRun run = runAt(begin);
    const double error = positionError(run, run.scans.back());
    EXPECT_EQ(confidentlyWrong(run), 0) << begin << " s";
    std::printf("from %.1f s on: %.3f m off at the end\n", begin, error);
    ++runs;
    if (error < kRight) ++right;
  }
  return static_cast<double>(right) / runs;
}
}  // namespace

// The motion that bridged a silence that never was made the velocity wrong by 0.5 m/s: 3.6 m off at
// a standard deviation of 0.13 m, or lost.
TEST(SilentSensors, AClockThatIsSetAheadMovesNothing)
{
  for (const double step : {0.25, 0.45})
    EXPECT_GE(
        partThatEndsRight([&](double begin)
                          { return runWithStep(realisticOffice(), begin, step); }),
        step < 0.3 ? 0.75 : 0.65)
        << step << " s";
  EXPECT_TRUE(saysClockStep(runWithStep(realisticOffice(), 9.0, 0.25)));
}

// The scans behind the silence are deskewed with a velocity that is wrong by as much. Hardly one of
// them matched the map, nor did they match each other well enough to measure it: the run was lost.
TEST(SilentSensors, TheMapIsFoundAgainAfterALoss)
{
  EXPECT_GE(
      partThatEndsRight([](double begin) { return runWithLoss(realisticOffice(), begin, 0.45); }),
      0.55);
  EXPECT_FALSE(saysClockStep(runWithLoss(realisticOffice(), 9.0, 0.45)));
}

// A run that had started anew in motion did not look for planes as far as its prediction was
// uncertain, for good: the ground left the gate, and the run rose by 103 m.
TEST(SilentSensors, ARunThatStartsAnewKeepsTheGround)
{
  const SimulatedRun run = runWithStep(realisticOffice(), 15.5, 0.45);
  EXPECT_EQ(confidentlyWrong(run), 0);
  EXPECT_LT(positionError(run, run.scans.back()), 2.0);
}

}  // namespace fastlio::testing
