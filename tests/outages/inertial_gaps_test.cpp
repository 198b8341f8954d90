// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Inertial samples are missing for less than imu.max_gap, so that nothing is re-initialised: scans
// are distorted, and the prediction behind the gap is uncertain.

#include "walks.h"
#include <fastlio/scenarios/realistic.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace fastlio::testing
{
namespace
{
SimulatedRun runWithGap(const CastWalk& walk, double begin_s, double length_s)
{
  AlteredInputs inputs;
  inputs.imu = [&](ImuSample& sample)
  {
    const double t = walk.secondsAt(sample.stamp_ns);
    return t < begin_s || t >= begin_s + length_s;
  };
  return walk.runWith(std::move(inputs));
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
// by 0.7 to 3 m in six of these runs.
TEST(GapOfTheImu, LeavesNoWrongVelocityBehind)
{
  const CastWalk& walk = castWalk("campus");
  for (double begin = 6.0; begin < 23.0; begin += 1.0)
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

}  // namespace fastlio::testing
