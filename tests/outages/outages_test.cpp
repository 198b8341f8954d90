// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Scans are missing for a while in motion: the odometry finds its pose again, or says that it has
// lost it. What it must never do is to go on from a wrong pose and to be sure of it.

#include "repeats.h"
#include "walks.h"
#include <fastlio/math/time.h>
#include <fastlio/scenarios/realistic.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace fastlio::testing
{
namespace
{
struct Outage
{
  double begin_s, length_s;
};

/** The data that the outage takes away. */
enum class Missing
{
  Scans,  //!< no scan arrives
  Points  //!< scans arrive, nearly without points
};

PointColumns firstOf(const PointColumns& points, std::size_t count)
{
  PointColumns first;
  for (std::size_t i = 0; i < count && i < points.size(); ++i)
    first.push_back(
        points.x[i], points.y[i], points.z[i], points.intensity[i], points.time_offset_ns[i],
        points.ring[i]);
  return first;
}

SimulatedRun runWithOutage(const CastWalk& walk, const Outage& outage, Missing missing)
{
  AlteredInputs inputs;
  inputs.scan = [&](LidarScan& scan)
  {
    const double t = walk.secondsAt(scan.stamp_ns);
    if (t < outage.begin_s || t >= outage.begin_s + outage.length_s) return true;
    if (missing == Missing::Points) scan.points = firstOf(scan.points, 5);
    return missing == Missing::Points;
  };
  return walk.runWith(std::move(inputs));
}

class OutageOfTheLidar : public ::testing::TestWithParam<std::tuple<std::string, double>>
{
};

TEST_P(OutageOfTheLidar, IsNeverFollowedByAWrongPoseThatIsSureOfItself)
{
  const auto& [scenario, length] = GetParam();
  const CastWalk& walk = castWalk(scenario);
  // An outage begins at every second in the full grid, at two of them here.
  const double step = everything() ? 1.0 : 6.0;
  for (double begin = 6.0; begin + length < 23.0; begin += step)
  {
    const SimulatedRun run = runWithOutage(walk, {begin, length}, Missing::Scans);
    EXPECT_EQ(confidentlyWrong(run), 0) << length << " s from " << begin << " s on";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sample, OutageOfTheLidar,
    ::testing::Combine(::testing::Values("office", "campus"), ::testing::Values(3.0, 8.0)),
    [](const auto& instance)
    {
      return std::get<0>(instance.param) + "For" +
             std::to_string(static_cast<int>(std::get<1>(instance.param))) + "Seconds";
    });

TEST(OutageOfTheLidar, OfASecondIsForgottenAfterwards)
{
  const SimulatedRun run = runWithOutage(castWalk("campus"), {12.0, 1.0}, Missing::Scans);
  EXPECT_EQ(countOf(run, ScanStatus::Diverged), 0U);
  EXPECT_LT(positionError(run, run.scans.back()), 0.1);
}

TEST(OutageOfTheLidar, OfFiveSecondsIsFoundAgainWhereTheMapIsSeen)
{
  const SimulatedRun run = runWithOutage(castWalk("campus"), {12.0, 5.0}, Missing::Scans);
  EXPECT_EQ(run.scans.back().result.status, ScanStatus::Tracking);
  EXPECT_LT(positionError(run, run.scans.back()), 0.1);
  const auto found = std::find_if(
      run.scans.begin(), run.scans.end(),
      [](const JudgedScan& scan)
      { return scan.result.message.find("found again") != std::string::npos; });
  EXPECT_NE(found, run.scans.end());
}

// Meanwhile the platform has entered another room: what the scans see is not in the map. The
// inertial data have the pose to 0.2 m; a new start, in motion and from nothing, ended 40 m off.
TEST(OutageOfTheLidar, OfFiveSecondsMayEndInARoomThatIsNew)
{
  const SimulatedRun run = runWithOutage(castWalk("office"), {10.0, 5.0}, Missing::Scans);
  EXPECT_EQ(confidentlyWrong(run), 0);
  EXPECT_EQ(countOf(run, ScanStatus::FirstScan), 2U);
  EXPECT_EQ(run.scans.back().result.status, ScanStatus::Tracking);
  EXPECT_LT(positionError(run, run.scans.back()), 0.5);
  EXPECT_FALSE(endsOk(run));
}

// Through the door a part of the old room is in view. The prediction was right to centimetres, but
// wide gates pulled it away.
TEST(OutageOfTheLidar, OfThreeSecondsIsFoundAgainWhereLittleOfTheMapIsSeen)
{
  const SimulatedRun run = runWithOutage(castWalk("office"), {10.0, 3.0}, Missing::Scans);
  EXPECT_EQ(countOf(run, ScanStatus::FirstScan), 1U);
  EXPECT_LT(positionError(run, run.scans.back()), 0.03);
}

// A stairwell looks the same on every floor, and the floor where the platform is has not been seen
// before. The velocity that the scans measure after the outage excludes the other floors. So a new
// map begins at the prediction, and the run is never lost.
TEST(OutageOfTheLidar, TheFloorsOfAStairwellAreNotTakenForEachOther)
{
  const SimulatedRun run = runWithOutage(castWalk("stairs"), {15.0, 5.0}, Missing::Scans);
  EXPECT_EQ(confidentlyWrong(run), 0);
  EXPECT_EQ(countOf(run, ScanStatus::Diverged), 0U);
  EXPECT_EQ(countOf(run, ScanStatus::FirstScan), 2U);
  EXPECT_EQ(run.scans.back().result.status, ScanStatus::Tracking);
  EXPECT_LT(positionError(run, run.scans.back()), 1.0);
  EXPECT_FALSE(endsOk(run));
}

// Where the velocity is not known well enough, a floor that looks the same is found. The run is
// reported, and the covariance contains the right floor (37 sigma off before).
TEST(OutageOfTheLidar, APlaceThatLooksTheSameIsInTheCovariance)
{
  SimulationSettings settings = walk("stairs");
  settings.lidar.stride = 4;
  const CastWalk stairs(realistic(settings));
  int wrong_floors = 0;
  for (const double begin : {8.5, 10.0, 11.5, 14.0, 14.5, 15.0})
  {
    const SimulatedRun run = runWithOutage(stairs, {begin, 7.5}, Missing::Scans);
    EXPECT_EQ(confidentlyWrong(run), 0) << begin << " s";
    if (positionError(run, run.scans.back()) < 1.0) continue;
    ++wrong_floors;
    EXPECT_FALSE(endsOk(run)) << begin << " s";
  }
  EXPECT_GT(wrong_floors, 0) << "the right floor was found each time";
}

// Walls fit at any height. The height that was found was off by 2 m, and the way there was taken
// for an error of the velocity: the pose rose by another 0.7 m every second (11 m off in the end).
TEST(OutageOfTheLidar, APlaceThatMayBeWrongSaysNothingAboutTheVelocity)
{
  SimulationSettings settings = walk("stairs");
  settings.duration = 30.0;
  settings.lidar.stride = 2;
  const SimulatedRun run =
      runWithOutage(CastWalk(realistic(settings)), {18.0, 4.0}, Missing::Scans);
  EXPECT_EQ(confidentlyWrong(run), 0);
  EXPECT_LT(positionError(run, run.scans.back()), 4.0);
}

double attitudeStd(const JudgedScan& scan)
{
  return std::sqrt(scan.result.filter.P.diagonal().segment<3>(kAttitude).sum());
}

// The pose where a new map begins contains the errors of the old map, and no scan takes them off.
TEST(OutageOfTheLidar, ANewMapIsNoMoreCertainThanTheOldOne)
{
  const SimulatedRun run = runWithOutage(castWalk("stairs"), {15.0, 5.0}, Missing::Scans);
  const auto begins_map = [](const JudgedScan& scan)
  { return scan.result.status == ScanStatus::FirstScan; };
  const auto first = std::find_if(run.scans.begin(), run.scans.end(), begins_map);
  ASSERT_NE(first, run.scans.end());
  const auto anew = std::find_if(first + 1, run.scans.end(), begins_map);
  ASSERT_NE(anew, run.scans.end()) << "the old map was found again";
  EXPECT_GE(attitudeStd(*anew), 0.95 * attitudeStd(*(anew - 1)));
  EXPECT_GE(positionStd(*anew), 0.95 * positionStd(*(anew - 1)));
  for (auto scan = anew; scan != run.scans.end(); ++scan)
  {
    const double error = stateError(run, *scan).segment<3>(kAttitude).norm();
    EXPECT_LT(error, 3.0 * attitudeStd(*scan));
  }
}

// Few points of a car's first scans match each other, so a new map has to take scans that match
// nothing yet. They stand as accurately in it as ever, however uncertain its own pose is.
TEST(OutageOfTheLidar, OfACarIsFollowedByANewMapThatGrows)
{
  const SimulatedRun run = runWithOutage(castWalk("car"), {7.2, 5.0}, Missing::Scans);
  EXPECT_EQ(confidentlyWrong(run), 0);
  EXPECT_EQ(countOf(run, ScanStatus::FirstScan), 2U);
  EXPECT_EQ(run.scans.back().result.status, ScanStatus::Tracking);
}

TEST(OutageOfTheLidar, ScansWithoutPointsAreAnOutageToo)
{
  const SimulatedRun run = runWithOutage(castWalk("office"), {10.0, 6.0}, Missing::Points);
  EXPECT_EQ(confidentlyWrong(run), 0);
}

}  // namespace
}  // namespace fastlio::testing
