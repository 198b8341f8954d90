// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "folder_listing.h"
#include "rides.h"
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/simulation/observations.h>
#include <fastlio/simulation/recording.h>
#include <fastlio/worlds/path_builder.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservationOdometry;

SimulationSettings rideOnWheels()
{
  SimulationSettings settings = testing::wholeRide("town");
  settings.wheels.rate = 20.0;
  settings.wheels.noise = 0.0;
  return settings;
}

double wayOf(const std::vector<WheelReading>& readings, double rate)
{
  double way = 0.0;
  for (const WheelReading& reading : readings)
    way += std::abs(reading.speed) / rate;
  return way;
}

TEST(Wheels, FollowTheRideExactlyWithoutErrors)
{
  const Simulation simulation(rideOnWheels());
  const Pose start = simulation.motion().pose(0.0);
  for (const WheelReading& reading : simulation.wheels())
  {
    const Pose pose = simulation.truth(reading.stamp_ns).T_world_imu;
    const double turned = std::atan2(pose.R(1, 0), pose.R(0, 0)) -
                          std::atan2(start.R(1, 0), start.R(0, 0)) - reading.heading;
    ASSERT_NEAR(std::remainder(turned, kTwoPi), 0.0, 1e-6);
    // The ways on slopes are longer than in the plane, by 0.2 % on the steepest.
    const Vec3 in_plane = start.R.transpose() * (pose.p - start.p);
    const double ridden = 7.5 * simulation.secondsSinceStart(reading.stamp_ns);
    const double off = std::hypot(in_plane.x() - reading.x, in_plane.y() - reading.y);
    ASSERT_LT(off, 0.3 + 0.003 * ridden);
  }
  EXPECT_NEAR(wayOf(simulation.wheels(), 20.0), loopLength(simulation.motion().path()), 1.0);
  // The ride goes around the town: the heading winds.
  EXPECT_GT(std::abs(simulation.wheels().back().heading), 6.0);
}

TEST(Wheels, MeasureTooLongAsTheScaleErrorSays)
{
  SimulationSettings settings = rideOnWheels();
  const double way = wayOf(Simulation(settings).wheels(), 20.0);
  settings.wheels.scale_error = 0.02;
  EXPECT_NEAR(wayOf(Simulation(settings).wheels(), 20.0), 1.02 * way, 1e-6);
}

TEST(Wheels, NoiseGrowsWithTheRootOfTheWay)
{
  SimulationSettings settings = rideOnWheels();
  const auto exact = Simulation(settings).wheels();
  settings.wheels.noise = 0.03;
  const auto noisy = Simulation(settings).wheels();
  ASSERT_EQ(noisy.size(), exact.size());
  double ahead = 0.0, turn = 0.0, way = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    ahead += std::pow((noisy[i].speed - exact[i].speed) / 20.0, 2);
    turn += std::pow((noisy[i].turn_rate - exact[i].turn_rate) / 20.0, 2);
    way += std::abs(exact[i].speed) / 20.0;
    EXPECT_TRUE(exact[i].speed != 0.0 || noisy[i].speed == 0.0);
  }
  // The mean of two wheels has half of the variance of one, their difference twice that; 3800
  // readings.
  EXPECT_NEAR(ahead, 0.5 * 0.03 * 0.03 * way, 0.1 * 0.5 * 0.03 * 0.03 * way);
  EXPECT_NEAR(turn, 2.0 * 0.03 * 0.03 * way, 0.1 * 2.0 * 0.03 * 0.03 * way);
}

TEST(Wheels, ReadingsSurviveTheRecordingInTheOrderOfStamps)
{
  const testing::TemporaryFolder a, b;
  SimulationSettings settings = testing::shortSettings("town", 8.0, 100);
  settings.wheels.rate = 30.0;
  settings.gnss.rate = 10.0;
  const Simulation simulation(settings);
  const RecordingFiles files = writeRecording(simulation, a.path());
  RawlogSource source({files.rawlog});
  std::size_t readings = 0, fixes = 0;
  std::int64_t last = 0;
  while (const auto observation = source.next())
  {
    EXPECT_GE(toNanoseconds(observation->timestamp), last);
    last = toNanoseconds(observation->timestamp);
    fixes += observation->sensorLabel == kGnssLabel ? 1 : 0;
    const auto wheels = std::dynamic_pointer_cast<CObservationOdometry>(observation);
    if (!wheels) continue;
    ASSERT_LT(readings, simulation.wheels().size());
    const WheelReading& meant = simulation.wheels()[readings++];
    EXPECT_EQ(wheels->sensorLabel, "wheels");
    EXPECT_EQ(wheels->odometry.x(), meant.x);
    EXPECT_EQ(wheels->odometry.y(), meant.y);
    EXPECT_NEAR(wheels->odometry.phi(), meant.heading, 1e-12);
    EXPECT_TRUE(wheels->hasVelocities);
    EXPECT_EQ(wheels->velocityLocal.vx, meant.speed);
    EXPECT_EQ(wheels->velocityLocal.omega, meant.turn_rate);
  }
  EXPECT_EQ(readings, 241U);
  EXPECT_EQ(fixes, 81U);
  const RecordingFiles same = writeRecording(Simulation(settings), b.path());
  EXPECT_EQ(testing::contentOf(files.rawlog), testing::contentOf(same.rawlog));
}

TEST(Wheels, LeaveAllOtherSensorsAsTheyWere)
{
  SimulationSettings settings = testing::shortSettings("town", 6.0, 100);
  settings.gnss.rate = 5.0;
  const Simulation without(settings);
  settings.wheels.rate = 50.0;
  const Simulation with(settings);
  EXPECT_TRUE(without.wheels().empty());
  EXPECT_EQ(with.scan(40).points.x, without.scan(40).points.x);
  EXPECT_EQ(with.imu().samples.back().gyro, without.imu().samples.back().gyro);
  EXPECT_EQ(with.gnss().back().error, without.gnss().back().error);
}
}  // namespace
}  // namespace fastlio
