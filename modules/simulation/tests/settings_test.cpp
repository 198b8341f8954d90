// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "short_simulation.h"
#include <fastlio/config/config.h>
#include <fastlio/scenarios/settings_table.h>
#include <fastlio/simulation/recording.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace fastlio
{
namespace
{
/** The message of the exception that a call throws; empty when it does not throw. */
template <typename Call>
std::string problemOf(Call call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& e)
  {
    return e.what();
  }
  return {};
}

TEST(Settings, EveryRowReadsBackWhatItPrints)
{
  for (const auto& info : scenarioTable())
  {
    const SimulationSettings settings = defaultSettings(info.name);
    SimulationSettings copy;
    for (const auto& row : settingsTable())
      copy = withSetting(copy, row.key, valueText(row, settings));
    for (const auto& row : settingsTable())
      EXPECT_EQ(valueText(row, copy), valueText(row, settings)) << row.key;
  }
}

TEST(Settings, KeysAreUniqueAndReachDifferentMembers)
{
  std::set<std::string_view> keys;
  for (const auto& row : settingsTable())
    EXPECT_TRUE(keys.insert(row.key).second) << row.key;

  const SimulationSettings base;
  for (const auto& row : settingsTable())
  {
    SimulationSettings scratch;
    const OptionValue option = row.value(scratch);
    const auto* real = std::get_if<RealValue>(&option);
    if (real == nullptr) continue;
    const double value = std::min(1.7 * std::max(real->min, 0.45), real->max);
    const SimulationSettings changed = withSetting(base, row.key, std::to_string(value));
    int differences = 0;
    for (const auto& other : settingsTable())
      differences += valueText(other, changed) != valueText(other, base) ? 1 : 0;
    EXPECT_EQ(differences, 1) << row.key;
  }
}

TEST(Settings, ValuesEndUpInSiUnits)
{
  SimulationSettings s = withSetting({}, "lidar.vertical_fov", "90");
  EXPECT_NEAR(s.lidar.vertical_fov, 1.5707963267948966, 1e-12);
  s = withSetting(s, "lidar.kind", "livox");
  EXPECT_EQ(s.lidar.kind, LidarKind::Livox);
  s = withSetting(s, "start_time", "1234567890");
  EXPECT_EQ(s.start_ns, 1'234'567'890'000'000'000);
  s = withSetting(s, "imu.gyro_bias", "0.1,-0.2,3e-2");
  EXPECT_EQ(s.imu.gyro_bias, Vec3(0.1, -0.2, 0.03));
  s = withSetting(s, "lidar.pose", "1,2,3,90,0,0");
  EXPECT_LT((s.lidar.T_imu_lidar * Vec3(1, 0, 0) - Vec3(1, 3, 3)).norm(), 1e-12);
}

TEST(Settings, UnknownKeysGetTheNearestOne)
{
  const std::string problem = problemOf([] { (void)withSetting({}, "imu.rte", "100"); });
  EXPECT_NE(problem.find("'imu.rate'"), std::string::npos) << problem;
}

TEST(Settings, ValuesThatAreNotAllowedAreRefusedWithWhatIs)
{
  using Case = std::pair<const char*, const char*>;
  for (const Case& wrong :
       {Case{"imu.rate", "fast"}, Case{"imu.rate", ""}, Case{"imu.rate", "nan"},
        Case{"imu.rate", "inf"}, Case{"imu.rate", "-5"}, Case{"imu.rate", "100x"},
        Case{"lidar.lines", "1.5"}, Case{"lidar.kind", "sonar"}, Case{"seed", "-1"},
        Case{"imu.average", "yes"}, Case{"imu.gyro_bias", "1,2"}, Case{"imu.gyro_bias", "1,2,3,4"},
        Case{"lidar.pose", "1,2,3,4,5,x"}, Case{"start_time", "99999999999"}})
  {
    const std::string problem =
        problemOf([&] { (void)withSetting({}, wrong.first, wrong.second); });
    EXPECT_NE(problem.find(wrong.first), std::string::npos) << wrong.first << " = " << wrong.second;
    EXPECT_NE(problem.find("allowed: "), std::string::npos) << problem;
  }
}

TEST(Settings, SettingsMadeInCodeAreChecked)
{
  SimulationSettings settings = defaultSettings("office");
  EXPECT_EQ(problemOf([&] { requireValid(settings); }), "");
  settings.imu.rate = -1.0;
  settings.lidar.dropout = std::numeric_limits<double>::quiet_NaN();
  settings.lidar.min_range = 200.0;
  const std::string problem = problemOf([&] { (void)Simulation(settings); });
  for (const char* key : {"imu.rate", "lidar.dropout", "lidar.min_range"})
    EXPECT_NE(problem.find(key), std::string::npos) << problem;
}

/** Their time stamps are not negative: they would come out thousands of years later. */
TEST(Settings, StampsBefore1970AreRefused)
{
  SimulationSettings settings = defaultSettings("office");
  settings.start_ns = 0;
  EXPECT_EQ(problemOf([&] { requireValid(settings); }), "");
  settings.lidar.time_offset = -10.0;
  EXPECT_NE(problemOf([&] { requireValid(settings); }).find("before 1970"), std::string::npos);
  settings.start_ns = 10'000'000'000;
  EXPECT_EQ(problemOf([&] { requireValid(settings); }), "");
}

TEST(MatchingParameters, AreValidForEveryScenario)
{
  for (const auto& info : scenarioTable())
    EXPECT_EQ(problemOf([&] { validate(matchingConfig(defaultSettings(info.name))); }), "");
  const SimulationSettings perfect = testing::withoutErrors(defaultSettings("office"));
  EXPECT_EQ(problemOf([&] { validate(matchingConfig(perfect)); }), "");
}

TEST(MatchingParameters, GiveTheFilterTheSensorsAsTheyAre)
{
  SimulationSettings settings = defaultSettings("office");
  settings.lidar.time_offset = 0.02;
  settings.imu.vibration_accel = 1.0;
  const Config config = matchingConfig(settings);
  const OdometryOptions& p = config.odometry;
  EXPECT_EQ(p.imu.noise.gyro_noise_density, settings.imu.noise.gyro_noise_density);
  EXPECT_EQ(p.imu.noise.gyro_bias_walk, settings.imu.noise.gyro_bias_walk);
  // Sinusoid of amplitude 1 sampled at 200 Hz: variance 1/2 per sample.
  EXPECT_NEAR(p.imu.noise.accel_noise_density, std::sqrt(4e-6 + 0.5 / 200.0), 1e-12);
  EXPECT_EQ(p.lidar.time_offset, -0.02);
  EXPECT_EQ(p.measurement.range_noise, settings.lidar.range_noise);
  EXPECT_EQ(p.initialization.accel_bias_std, settings.imu.accel_bias_std);
  ASSERT_TRUE(config.sensors.T_vehicle_lidar);
  EXPECT_EQ(config.sensors.T_vehicle_lidar->p, settings.lidar.T_imu_lidar.p);
}
}  // namespace
}  // namespace fastlio
