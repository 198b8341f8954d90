// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// Wheel odometry on simulated rides: a tunnel, where the LiDAR leaves the way open; places that
// need no wheels; wheels that slip or are wrong.

#include <fastlio/aiding/wheels.h>
#include <fastlio/loops/mapper.h>
#include <fastlio/math/time.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>

#include <cmath>

namespace fastlio
{
namespace
{
/** The odometry over a simulated ride. */
class Ride
{
 public:
  Ride(const char* scenario, double duration) : simulation_(settingsOf(scenario, duration))
  {
    Odometry odometry(matchingParameters(simulation_.settings()));
    for (const ImuSample& sample : simulation_.imu().samples)
      odometry.addImu(sample);
    for (std::size_t i = 0; i < simulation_.scanCount(); ++i)
    {
      odometry.addScan(simulation_.scan(i));
      while (const auto result = odometry.next())
        take(*result, odometry);
    }
    if (auto submap = submaps_.finish()) mapper_.add(std::move(*submap));
    for (const WheelReading& reading : simulation_.wheels())
      readings_.push_back({reading.stamp_ns, reading.x, reading.y, reading.heading});
  }

  [[nodiscard]] const std::vector<WheelPose>& readings() const { return readings_; }

  [[nodiscard]] WheelFactors factors(
      const std::vector<WheelPose>& readings, const Pose& T_vehicle_imu = {}) const
  {
    WheelFactors factors;
    factors.add(readings, T_vehicle_imu, track_, 0, mapper_);
    return factors;
  }

  /** Once, after all factors were made. */
  [[nodiscard]] MappingResult finish() { return std::move(mapper_).result(); }

  /** Of the submaps, when the first one is at its true place; rms [m]. */
  [[nodiscard]] double errorOf(const MappingResult& result) const
  {
    const Pose T_truth_world =
        truthAt(result.submaps.front()) * result.estimate.nodes.front().inverse();
    double squares = 0.0;
    for (std::size_t i = 0; i < result.submaps.size(); ++i)
      squares +=
          (T_truth_world * result.estimate.nodes[i].p - truthAt(result.submaps[i]).p).squaredNorm();
    return std::sqrt(squares / static_cast<double>(result.submaps.size()));
  }

  /** The readings of ideal wheels of a vehicle that the IMU is mounted on. */
  [[nodiscard]] std::vector<WheelPose> idealReadings(const Pose& T_vehicle_imu) const
  {
    std::vector<WheelPose> readings = readings_;
    for (WheelPose& reading : readings)
    {
      const Pose vehicle =
          simulation_.truth(reading.stamp_ns).T_world_imu * T_vehicle_imu.inverse();
      reading.x = vehicle.p.x();
      reading.y = vehicle.p.y();
      reading.heading = std::atan2(vehicle.R(1, 0), vehicle.R(0, 0));
    }
    return readings;
  }

 private:
  static SimulationSettings settingsOf(const char* scenario, double duration)
  {
    SimulationSettings settings = defaultSettings(scenario);
    settings.duration = duration;
    settings.lidar.stride = 8;
    settings.wheels.rate = 50.0;
    settings.wheels.scale_error = 0.01;
    return settings;
  }

  void take(const ScanResult& result, const Odometry& odometry)
  {
    track_.add(result);
    if (auto submap = submaps_.add(result, odometry.registeredPoints(), odometry.mapOrigin()))
      mapper_.add(std::move(*submap));
  }

  [[nodiscard]] Pose truthAt(const Submap& submap) const
  {
    return simulation_.truth(submap.reference.stamp_ns).T_world_imu;
  }

