// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Inertial samples are missing. For less than imu.max_gap nothing is re-initialised: scans are
// distorted, and the prediction behind the gap is uncertain.

#include "walks.h"
#include <fastlio/scenarios/realistic.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace fastlio::testing
{
namespace
{
/** No sample in \a length_s seconds of a walk that began at \a start_ns. */
AlteredInputs withGap(std::int64_t start_ns, double begin_s, double length_s)
{
  AlteredInputs inputs;
  inputs.imu = [=](ImuSample& sample)
  {
    const double t = toSeconds(sample.stamp_ns - start_ns);
    return t < begin_s || t >= begin_s + length_s;
  };
  return inputs;
}

SimulatedRun runWithGap(const CastWalk& walk, double begin_s, double length_s)
{
  return walk.runWith(withGap(walk.simulation.settings().start_ns, begin_s, length_s));
}

/** The largest standard deviation of the position in a run [m]. */
double mostUncertain(const SimulatedRun& run)
{
  double most = 0.0;
  for (const JudgedScan& scan : run.scans)
    most = std::max(most, positionStd(scan));
  return most;
}
}  // namespace

// Scans that the gap has distorted said that the platform sank by 0.3 m/s. From then on the ground
// was no part of the map that the scans fitted: 2 m off, with a standard deviation of 0.1 m.
TEST(GapOfTheImu, DoesNotMakeADistortedScanTellTheVelocity)
{
  const SimulatedRun run = runWithGap(castWalk("campus"), 16.0, 0.2);
  EXPECT_LT(positionError(run, run.scans.back()), 0.05);
}

// The prediction behind a gap is off by decimetres. Matched as ordinary scans are, it kept its
// wrong velocity, because a scan that this velocity has sheared confirms it: the map drifted along,
// by 0.7 to 3 m in six of these runs. Scans within the gap turned the state by 7 deg, and the
// search behind the gap was sure that the right place was wrong: 13 m off, where the gap began
// at 18.5 s.
TEST(GapOfTheImu, LeavesNoWrongVelocityBehind)
{
  const CastWalk& walk = castWalk("campus");
  for (double begin = 6.0; begin < 23.0; begin += 0.5)
  {
    const SimulatedRun run = runWithGap(walk, begin, 0.4);
    EXPECT_EQ(confidentlyWrong(run), 0) << begin;
    EXPECT_LT(positionError(run, run.scans.back()), 0.05) << begin;
  }
}

// The errors of the beams moved a scan that hardly counts as if it counted wholly: by metres.
TEST(GapOfTheImu, IsNoMoreUncertainThanTheInertialDataMakeIt)
{
  const CastWalk campus(realistic(walk("campus")));
  for (const double begin : {11.0, 13.0})
    EXPECT_LT(mostUncertain(runWithGap(campus, begin, 0.4)), 0.7) << begin;
}

// The start behind a long gap took the clocks as they were given: none was found in motion until
// the end of the run.
TEST(GapOfTheImu, IsLeftWithTheOffsetOfTheClocksThatWasFoundBefore)
{
  // After three seconds of shaking the map is found again by chance, half of the time.
  for (const auto& [scenario, begin_s] : {std::pair("campus", 10.0), std::pair("shake", 13.5)})
  {
    SCOPED_TRACE(scenario);
    SimulationSettings settings = walk(scenario);
    settings.lidar.time_offset = 0.01;
    OdometryOptions options = matchingParameters(settings);
    options.threads = 1;
    options.lidar.time_offset = 0.0;
    options.calibration.estimate_time_offset = true;
    const SimulatedRun run =
        runOdometryWith(withGap(settings.start_ns, begin_s, 3.0), Simulation(settings), options);
    EXPECT_LT(positionError(run, run.scans.back()), 0.05);
    EXPECT_NEAR(run.scans.back().result.filter.x.time_offset, -0.01, 0.0005);
  }
}

}  // namespace fastlio::testing
