// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "closure_submaps.h"
#include "mapper_parts.h"
#include <fastlio/loops/mapper.h>
#include <fastlio/math/linear_algebra.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace fastlio
{
namespace
{
using testing::closureOf;
using testing::closureOfSecondPass;
using testing::planesAlong;
using testing::streetWithoutCorners;
using testing::submapAt;
using testing::surroundings;

constexpr double kFloor = 3.2;  // from one to the next that looks the same [m]

Submap roomsAt(double height, double height_std, double travel)
{
  static const Submap rooms = surroundings("office");
  return submapAt(rooms, height, height_std, travel);
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
  EXPECT_NE(closure.reason.find("at most 4.0"), std::string::npos) << closure.reason;
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
    const Closure closure = closureAtHeight(height, 4.0);
    EXPECT_EQ(closure.verdict, ClosureVerdict::Unpredicted) << closure.reason;
    EXPECT_NE(closure.reason.find("4.0 m uncertain"), std::string::npos) << closure.reason;
  }
}

/** Less than a third of what is in view, and the next floor is still within four deviations. */
TEST(ClosureJudgement, AFloorIsNotRecognisedWhereTheHeightIsUncertain)
{
  const Closure closure = closureAtHeight(kFloor, 0.8);
  ASSERT_TRUE(closure.registration.converged);
  EXPECT_EQ(closure.verdict, ClosureVerdict::Unpredicted) << closure.reason;
  EXPECT_FALSE(closure.needs_agreement) << "all floors of a building agree";
  EXPECT_NE(closure.reason.find("0.8 m uncertain in height"), std::string::npos) << closure.reason;
}

/** Where an odometry that is lost along x has rooms that were seen before.
 * \param ways along x, of submaps that are really all at the first one's place [m] */
std::vector<Closure> closuresOfALostOdometry(const std::vector<double>& ways)
{
  constexpr double kLost = 3.0;  // standard deviation [m]
  Mapper mapper;
  mapper.add(roomsAt(0.0, 0.0, 0.0));
  double travel = 60.0;
  for (const double way : ways)
  {
    Submap later = roomsAt(0.0, 0.0, travel += 5.0);
    later.reference.T_world_body.p.x() += way;
    later.reference.map_covariance(3, 3) = kLost * kLost;
    later.reference.covariance = later.reference.map_covariance + 1e-8 * Matrix6::Identity();
    mapper.add(std::move(later));
  }
  return mapper.closures();
}

/** A single place that looks like an earlier one may be the next room. */
TEST(AgreeingClosures, OneSubmapIsNotEnoughWhereTheOdometryWasLost)
{
  const std::vector<Closure> closures = closuresOfALostOdometry({2.0});
  ASSERT_EQ(closures.size(), 1U);
  EXPECT_TRUE(closures[0].needs_agreement) << closures[0].reason;
  EXPECT_EQ(closures[0].verdict, ClosureVerdict::Unpredicted);
}

TEST(AgreeingClosures, TwoSubmapsThatAgreeAreRecognised)
{
  const std::vector<Closure> closures = closuresOfALostOdometry({2.0, 2.1});
  ASSERT_EQ(closures.size(), 2U);
  for (const Closure& closure : closures)
  {
    EXPECT_EQ(closure.verdict, ClosureVerdict::Accepted) << closure.reason;
    EXPECT_NE(closure.reason.find("closures of 2 submaps agree"), std::string::npos);
    EXPECT_NEAR(closure.registration.motion.T_a_b.p.norm(), 0.0, 0.01);
  }
}

/** One of them is in the next room; nobody knows which. */
TEST(AgreeingClosures, TwoSubmapsThatContradictEachOtherAreNot)
{
  const std::vector<Closure> closures = closuresOfALostOdometry({2.0, -1.0});
  ASSERT_EQ(closures.size(), 2U);
  for (const Closure& closure : closures)
    EXPECT_EQ(closure.verdict, ClosureVerdict::Unpredicted) << closure.reason;
}

/** What contradicts has to be outvoted by two. */
TEST(AgreeingClosures, ThreeOutvoteOne)
{
  const std::vector<Closure> closures = closuresOfALostOdometry({-1.0, 2.0, 2.0, 2.0});
  ASSERT_EQ(closures.size(), 4U);
  EXPECT_EQ(closures[0].verdict, ClosureVerdict::Unpredicted) << closures[0].reason;
  for (std::size_t i = 1; i < closures.size(); ++i)
    EXPECT_EQ(closures[i].verdict, ClosureVerdict::Accepted) << closures[i].reason;
}

/** The first closure has waited for the third one to agree; by then, the second one was in the
 * graph. The verdict goes to the closure whose edge was turned off. */
TEST(AgreeingClosures, TheOneThatIsContradictedHasTheVerdict)
{
  MappingResult result;
  for (const std::size_t b : {1U, 2U, 3U})
  {
    Closure closure;
    closure.b = b;
    accept(closure, "");
    result.closures.push_back(closure);
  }
  const RelativePose any{};
  for (std::size_t a = 0; a < 3; ++a)
    result.graph.edges.push_back({a, a + 1, any, false});
  for (const std::size_t b : {2U, 1U, 3U})
    result.graph.edges.push_back({0, b, any, true});
  result.estimate.edge_weights = {1.0, 1.0, 1.0, 0.0, 1.0, 1.0};
  markContradicted(result);
  EXPECT_EQ(result.closures[0].verdict, ClosureVerdict::Accepted) << result.closures[0].reason;
  EXPECT_EQ(result.closures[1].verdict, ClosureVerdict::Contradicted) << result.closures[1].reason;
  EXPECT_EQ(result.closures[2].verdict, ClosureVerdict::Accepted) << result.closures[2].reason;
}

/** Streets have no floors, and a long ride drifts by metres before it comes back. */
TEST(ClosureJudgement, OutdoorsALongRideMayComeBack)
{
  const Submap street = surroundings("campus");
  const Closure closure =
      closureOf({submapAt(street, 0.0, 0.0, 0.0), submapAt(street, 3.0, 5.0, 60.0)});
  EXPECT_EQ(closure.verdict, ClosureVerdict::Accepted) << closure.reason;
}

/** What lies along the street stays as the odometry has it. The rest is worth knowing. */
TEST(ClosureJudgement, AStreetClosesWithItsDirectionOpen)
{
  const Closure closure = closureOfSecondPass(streetWithoutCorners(), 1.0);
  ASSERT_EQ(closure.verdict, ClosureVerdict::Accepted) << closure.reason;
  EXPECT_NE(closure.reason.find("one direction stays open"), std::string::npos) << closure.reason;
  const RelativePose& motion = closure.registration.motion;
  EXPECT_LT(motion.T_a_b.p.tail<2>().norm(), 0.02);
  EXPECT_GT(motion.covariance(3, 3), 1.0) << "along the street";
  EXPECT_LT(motion.covariance(4, 4), 0.01);
  EXPECT_LT(motion.covariance(5, 5), 0.01);
}

/** The next street may look the same, and so may the next corridor. */
TEST(ClosureJudgement, NoDirectionStaysOpenWhereAnotherPlaceMayBeMeant)
{
  const Submap street = streetWithoutCorners();
  ASSERT_LT(ClosureLimits{}.maxStd(street.range), 8.0);
  EXPECT_NE(closureOfSecondPass(street, 8.0).verdict, ClosureVerdict::Accepted);
  EXPECT_NE(closureOfSecondPass(surroundings("tunnel"), 1.0).verdict, ClosureVerdict::Accepted);
}

/** Between the walls of a stairwell. \param height_std how well the odometry knows the height [m]
 */
Closure closureBetweenWalls(double height_std)
{
  const Submap walls = planesAlong(Vec3::UnitZ(), surroundings("office"));
  return closureOf({submapAt(walls, 0.0, 0.0, 0.0), submapAt(walls, 0.4, height_std, 60.0)});
}

/** Walls tell the place on a floor, whatever the height is: along it, the registration stays where
 * the odometry has it, and not where the noise of the walls has pulled it. */
TEST(ClosureJudgement, AStairwellClosesWithItsHeightOpen)
{
  const Closure closure = closureBetweenWalls(0.5);
  ASSERT_EQ(closure.verdict, ClosureVerdict::Accepted) << closure.reason;
  EXPECT_NE(closure.reason.find("one direction stays open"), std::string::npos) << closure.reason;
  const RelativePose& motion = closure.registration.motion;
  EXPECT_NEAR(motion.T_a_b.p.z(), 0.4, 0.02);
  const Mat3 position = motion.covariance.bottomRightCorner<3, 3>();
  const auto system = symmetricEigensystem(position);
  EXPECT_GT(system.values[2], 1.0);
  EXPECT_LT(system.values[1], 0.01);
  // It leans a little, by the noise of the walls.
  const Vec3 open = system.vectors.col(2);
  EXPECT_GT(std::abs(open.z()), 0.98);
  EXPECT_LT((motion.T_a_b.p - open * open.dot(motion.T_a_b.p)).norm(), 0.02);
}

/** Where the next floor may be meant, its walls may be others. */
TEST(ClosureJudgement, AStairwellDoesNotCloseWhereTheFloorIsUncertain)
{
  EXPECT_NE(closureBetweenWalls(0.8).verdict, ClosureVerdict::Accepted);
}

/** Fronts with the same window every few metres: no closure tells them apart along the street. */
TEST(ClosureJudgement, WhatLooksTheSameAlongAStreetIsNoRival)
{
  Registration found;
  found.converged = true;
  found.evidence.overlap = found.evidence.upright_score = found.evidence.inlier_ratio = 0.9;
  found.evidence.planes_across = {20.0, 100.0, 200.0};
  found.evidence.margin = 5.0;
  found.evidence.margin_across = 50.0;
  ClosureLimits limits;
  ASSERT_TRUE(shortcomingOf(found, limits));
  EXPECT_EQ(shortcomingOf(found, limits)->verdict, ClosureVerdict::Ambiguous);
  limits.open_directions = 1;
  EXPECT_FALSE(shortcomingOf(found, limits));
  found.evidence.margin_across = 5.0;
  ASSERT_TRUE(shortcomingOf(found, limits));
  EXPECT_EQ(shortcomingOf(found, limits)->verdict, ClosureVerdict::Ambiguous);
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
