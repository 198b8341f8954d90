// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "simulated_submaps.h"
#include <fastlio/loops/mapper.h>
#include <fastlio/math/time.h>
#include <fastlio/scenarios/settings_table.h>

#include <gtest/gtest.h>

#include <initializer_list>
#include <optional>

namespace fastlio
{
namespace
{
constexpr double kFloor = 3.2;  // from one to the next that looks the same [m]

/** What is seen in a few seconds. */
Submap surroundings(const char* scenario)
{
  SimulationSettings settings = defaultSettings(scenario);
  settings.duration = 5.0;
  settings.lidar.stride = 4;
  constexpr double kLong = 100.0;  // [m]: one submap holds all
  return testing::submapsOf(Simulation(settings), {kLong}).at(0);
}

/** The same submap after so much travel.
 * \param height by the odometry [m] \param height_std how well it knows, by its map [m] */
Submap submapAt(Submap submap, double height, double height_std, double travel)
{
  submap.reference.T_world_body.p.z() += height;
  submap.reference.stamp_ns += toNanoseconds(travel);  // at 1 m/s
  submap.reference.map_covariance.setZero();
  submap.reference.map_covariance(5, 5) = height_std * height_std;
  submap.reference.covariance = submap.reference.map_covariance + 1e-8 * Matrix6::Identity();
  submap.travel += travel;
  submap.gravity = std::nullopt;  // the accelerometer does not tell heights
  return submap;
}

Submap roomsAt(double height, double height_std, double travel)
{
  static const Submap rooms = surroundings("office");
  return submapAt(rooms, height, height_std, travel);
}

/** The one closure of these submaps. */
Closure closureOf(std::initializer_list<Submap> submaps)
{
  Mapper mapper;
  for (const Submap& submap : submaps)
    mapper.add(submap);
  EXPECT_EQ(mapper.closures().size(), 1U);
  return mapper.closures().empty() ? Closure{} : mapper.closures().front();
}

/** The closure between a submap and one later on that looks the same. */
Closure closureAtHeight(double height, double height_std)
{
  return closureOf({roomsAt(0.0, 0.0, 0.0), roomsAt(height, height_std, 60.0)});
}
}  // namespace

/** Whoever climbs stairs and comes to a floor like that below has not come back. The odometry of
 * such a walk was known to 0.53 m: six of its deviations are not a coincidence. */
TEST(ClosureJudgement, AFloorThatLooksTheSameIsOutOfReach)
{
  const Closure closure = closureAtHeight(kFloor, 0.53);
  EXPECT_EQ(closure.verdict, ClosureVerdict::OutOfReach) << closure.reason;
  EXPECT_NEAR(closure.registration.motion.T_a_b.p.norm(), 0.0, 0.01) << "it does look the same";
  EXPECT_NE(closure.reason.find("at most 2.5"), std::string::npos) << closure.reason;
}

TEST(ClosureJudgement, AnErrorThatTheOdometryKnowsOfIsNone)
{
  const Closure closure = closureAtHeight(0.8, 0.4);
  EXPECT_EQ(closure.verdict, ClosureVerdict::Accepted) << closure.reason;
  EXPECT_NEAR(closure.registration.motion.T_a_b.p.norm(), 0.0, 0.01);
}

/** An odometry that was lost by metres excludes neither this floor nor the next one. */
TEST(ClosureJudgement, WhereTheOdometryWasLostNoPlaceIsRecognised)
{
  for (const double height : {0.0, kFloor})
  {
    const Closure closure = closureAtHeight(height, 2.0);
    EXPECT_EQ(closure.verdict, ClosureVerdict::Unpredicted) << closure.reason;
    EXPECT_NE(closure.reason.find("4.0 m uncertain"), std::string::npos) << closure.reason;
  }
}

/** Less than half of what is in view, and the next floor is still within 2.5 deviations. */
TEST(ClosureJudgement, AFloorIsNotRecognisedWhereTheHeightIsUncertain)
{
  const Closure closure = closureAtHeight(kFloor, 0.7);
  ASSERT_TRUE(closure.registration.converged);
  EXPECT_EQ(closure.verdict, ClosureVerdict::Unpredicted) << closure.reason;
  EXPECT_NE(closure.reason.find("1.4 m uncertain in height"), std::string::npos) << closure.reason;
}

/** Streets have no floors, and a long ride drifts by metres before it comes back. */
TEST(ClosureJudgement, OutdoorsALongRideMayComeBack)
{
  const Submap street = surroundings("campus");
  const Closure closure =
      closureOf({submapAt(street, 0.0, 0.0, 0.0), submapAt(street, 3.0, 5.0, 60.0)});
  EXPECT_EQ(closure.verdict, ClosureVerdict::Accepted) << closure.reason;
}

/** On the way, the odometry has lost the height and has found it again where it knew it before.
 * What it was unsure of in between says nothing about where it is now. */
TEST(ClosureJudgement, AFloorIsOutOfReachAfterTheHeightWasLostAndFound)
{
  Submap lost = roomsAt(0.0, 4.0, 30.0);
  lost.reference.T_world_body.p.x() += 100.0;
  const Closure closure = closureOf({roomsAt(0.0, 0.0, 0.0), lost, roomsAt(kFloor, 0.53, 60.0)});
  EXPECT_EQ(closure.verdict, ClosureVerdict::OutOfReach) << closure.reason;
}

}  // namespace fastlio
