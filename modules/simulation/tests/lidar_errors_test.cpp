// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "short_simulation.h"
#include <fastlio/math/angles.h>
#include <fastlio/math/time.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace fastlio
{
namespace
{
SimulationSettings exactOffice(int stride = 4)
{
  return testing::withoutErrors(testing::shortSettings("rest", 2.0, stride));
}

/** The same shots with and without an error. */
struct Pair
{
  FiredSweep with, without;

  Pair(const SimulationSettings& with_error, const SimulationSettings& exact)
      : with(Simulation(with_error).fire(3)), without(Simulation(exact).fire(3))
  {
  }

  /** Calls use(shot, range with, range without) for each shot that comes back in both. */
  template <typename Use>
  void forEach(Use use) const
  {
    for (std::size_t i = 0; i < with.echoes.size(); ++i)
      if (with.echoes[i].range > 0.0 && without.echoes[i].range > 0.0)
        use(with.sweep.shots[i], with.echoes[i].range, without.echoes[i].range);
  }
};

TEST(LidarErrors, EachLaserHasARangeOffsetOfItsOwn)
{
  SimulationSettings settings = exactOffice();
  settings.lidar.beam.laser_range_std = 0.01;
  const Simulation simulation(settings);
  const std::vector<double>& truth = simulation.lidarErrors().range_offset;
  ASSERT_EQ(truth.size(), 16U);
  std::vector<double> sum(16, 0.0), count(16, 0.0);
  Pair(settings, exactOffice())
      .forEach(
          [&](const Shot& shot, double with, double without)
          {
            sum[shot.ring] += with - without;
            count[shot.ring] += 1.0;
          });
  for (std::size_t ring = 0; ring < 16; ++ring)
  {
    ASSERT_GT(count[ring], 100.0);
    EXPECT_NEAR(sum[ring] / count[ring], truth[ring], 1e-9) << ring;
  }
  EXPECT_NE(truth[0], truth[1]);
}

TEST(LidarErrors, OffsetsScatterOverLasersAndSeedsAsTheSettingsSay)
{
  SimulationSettings settings;
  settings.lidar.beam.laser_range_std = 0.01;
  settings.lidar.beam.laser_elevation_std = 0.001;
  settings.lidar.beam.laser_azimuth_std = 0.002;
  double range = 0.0, elevation = 0.0, azimuth = 0.0;
  constexpr int kSeeds = 60;  // times 16 lasers: 3 sigma of the root mean square is 7 %
  for (int seed = 1; seed <= kSeeds; ++seed)
  {
    settings.seed = static_cast<std::uint64_t>(seed);
    const LidarErrors e = drawLidarErrors(settings);
    const auto squares = [](const std::vector<double>& x)
    { return std::inner_product(x.begin(), x.end(), x.begin(), 0.0); };
    range += squares(e.range_offset);
    elevation += squares(e.elevation_offset);
    azimuth += squares(e.azimuth_offset);
  }
  EXPECT_NEAR(std::sqrt(range / (16 * kSeeds)), 0.01, 0.0007);
  EXPECT_NEAR(std::sqrt(elevation / (16 * kSeeds)), 0.001, 0.00007);
  EXPECT_NEAR(std::sqrt(azimuth / (16 * kSeeds)), 0.002, 0.00014);
}

TEST(LidarErrors, OffsetsOfDirectionsMoveWhereLightHitsAndNotWhatTheDataSay)
{
  SimulationSettings settings = exactOffice();
  settings.lidar.beam.laser_elevation_std = 0.002;
  settings.lidar.beam.laser_azimuth_std = 0.003;
  const Simulation simulation(settings);
  const FiredSweep fired = simulation.fire(3);
  const FiredSweep exact = Simulation(exactOffice()).fire(3);
  const Pose T = simulation.motion().pose(0.3) * settings.lidar.T_imu_lidar;
  std::size_t checked = 0;
  for (std::size_t i = 0; i < fired.echoes.size(); ++i)
  {
    const Shot& shot = fired.sweep.shots[i];
    ASSERT_EQ(shot.direction, exact.sweep.shots[i].direction);
    if (fired.echoes[i].range <= 0.0) continue;
    // The wall or floor that a ray in the offset direction meets.
    const double elevation =
        std::asin(shot.direction.z()) + simulation.lidarErrors().elevation_offset[shot.ring];
    const double azimuth = std::atan2(shot.direction.y(), shot.direction.x()) +
                           simulation.lidarErrors().azimuth_offset[shot.ring];
    const Vec3 moved(
        std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
        std::sin(elevation));
    const auto hit = simulation.world().cast({T.p, T.R * moved}, 0.3, 100.0);
    ASSERT_TRUE(hit);
    ASSERT_NEAR(fired.echoes[i].range, hit->range, 1e-9);
    ++checked;
  }
  EXPECT_GT(checked, 3000U);
}

TEST(LidarErrors, IncidenceBiasGrowsFromNoneToItsValueAt80Degrees)
{
  BeamSettings beam;
  beam.incidence_bias = -0.02;
  EXPECT_EQ(rangeBias(beam, {5.0, 1.0, 0.5}), 0.0);
  EXPECT_NEAR(rangeBias(beam, {5.0, std::cos(80.0 * kRadPerDeg), 0.5}), -0.02, 1e-12);
  double last = 0.0;
  for (double angle = 1.0; angle < 90.0; angle += 1.0)
  {
    const double bias = rangeBias(beam, {5.0, std::cos(angle * kRadPerDeg), 0.5});
    EXPECT_LT(bias, last);
    EXPECT_GT(bias, last - 0.0005);
    last = bias;
  }
}

TEST(LidarErrors, RangesOfASweepHaveTheBiasOfTheirIncidenceAndReflectivity)
{
  SimulationSettings settings = exactOffice();
  settings.lidar.beam.incidence_bias = -0.02;
  settings.lidar.beam.dark_bias = 0.016;
  settings.lidar.beam.bright_bias = -0.008;
  const Simulation simulation(settings);
  const Pose T = simulation.motion().pose(0.3) * settings.lidar.T_imu_lidar;
  double least = 1.0, most = -1.0;
  Pair(settings, exactOffice())
      .forEach(
          [&](const Shot& shot, double with, double without)
          {
            const Vec3 d = T.R * shot.direction;
            const auto hit = simulation.world().cast({T.p, d}, 0.3, 100.0);
            ASSERT_TRUE(hit);
            const double slant = (1.0 + hit->normal.dot(d)) / (1.0 - std::cos(80 * kRadPerDeg));
            const double meant = -0.02 * slant + 0.016 - 0.024 * hit->reflectivity;
            ASSERT_NEAR(with - without, meant, 1e-9);
            least = std::min(least, with - without);
            most = std::max(most, with - without);
          });
  EXPECT_LT(least, -0.015);
  EXPECT_GT(most, 0.005);
}

TEST(LidarErrors, MountingIsNotWhatTheRecordingTells)
{
  SimulationSettings settings = exactOffice();
  settings.lidar.hidden.rotation_std = 0.3 * kRadPerDeg;
  settings.lidar.hidden.position_std = 0.01;
  double turned = 0.0, moved = 0.0;
  constexpr int kSeeds = 300;  // times three axes: 3 sigma of the root mean square is 7 %
  for (int seed = 1; seed <= kSeeds; ++seed)
  {
    settings.seed = static_cast<std::uint64_t>(seed);
    const Pose truth = drawLidarErrors(settings).T_imu_lidar;
    turned += logSO3(settings.lidar.T_imu_lidar.R.transpose() * truth.R).squaredNorm();
    moved += (truth.p - settings.lidar.T_imu_lidar.p).squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(turned / (3 * kSeeds)), 0.3 * kRadPerDeg, 0.02 * kRadPerDeg);
  EXPECT_NEAR(std::sqrt(moved / (3 * kSeeds)), 0.01, 0.0007);
}

TEST(LidarErrors, ScansAreFiredFromTheTrueMountingAndStoreAnother)
{
  SimulationSettings settings = exactOffice();
  settings.lidar.hidden.position_std = 0.05;
  settings.lidar.hidden.rotation_std = 2.0 * kRadPerDeg;
  const Simulation simulation(settings);
  SimulationSettings honest = exactOffice();
  honest.lidar.T_imu_lidar = simulation.lidarErrors().T_imu_lidar;
  const LidarScan scan = simulation.scan(3), same = Simulation(honest).scan(3);
  EXPECT_EQ(scan.points.x, same.points.x);
  EXPECT_EQ(scan.T_imu_lidar.p, settings.lidar.T_imu_lidar.p);
  EXPECT_NE(scan.T_imu_lidar.p, same.T_imu_lidar.p);
}

TEST(LidarErrors, ClockErrorShiftsStampsLikeATimeOffset)
{
  SimulationSettings settings = exactOffice();
  settings.lidar.time_offset = 0.001;
  settings.lidar.hidden.clock_error = 0.004;
  const LidarScan late = Simulation(settings).scan(3), on_time = Simulation(exactOffice()).scan(3);
  EXPECT_EQ(late.stamp_ns - on_time.stamp_ns, 5'000'000);
  EXPECT_EQ(late.points.x, on_time.points.x);
}

TEST(LidarErrors, ClockDriftGrowsFromTheStartOn)
{
  SimulationSettings settings = exactOffice();
  settings.lidar.hidden.clock_error = 0.001;
  settings.lidar.hidden.clock_drift = 1e-4;
  const LidarScan late = Simulation(settings).scan(20),
                  on_time = Simulation(exactOffice()).scan(20);
  const double seconds = toSeconds(on_time.stamp_ns - settings.start_ns);
  EXPECT_GT(seconds, 1.9);
  EXPECT_EQ(late.stamp_ns - on_time.stamp_ns, toNanoseconds(0.001 + 1e-4 * seconds));
  EXPECT_EQ(late.points.x, on_time.points.x);
}
}  // namespace
}  // namespace fastlio