  Simulation simulation_;
  PoseTrack track_{OutputFrame{}};
  SubmapBuilder submaps_{0};
  Mapper mapper_;
  std::vector<WheelPose> readings_;
};

/** Wheels that spin: so much more way [m] from an instant on, within half a second. */
std::vector<WheelPose> spinning(std::vector<WheelPose> readings, double part, double way)
{
  const std::int64_t begin =
      readings[static_cast<std::size_t>(part * static_cast<double>(readings.size()))].stamp_ns;
  const double heading =
      readings[static_cast<std::size_t>(part * static_cast<double>(readings.size()))].heading;
  for (WheelPose& reading : readings)
  {
    const double extra =
        way * std::min(1.0, std::max(0.0, toSeconds(reading.stamp_ns - begin) / 0.5));
    reading.x += extra * std::cos(heading);
    reading.y += extra * std::sin(heading);
  }
  return readings;
}

TEST(Wheels, MeasureTheWayThroughATunnel)
{
  Ride ride("tunnel", 34.0);
  const WheelFactors good = ride.factors(ride.readings());
  const WheelFactors slipping = ride.factors(spinning(ride.readings(), 0.5, 0.8));
  const MappingResult alone = ride.finish();
  const double error_alone = ride.errorOf(alone);
  EXPECT_GT(error_alone, 0.5);

  MappingResult result = alone;
  const WheelOutcome outcome = good.applyTo(result);
  EXPECT_TRUE(outcome.used) << outcome.reason;
  EXPECT_TRUE(result.corrected);
  EXPECT_EQ(outcome.slipped, 0U);
  EXPECT_NEAR(outcome.scale, 1.0 / 1.01, 2.0 * outcome.scale_std);
  const double error = ride.errorOf(result);
  EXPECT_LT(error, 0.2 * error_alone) << error << " m instead of " << error_alone << " m";

  // What slips is left out; the motions before and after stay.
  MappingResult slipped = alone;
  const WheelOutcome slip = slipping.applyTo(slipped);
  EXPECT_GE(slip.slipped, 1U);
  EXPECT_LE(slip.slipped, 2U);
  EXPECT_NE(wheelSentence(slip).find("wheels slipped"), std::string::npos);
  EXPECT_LT(ride.errorOf(slipped), 0.5 * error_alone)
      << ride.errorOf(slipped) << " m instead of " << error_alone << " m";
  std::printf(
      "tunnel: %.2f m without wheels, %.2f m with them, %.2f m where they slip\n", error_alone,
      error, ride.errorOf(slipped));
}

TEST(Wheels, ChangeNothingWhereNobodyNeedsThem)
{
  Ride ride("office", 24.0);
  const WheelFactors wheels = ride.factors(ride.readings());
  std::vector<WheelPose> wrong = ride.readings();
  for (WheelPose& reading : wrong)
  {
    reading.x *= 1.3;
    reading.y *= 1.3;
  }
  const WheelFactors wrong_wheels = ride.factors(wrong);
  const MappingResult alone = ride.finish();
  MappingResult result = alone;
  const WheelOutcome outcome = wheels.applyTo(result);
  EXPECT_FALSE(outcome.used);
  EXPECT_GT(outcome.checks, 3U);
  EXPECT_NEAR(outcome.scale, 1.0 / 1.01, 0.006);
  EXPECT_EQ(result.corrected, alone.corrected);
  for (std::size_t i = 0; i < alone.estimate.nodes.size(); ++i)
    EXPECT_TRUE(result.estimate.nodes[i].p == alone.estimate.nodes[i].p);

  const WheelOutcome contradicted = wrong_wheels.applyTo(result);
  EXPECT_FALSE(contradicted.used);
  EXPECT_NE(contradicted.reason.find("contradict"), std::string::npos) << contradicted.reason;
}

TEST(Wheels, TheImuSwingsAboutTheVehicle)
{
  Ride ride("car", 24.0);
  const Pose T_vehicle_imu{expSO3(Vec3(0.0, 0.0, 0.5)), Vec3(0.9, 0.4, 0.0)};
  const std::vector<WheelPose> readings = ride.idealReadings(T_vehicle_imu);
  const WheelFactors right = ride.factors(readings, T_vehicle_imu);
  const WheelFactors wrong = ride.factors(readings, Pose{T_vehicle_imu.R, Vec3(-0.9, -0.4, 0.0)});
  MappingResult result = ride.finish();
  const WheelOutcome outcome = right.applyTo(result);
  EXPECT_GT(outcome.checks, 3U);
  EXPECT_EQ(outcome.contradicted, 0U);
  EXPECT_NEAR(outcome.scale, 1.0, 0.002);
  EXPECT_EQ(outcome.slipped, 0U);
  // In turns, wheels elsewhere go another way.
  const WheelOutcome elsewhere = wrong.applyTo(result);
  EXPECT_GT(elsewhere.contradicted + elsewhere.slipped, 0U);
}

TEST(Wheels, WithoutReadingsThereIsNothing)
{
  Ride ride("office", 6.0);
  const WheelFactors none = ride.factors({});
  const WheelFactors one = ride.factors({ride.readings().front()});
  MappingResult result = ride.finish();
  for (const WheelFactors* factors : {&none, &one})
  {
    const WheelOutcome outcome = factors->applyTo(result);
    EXPECT_FALSE(outcome.used);
    EXPECT_EQ(outcome.motions, 0U);
  }
  EXPECT_FALSE(result.corrected);
}

}  // namespace
}  // namespace fastlio
