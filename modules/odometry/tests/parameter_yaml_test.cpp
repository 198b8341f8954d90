// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/angles.h>
#include <fastlio/odometry/parameter_check.h>
#include <fastlio/odometry/parameter_read.h>
#include <fastlio/odometry/parameter_table.h>
#include <fastlio/odometry/parameter_yaml.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

using namespace fastlio;
using mrpt::containers::yaml;

namespace
{
Parameters fromText(const std::string& text)
{
  return loadParameters(yaml::FromText(text));
}

/** The message of the error that \a action throws; fails the test when it throws none. */
template <typename Error, typename Action>
std::string messageOf(const Action& action)
{
  try
  {
    action();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  ADD_FAILURE() << "no exception of the expected type";
  return {};
}

std::string problemOf(const std::string& text)
{
  return messageOf<std::invalid_argument>([&] { (void)fromText(text); });
}

void expectContains(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

/** A file that is removed with the object. */
class TemporaryFile
{
 public:
  explicit TemporaryFile(const std::string& text)
      : path_(
            std::filesystem::temp_directory_path() /
            (std::string("fastlio_parameters_") +
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
  return messageOf<std::invalid_argument>([&] { (void)loadParametersFromFile(file.path()); });
}
}  // namespace

TEST(ParameterYaml, emptyDocumentsGiveTheDefaults)
{
  const std::string defaults = toYaml(Parameters{});
  EXPECT_EQ(toYaml(fromText("")), defaults);
  EXPECT_EQ(toYaml(fromText("# only a comment\n")), defaults);
  EXPECT_EQ(toYaml(fromText("map: ~\n")), defaults);
  EXPECT_EQ(toYaml(loadParameters(yaml())), defaults);
}

TEST(ParameterYaml, readsEveryKindOfValue)
{
  const Parameters p = fromText(R"(
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
  EXPECT_EQ(p.input.lidar_sensor_label, "lidar_\\d+");
  EXPECT_FALSE(p.input.T_vehicle_imu.has_value());
  EXPECT_DOUBLE_EQ(p.initialization.duration, 3.0);
  EXPECT_DOUBLE_EQ(p.initialization.max_gyro_mean, 10.0 * kRadPerDeg);
  EXPECT_FALSE(p.initialization.align_with_gravity);
  EXPECT_DOUBLE_EQ(p.imu.max_gap, 0.25);
  EXPECT_EQ(p.downsampling.target_points, 1234);
  EXPECT_EQ(p.gain, GainForm::Standard);
  EXPECT_EQ(p.threads, 2);
}

TEST(ParameterYaml, posesAreYawPitchRollInDegrees)
{
  const Parameters p = fromText("input: {T_vehicle_lidar: [1, -2.5, 0.25, 90, 0, 180]}\n");
  ASSERT_TRUE(p.input.T_vehicle_lidar.has_value());
  const Pose& T = *p.input.T_vehicle_lidar;
  EXPECT_TRUE(T.p.isApprox(Vec3(1, -2.5, 0.25)));
  // Rolled upside down, then turned left: x points to y, y points to x, z points down.
  EXPECT_TRUE((T.R * Vec3::UnitX()).isApprox(Vec3::UnitY(), 1e-12));
  EXPECT_TRUE((T.R * Vec3::UnitY()).isApprox(Vec3::UnitX(), 1e-12));
  EXPECT_TRUE((T.R * Vec3::UnitZ()).isApprox(-Vec3::UnitZ(), 1e-12));
}

TEST(ParameterYaml, valuesSetInCodeWorkAsThoseOfText)
{
  yaml group = yaml::Map();
  group["max_gap"] = 0.1234567890123456;
  yaml document = yaml::Map();
  document["imu"] = group;
  document["lidar"] = yaml::Map({{"deskew", false}});
  document["threads"] = 3;
  const Parameters p = loadParameters(document);
  EXPECT_EQ(p.imu.max_gap, 0.1234567890123456);
  EXPECT_FALSE(p.lidar.deskew);
  EXPECT_EQ(p.threads, 3);
}

TEST(ParameterYaml, unknownKeysNameTheNearest)
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

TEST(ParameterYaml, everyProblemIsListedAtOnce)
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

TEST(ParameterYaml, refusesWhatIsNotAPlainFiniteNumber)
{
  for (const char* bad :
       {"nan", ".nan", ".inf", "-.inf", "inf", "1,5", "0x10", "1.5m", "''", "[1]", "{a: 1}", "~",
        "1e999", "true", "1 2"})
    expectContains(problemOf(std::string("map:\n  radius: ") + bad + "\n"), "is not a number");
}

TEST(ParameterYaml, refusesBadPosesAndExpressions)
{
  expectContains(problemOf("input: {T_vehicle_imu: [1, 2, 3]}\n"), "a list of 3 is not a pose");
  expectContains(problemOf("input: {T_vehicle_imu: 7}\n"), "'7' is not a pose");
  expectContains(problemOf("input: {T_vehicle_imu: [1, 2, 3, 4, 5, x]}\n"), "'x' is not a pose");
  expectContains(problemOf("input: {imu_sensor_label: '(imu'}\n"), "is not a regular expression");
  EXPECT_FALSE(fromText("input: {T_vehicle_imu: null}\n").input.T_vehicle_imu.has_value());
}

TEST(ParameterYaml, relationsBetweenParametersAreChecked)
{
  expectContains(
      problemOf("lidar: {min_range: 20, max_range: 10}\n"),
      "lidar.min_range: must be below lidar.max_range");
}

TEST(ParameterYaml, fileErrorsNameTheFile)
{
  const std::string missing = messageOf<std::runtime_error>(
      [] { (void)loadParametersFromFile("/nonexistent/parameters.yaml"); });
  expectContains(missing, "/nonexistent/parameters.yaml: cannot be read");
  (void)messageOf<std::runtime_error>([] { (void)loadParametersFromFile("/"); });
  expectContains(fileProblem("map:\n radius: 1\n  bad: 2\n"), ".yaml: is not valid YAML");
  expectContains(fileProblem("map:\n  radius: -1\n"), "fileErrorsNameTheFile.yaml: 1 problem");
}

TEST(ParameterYaml, whatTheParserSilentlyLeavesOutIsAnError)
{
  expectContains(
      fileProblem("map: {radius: 10, \nthreads: 3\nlidar:\n  deskew: false\n"),
      "cannot be read from here on");
  expectContains(fileProblem("threads: 3\n}\nlidar:\n  deskew: false\n"), "lidar: cannot be read");
}

TEST(ParameterYaml, keysGivenTwiceAreErrors)
{
  const std::string message = fileProblem(
      "map:\n  radius: 10\n# comment: x\nlidar:\n  deskew: true\n  deskew: false\nmap:\n  radius: "
      "5\n");
  expectContains(message, "line 6, lidar.deskew: is given a second time (first in line 5)");
  expectContains(message, "line 7, map: is given a second time (first in line 1)");
}

TEST(ParameterYaml, limitsThemselvesAreAllowedAndBeyondIsNot)
{
  for (const auto& row : parameterTable())
  {
    const auto* real = std::get_if<RealValue>(&row.value);
    if (real == nullptr) continue;
    for (const double limit : {real->min, real->max})
    {
      const double beyond =
          limit + (limit == real->min ? -1e-3 : 1e-3) * std::max(1.0, std::abs(limit));
      const auto problemAt = [&row](double x)
      { return withValue(row, Parameters{}, yaml::node_t(x)).problem; };
      EXPECT_FALSE(problemAt(limit).has_value()) << row.key << " " << limit;
      EXPECT_TRUE(problemAt(beyond).has_value()) << row.key << " " << beyond;
    }
  }
}

TEST(ParameterYaml, validateChecksWhatWasSetInCode)
{
  EXPECT_NO_THROW(validate(Parameters{}));
  Parameters p;
  p.map.radius = std::numeric_limits<double>::quiet_NaN();
  p.threads = -1;
  p.initialization.max_gyro_std = -kRadPerDeg;
  p.gain = static_cast<GainForm>(7);
  p.input.T_vehicle_imu = Pose{2.0 * Mat3::Identity(), Vec3::Zero()};
  p.lidar.min_range = p.lidar.max_range;
  const std::string message = messageOf<std::invalid_argument>([&p] { validate(p); });
  expectContains(message, "6 problems");
  expectContains(message, "map.radius: is not a finite number");
  expectContains(
      message, "initialization.max_gyro_std: -1 is out of range; allowed: 0.001 to 500 deg/s");
  expectContains(message, "input.T_vehicle_imu: has a matrix that is not a rotation");
}
