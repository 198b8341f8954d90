// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "rides.h"
#include <fastlio/math/angles.h>
#include <fastlio/worlds/path_builder.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
TEST(Town, IsALoopOfTheLengthThatIsAskedFor)
{
  for (const double length : {600.0, 900.0, 1200.0, 3000.0, 5000.0})
  {
    SimulationSettings settings = testing::wholeRide("town");
    settings.world.length = length;
    const Simulation simulation(settings);
    const Motion& motion = simulation.motion();
    EXPECT_NEAR(loopLength(motion.path()), length, 0.005 * length);
    const double end = simulation.settings().duration;
    EXPECT_LT((motion.pose(0.0).p - motion.pose(end).p).norm(), 1e-6);
    EXPECT_LT(logSO3(motion.pose(0.0).R.transpose() * motion.pose(end).R).norm(), 1e-6);
    EXPECT_LT(testing::firstCollision(simulation), 0.0) << length << " m";
    EXPECT_GT(length / end, 5.0);
    EXPECT_LT(length / end, 8.0);
  }
}

TEST(Town, PassesManyStreetsAgainInBothDirections)
{
  const testing::Revisits revisits =
      testing::revisitsOf(Simulation(testing::wholeRide("town")), 6.0);
  EXPECT_GT(revisits.same, 120.0);
  EXPECT_GT(revisits.opposite, 120.0);
}

TEST(Town, RidesAsAVehicleOverHills)
{
  const Simulation simulation(testing::wholeRide("town"));
  double lowest = 1e9, highest = -1e9, fastest = 0.0, hardest = 0.0;
  for (double t = 0.0; t < simulation.settings().duration; t += 0.02)
  {
    const Kinematics k = simulation.motion().at(t);
    lowest = std::min(lowest, k.T_world_imu.p.z());
    highest = std::max(highest, k.T_world_imu.p.z());
    fastest = std::max(fastest, k.velocity.norm());
    hardest = std::max(hardest, k.acceleration.head<2>().norm());
    // The sensor stays at its height above the road, and upright as the road is.
    const Vec3& p = k.T_world_imu.p;
    EXPECT_NEAR(p.z() - simulation.world().description().ground->height(p.x(), p.y()), 1.6, 0.05);
    EXPECT_GT(k.T_world_imu.R(2, 2), std::cos(0.1));
  }
  EXPECT_GT(highest - lowest, 3.0);
  EXPECT_LT(fastest, 7.7);
  EXPECT_LT(hardest, 3.5);
}

TEST(Town, LooksDifferentInEveryStreet)
{
  // The surroundings of crossings: no two have walls at the same ranges.
  const Simulation simulation(testing::wholeRide("town"));
  std::vector<std::vector<double>> views;
  for (double t = 10.0; t < 100.0; t += 10.0)
  {
    const Pose pose = simulation.motion().pose(t);
    views.push_back(testing::viewFrom(simulation.world(), pose, 60.0));
  }
  for (std::size_t a = 0; a < views.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_LT(testing::fractionAlike(views[a], views[b], 0.3), 0.5) << a << " and " << b;
}

TEST(Route, SlowsDownInBendsAsTheAccelerationAsks)
{
  Route route;
  route.corners = {{0, 0, 0}, {60, 0, 0}, {60, 60, 0}, {0, 60, 0}};
  route.speed = 10.0;
  route.corner_cut = 8.0;
  const auto hardest = [](const CarrierPath& path)
  {
    double most = 0.0;
    for (double u = 0.0; u < path.loop_time; u += 0.01)
      most = std::max(
          most, std::hypot(
                    path.channels[CarrierPath::kX].at(u).second,
                    path.channels[CarrierPath::kY].at(u).second));
    return most;
  };
  const CarrierPath steady = followRoute(route);
  route.acceleration = 2.0;
  const CarrierPath careful = followRoute(route);
  EXPECT_GT(hardest(steady), 8.0);
  EXPECT_LT(hardest(careful), 3.5);  // 2 along and across at once, and the spline
  EXPECT_GT(careful.loop_time, 1.2 * steady.loop_time);
  EXPECT_NEAR(loopLength(careful), loopLength(steady), 0.02 * loopLength(steady));
}

TEST(Route, VehiclesTiltAsTheGround)
{
  Route route;
  route.corners = {{0, 0, 0}, {60, 0, 0}, {60, 60, 0}, {0, 60, 0}};
  route.speed = 5.0;
  CarrierPath path = followRoute(route);
  addGroundTilt(path, [](double x, double y) { return 0.05 * x + 0.02 * y; });
  // Along x: uphill by 0.05, the left side higher by 0.02.
  const double u = 6.0;
  EXPECT_NEAR(path.channels[CarrierPath::kYaw].value(u), 0.0, 1e-3);
  EXPECT_NEAR(path.channels[CarrierPath::kPitch].value(u), -std::atan(0.05), 1e-4);
  EXPECT_NEAR(path.channels[CarrierPath::kRoll].value(u), std::atan(0.02), 1e-4);
}
}  // namespace
}  // namespace fastlio
