// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file session_test.cpp The same world on other days. */

#include "rides.h"
#include <fastlio/scenarios/scenario.h>
#include <fastlio/scenarios/session_changes.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace fastlio
{
namespace
{
using Bodies = std::vector<Primitive>;

Scene sceneOn(std::string_view scenario, int session, double changes)
{
  const WorldSettings settings{1200.0, session, changes};
  Scene scene = findScenario(scenario).scene(settings);
  applySession(scene, settings);
  return scene;
}

bool same(const Primitive& a, const Primitive& b)
{
  return a.shape == b.shape && a.size == b.size && a.T_world_local.p == b.T_world_local.p &&
         a.T_world_local.R == b.T_world_local.R;
}

bool same(const Bodies& a, const Bodies& b)
{
  return a.size() == b.size() &&
         std::equal(
             a.begin(), a.end(), b.begin(),
             [](const Primitive& one, const Primitive& other) { return same(one, other); });
}

bool holds(const Bodies& bodies, const Primitive& body)
{
  return std::any_of(
      bodies.begin(), bodies.end(), [&](const Primitive& other) { return same(body, other); });
}

class EveryChangingWorld : public ::testing::TestWithParam<std::string_view>
{
};

TEST_P(EveryChangingWorld, KeepsAllThatCannotBeMoved)
{
  const Scene first = sceneOn(GetParam(), 0, 0.5), other = sceneOn(GetParam(), 3, 0.5);
  ASSERT_FALSE(first.movable.empty());
  std::vector<bool> can_be_moved(first.world.bodies.size(), false);
  for (const Movable& m : first.movable)
    for (std::size_t i = m.first; i < m.first + m.count; ++i)
      can_be_moved[i] = true;
  std::size_t fixed = 0;
  for (std::size_t i = 0; i < can_be_moved.size(); ++i)
  {
    if (can_be_moved[i]) continue;
    ++fixed;
    EXPECT_TRUE(holds(other.world.bodies, first.world.bodies[i])) << "body " << i;
  }
  EXPECT_GT(fixed, 20U);
  EXPECT_FALSE(same(first.world.bodies, other.world.bodies));
}

TEST_P(EveryChangingWorld, DependsOnTheSessionOnly)
{
  const Bodies first = sceneOn(GetParam(), 0, 0.5).world.bodies;
  EXPECT_TRUE(same(first, sceneOn(GetParam(), 0, 1.0).world.bodies));
  EXPECT_TRUE(same(first, sceneOn(GetParam(), 4, 0.0).world.bodies));
  const Bodies one = sceneOn(GetParam(), 1, 0.5).world.bodies;
  EXPECT_TRUE(same(one, sceneOn(GetParam(), 1, 0.5).world.bodies));
  EXPECT_FALSE(same(one, sceneOn(GetParam(), 2, 0.5).world.bodies));
}

TEST_P(EveryChangingWorld, HasTheSameGroundTruthOnAllDays)
{
  SimulationSettings settings = testing::shortSettings(GetParam(), 12.0, 1000);
  const std::string truth = groundTruthText(Simulation(settings));
  settings.world.session = 2;
  EXPECT_EQ(groundTruthText(Simulation(settings)), truth);
}

TEST_P(EveryChangingWorld, NeverBlocksTheWay)
{
  for (const int session : {1, 2, 3})
  {
    SimulationSettings settings = testing::wholeRide(GetParam());
    settings.world.session = session;
    settings.world.changes = 1.0;
    EXPECT_LT(testing::firstCollision(Simulation(settings)), 0.0) << "session " << session;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenarios, EveryChangingWorld, ::testing::Values("town", "office", "corridors", "facades"),
    [](const auto& test) { return std::string(test.param); });

/** Counts of things of the first day that another one leaves, moves and takes away. */
struct Fates
{
  double left = 0.0, gone = 0.0, appeared = 0.0;
};

Fates fatesOf(const Scene& first, const Scene& other)
{
  Fates fates;
  const double things = static_cast<double>(first.movable.size());
  std::size_t bodies = first.world.bodies.size(), appeared = 0;
  for (const Movable& m : first.movable)
    fates.left += holds(other.world.bodies, first.world.bodies[m.first]) ? 1.0 / things : 0.0;
  for (const Bodies& thing : first.spare)
    if (holds(other.world.bodies, thing.front())) ++appeared, bodies += thing.size();
  fates.appeared = static_cast<double>(appeared) / static_cast<double>(first.spare.size());
  // Cars have two bodies, bins one: the missing ones in units of the mean.
  double of_things = 0.0;
  for (const Movable& m : first.movable)
    of_things += static_cast<double>(m.count);
  fates.gone = static_cast<double>(bodies - other.world.bodies.size()) / of_things;
  return fates;
}

TEST(Session, ChangesTheFractionThatIsAskedFor)
{
  const Scene first = sceneOn("town", 0, 0.0);
  ASSERT_GT(first.movable.size(), 60U);
  ASSERT_GT(first.spare.size(), 40U);
  for (const double changes : {0.2, 0.6})
  {
    Fates mean;
    constexpr int kSessions = 10;
    for (int session = 1; session <= kSessions; ++session)
    {
      const Fates fates = fatesOf(first, sceneOn("town", session, changes));
      mean.left += fates.left / kSessions;
      mean.gone += fates.gone / kSessions;
      mean.appeared += fates.appeared / kSessions;
    }
    // 600 or more draws: 3 sigma is 0.06.
    EXPECT_NEAR(mean.left, 1.0 - changes, 0.06);
    EXPECT_NEAR(mean.gone, 0.5 * changes, 0.06);
    EXPECT_NEAR(mean.appeared, 0.5 * changes, 0.07);
  }
}
}  // namespace
}  // namespace fastlio
