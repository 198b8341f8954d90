// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "config_problems.h"
#include "removed_keys.h"
#include "yaml_value.h"
#include <fastlio/config/config_document.h>
#include <fastlio/math/angles.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

using namespace fastlio;
using namespace fastlio::testing;
using mrpt::containers::yaml;

namespace
{
/** A file that is removed with the object. */
class TemporaryFile
{
 public:
  explicit TemporaryFile(const std::string& text)
      : path_(
            std::filesystem::temp_directory_path() /
            (std::string("fastlio_config_") +
             ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml"))
  {
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

std::string fileProblem(const std::string& text)
{
  const TemporaryFile file(text);
  return messageOf<std::invalid_argument>([&] { (void)loadConfigFromFile(file.path()); });
}
}  // namespace

TEST(ConfigYaml, EmptyDocumentsGiveTheDefaults)
{
  const std::string defaults = toYaml(Config{});
  EXPECT_EQ(toYaml(fromText("")), defaults);
  EXPECT_EQ(toYaml(fromText("# only a comment\n")), defaults);
  EXPECT_EQ(toYaml(fromText("map: ~\n")), defaults);
  EXPECT_EQ(toYaml(loadConfig(yaml())), defaults);
}

TEST(ConfigYaml, ReadsEveryKindOfValue)
{
  const Config p = fromText(R"(
input:
  lidar_sensor_label: 'lidar_\d+'
  T_vehicle_lidar: [1, -2.5, 0.25, 90, 0, 180]
initialization:
  duration: 3
  max_gyro_mean: 10
  align_with_gravity: false
imu: {max_gap: 2.5e-1}
downsampling:
  target_points: 1234
gain: standard
threads: 2
)");
  EXPECT_EQ(p.sensors.lidar_sensor_label, "lidar_\\d+");
  EXPECT_FALSE(p.sensors.T_vehicle_imu.has_value());
  EXPECT_DOUBLE_EQ(p.odometry.initialization.duration, 3.0);
  EXPECT_DOUBLE_EQ(p.odometry.initialization.max_gyro_mean, 10.0 * kRadPerDeg);
  EXPECT_FALSE(p.odometry.initialization.align_with_gravity);
  EXPECT_DOUBLE_EQ(p.odometry.imu.max_gap, 0.25);
  EXPECT_EQ(p.odometry.downsampling.target_points, 1234);
  EXPECT_EQ(p.odometry.gain, GainForm::Standard);
  EXPECT_EQ(p.odometry.threads, 2);
}

TEST(ConfigYaml, PosesAreYawPitchRollInDegrees)
{
  const Config p = fromText("input: {T_vehicle_lidar: [1, -2.5, 0.25, 90, 0, 180]}\n");
  ASSERT_TRUE(p.sensors.T_vehicle_lidar.has_value());
  const Pose& T = *p.sensors.T_vehicle_lidar;
  EXPECT_TRUE(T.p.isApprox(Vec3(1, -2.5, 0.25)));
  // Rolled upside down, then turned left: x points to y, y points to x, z points down.
  EXPECT_TRUE((T.R * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-12));
  EXPECT_TRUE((T.R * Vec3::UnitY()).isApprox(Vec3::UnitX(), 1e-12));
  EXPECT_TRUE((T.R * Vec3::UnitZ()).isApprox(-Vec3::UnitZ(), 1e-12));
}

TEST(ConfigYaml, ValuesSetInCodeWorkAsThoseOfText)
{
  yaml group = yaml::Map();
  group["max_gap"] = 0.1234567890123456;
  yaml document = yaml::Map();
  document["imu"] = group;
  document["lidar"] = yaml::Map({{"deskew", false}});
  document["threads"] = 3;
  const Config p = loadConfig(document);
  EXPECT_EQ(p.odometry.imu.max_gap, 0.1234567890123456);
  EXPECT_FALSE(p.odometry.lidar.deskew);
  EXPECT_EQ(p.odometry.threads, 3);
}

TEST(ConfigYaml, UnknownKeysNameTheNearest)
{
  expectContains(
      problemOf("map:\n  raduis: 3\n"),
      "line 2, map.raduis: is not a parameter; did you mean 'map.radius'?");
  expectContains(
      problemOf("mpa:\n  radius: 3\n"), "mpa: is not a group of parameters; did you mean 'map'?");
  expectContains(problemOf("thread: 3\n"), "did you mean 'threads'?");
  expectContains(problemOf("map: 3\n"), "map: is a group");
  expectContains(problemOf("gain:\n  information: 1\n"), "gain: a group of keys is not a choice");
  expectContains(problemOf("- 1\n- 2\n"), "must hold 'group:' lines");
}

TEST(ConfigYaml, EveryProblemIsListedAtOnce)
{
  const std::string message = problemOf(
      "map:\n  radius: -3\nlidar:\n  deskew: maybe\n  min_range: nine\nthreads: 1.5\n"
      "gain: optimal\n");
  expectContains(message, "5 problems");
  expectContains(message, "line 2, map.radius: -3 is out of range; allowed: 1 to 100000 m");
  expectContains(message, "line 4, lidar.deskew: 'maybe' is not a boolean; allowed: true, false");
  expectContains(message, "line 5, lidar.min_range: 'nine' is not a number; allowed: 0 to 1000 m");
  expectContains(message, "line 6, threads: '1.5' is not a whole number; allowed: 0 to 1024");
  expectContains(message, "'optimal' is not a choice; allowed: information, standard");
}

TEST(ConfigYaml, RefusesWhatIsNotAPlainFiniteNumber)
{
  for (const char* bad :
       {"nan", ".nan", ".inf", "-.inf", "inf", "1,5", "0x10", "1.5m", "''", "[1]", "{a: 1}", "~",
        "1e999", "true", "1 2"})
    expectContains(problemOf(std::string("map:\n  radius: ") + bad + "\n"), "is not a number");
}

TEST(ConfigYaml, RefusesBadPosesAndExpressions)
{
  expectContains(problemOf("input: {T_vehicle_imu: [1, 2, 3]}\n"), "a list of 3 is not a pose");
  expectContains(problemOf("input: {T_vehicle_imu: 7}\n"), "'7' is not a pose");
  expectContains(problemOf("input: {T_vehicle_imu: [1, 2, 3, 4, 5, x]}\n"), "'x' is not a pose");
  expectContains(problemOf("input: {imu_sensor_label: '(imu'}\n"), "is not a regular expression");
  EXPECT_FALSE(fromText("input: {T_vehicle_imu: null}\n").sensors.T_vehicle_imu.has_value());
}

TEST(ConfigYaml, RelationsBetweenParametersAreChecked)
{
  expectContains(
      problemOf("lidar: {min_range: 20, max_range: 10}\n"),
      "lidar.min_range: must be below lidar.max_range");
}

TEST(ConfigYaml, FileErrorsNameTheFile)
{
  const std::string missing = messageOf<std::runtime_error>(
      [] { (void)loadConfigFromFile("/nonexistent/parameters.yaml"); });
  expectContains(missing, "/nonexistent/parameters.yaml: cannot be read");
  EXPECT_EQ(missing.find("preset"), std::string::npos) << missing;
  const std::string preset =
      messageOf<std::runtime_error>([] { (void)loadConfigFromFile("velodyne_vlp16"); });
  expectContains(preset, "params/velodyne_vlp16.yaml");
  (void)messageOf<std::runtime_error>([] { (void)loadConfigFromFile("/"); });
  expectContains(fileProblem("map:\n radius: 1\n  bad: 2\n"), ".yaml: is not valid YAML");
  expectContains(fileProblem("map:\n  radius: -1\n"), "FileErrorsNameTheFile.yaml: 1 problem");
}

TEST(ConfigYaml, KeysGivenTwiceAreErrors)
{
  const std::string message = fileProblem(
      "map:\n  radius: 10\n# comment: x\nlidar:\n  deskew: true\n  deskew: false\nmap:\n  radius: "
      "5\n");
  expectContains(message, "line 6, lidar.deskew: is given a second time (first in line 5)");
  expectContains(message, "line 7, map: is given a second time (first in line 1)");
}

TEST(ConfigYaml, LimitsThemselvesAreAllowedAndBeyondIsNot)
{
  for (const auto& row : configTable())
  {
    Config config;
    const OptionValue value = row.value(config);
    const auto* real = std::get_if<RealValue>(&value);
    if (real == nullptr) continue;
    for (const double limit : {real->min, real->max})
    {
      const double beyond =
          limit + (limit == real->min ? -1e-3 : 1e-3) * std::max(1.0, std::abs(limit));
      EXPECT_FALSE(assignNode(value, row.unit, yaml::node_t(limit))) << row.key << " " << limit;
      const std::string before = valueText(value);
      EXPECT_TRUE(assignNode(value, row.unit, yaml::node_t(beyond))) << row.key << " " << beyond;
      EXPECT_EQ(valueText(value), before) << row.key;
    }
  }
}

TEST(ConfigYaml, ValidateChecksWhatWasSetInCode)
{
  EXPECT_NO_THROW(validate(Config{}));
  Config config;
  OdometryOptions& p = config.odometry;
  p.map.radius = std::numeric_limits<double>::quiet_NaN();
  p.threads = -1;
  p.initialization.max_gyro_std = -kRadPerDeg;
  p.gain = static_cast<GainForm>(7);
  config.sensors.T_vehicle_imu = Pose{2.0 * Mat3::Identity(), Vec3::Zero()};
  p.lidar.min_range = p.lidar.max_range;
  const std::string message = messageOf<std::invalid_argument>([&] { validate(config); });
  expectContains(message, "6 problems");
  expectContains(message, "map.radius: is not a finite number");
  expectContains(
      message, "initialization.max_gyro_std: -1 is out of range; allowed: 0.001 to 500 deg/s");
  expectContains(message, "input.T_vehicle_imu: has a matrix that is not a rotation");
}

TEST(ConfigYaml, EveryRemovedKeySaysWhatToDoNow)
{
  ASSERT_FALSE(removedKeys().empty());
  for (const RemovedKey& removed : removedKeys())
  {
    const std::string key(removed.key);
    if (key.find(':') != std::string::npos) continue;
    EXPECT_EQ(findOption(configTable(), key), nullptr) << key;
    const std::string text =
        std::string(groupOf(key)) + ":\n  " + std::string(nameOf(key)) + ": 1\n";
    expectContains(problemOf(text), "line 2, " + key + ": " + removed.advice);
  }
  expectContains(
      problemOf("features:\n  max_spacing: 1\n"),
      "features.max_spacing: is a constant of the method now, 1 m; remove the line");
  expectContains(problemOf("map:\n  type: kdtree\n"), "; kdtree is gone: knn finds");
}

TEST(ConfigYaml, RowsOfNumbersAreListsOfLists)
{
  const Config config = fromText(
      "imu:\n  gyro_matrix: [1, 0, 0, 0, 1, 0.01, 0, 0, 1]\n"
      "lidar:\n  beam_offsets: [[-15, 0.01, 0], [1, -0.02, 0.1]]\n");
  EXPECT_EQ(config.odometry.imu.gyro_matrix[5], 0.01);
  EXPECT_EQ(
      config.odometry.lidar.beam_offsets, (std::vector<double>{-15.0, 0.01, 0.0, 1.0, -0.02, 0.1}));
  expectContains(problemOf("lidar:\n  beam_offsets: [[1, 2]]\n"), "has 2 numbers");
  expectContains(problemOf("lidar:\n  beam_offsets: [[1, [2], 3]]\n"), "lidar.beam_offsets");
  expectContains(problemOf("imu:\n  gyro_matrix: [1, 0, 0]\n"), "nine numbers");
  expectContains(
      problemOf("imu:\n  accel_matrix: [0, 1, 0, 1, 0, 0, 0, 0, 1]\n"), "near the identity");
}

TEST(ConfigYaml, AFileTellsTheLinesOfItsKeys)
{
  const TemporaryFile file("threads: 2\nmap: {radius: 5}\n# comment\nlidar:\n  deskew: false\n");
  const std::map<std::string, int> expected{{"threads", 1}, {"map.radius", 2}, {"lidar.deskew", 5}};
  EXPECT_EQ(readConfigFile(file.path()).lines, expected);
}
