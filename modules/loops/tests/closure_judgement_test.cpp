// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "simulated_submaps.h"
#include <fastlio/loops/mapper.h>
#include <fastlio/scenarios/settings_table.h>

#include <gtest/gtest.h>

#include <optional>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kFloor = 3.2;  // from one to the next that looks the same [m]

/** What is seen of rooms in a few seconds. */
Submap roomsAround()
{
  SimulationSettings settings = defaultSettings("office");
  settings.duration = 5.0;
  settings.lidar.stride = 4;
  constexpr double kLong = 100.0;  // [m]: one submap holds all
  return testing::submapsOf(Simulation(settings), {kLong}).at(0);
}

/** The closure between a submap and one later on that looks the same.
 * \param height of the latter by the odometry [m] \param height_std how well it knows [m] */
Closure closureAtHeight(double height, double height_std)
{
  static const Submap rooms = roomsAround();
  Submap first = rooms, second = rooms;
  first.reference.covariance = 1e-8 * Matrix6::Identity();
  first.reference.map_covariance.setZero();
  second.reference = first.reference;
  second.reference.stamp_ns += 60'000'000'000;
  second.reference.T_world_body.p.z() += height;
  second.reference.covariance(5, 5) += height_std * height_std;
  second.travel += 60.0;
  // The accelerometer does not tell heights.
  first.gravity = second.gravity = std::nullopt;
  Mapper mapper;
  mapper.add(std::move(first));
  mapper.add(std::move(second));
  EXPECT_EQ(mapper.closures().size(), 1U);
  return mapper.closures().empty() ? Closure{} : mapper.closures().front();
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

}  // namespace fastlio
