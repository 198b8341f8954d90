// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/config/config_document.h>
#include <fastlio/config/config_yaml.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

using namespace fastlio;
using mrpt::containers::yaml;
namespace fs = std::filesystem;

namespace
{
const fs::path kRoot = FASTLIO_SOURCE_DIR;

std::string textOf(const fs::path& path)
{
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/** Compares a generated file with what it should hold; with MRPT_FASTLIO_REGENERATE set, writes it.
 */
void expectInStep(const fs::path& path, const std::string& text)
{
  if (std::getenv("MRPT_FASTLIO_REGENERATE") != nullptr) std::ofstream(path) << text;
  EXPECT_EQ(textOf(path), text) << path
                                << " is out of step with the tables of options; run `make docs`";
}

/** A valid value for an option, somewhere inside of its range. */
template <class Random>
struct RandomValue
{
  Random& random;

  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random); }

  void operator()(const RealValue& v)
  {
    *v.member = (v.min + unit() * (v.max - v.min)) * v.si_per_unit;
  }
  void operator()(const IntegerValue& v)
  {
    *v.member = std::uniform_int_distribution<int>(v.min, v.max)(random);
  }
  void operator()(const SeedValue& v) { *v.member = random(); }
  void operator()(const EpochValue& v) { *v.member_ns = 1'000'000'000 * (random() % 1000); }
  void operator()(const BooleanValue& v) { *v.member = unit() < 0.5; }
  void operator()(const ChoiceValue& v) { v.write(random() % v.names.size()); }
  void operator()(const RegexValue& v)
  {
    *v.member = R"(it's # a: 'label' \d+ "[a-z]*" )" + std::to_string(random() % 100);
  }
  void operator()(const TextValue& v)
  {
    *v.member = "it's # a: 'list', of " + std::to_string(random() % 100);
  }
  void operator()(const VectorValue& v) { *v.member = Vec3::Random(); }
  void operator()(const PoseValue& v)
  {
    *v.member = Pose{Eigen::Quaterniond::UnitRandom().toRotationMatrix(), 10.0 * Vec3::Random()};
  }
  void operator()(const OptionalPoseValue& v)
  {
    v.member->emplace();
    (*this)(PoseValue{&**v.member});
  }
  void operator()(const NumbersValue& v)
  {
    v.member->resize(v.columns * (1 + random() % v.max_rows));
    for (double& number : *v.member)
      number = v.columns == 9 ? 0.01 * unit() : v.limit * (2.0 * unit() - 1.0);
    if (v.columns == 9)  // a matrix
      for (const std::size_t diagonal : {0, 4, 8})
        v.member->at(diagonal) += 1.0;
  }
};

template <class Random>
Config randomConfig(Random& random)
{
  Config config;
  for (const auto& row : configTable())
    std::visit(RandomValue<Random>{random}, row.value(config));
  LidarOptions& lidar = config.odometry.lidar;
  lidar.min_range = std::min(0.5 * lidar.max_range, 1000.0);
  return config;
}

void expectEqual(const OptionRow<Config>& row, Config a, Config b)
{
  const OptionValue in_a = row.value(a), in_b = row.value(b);
  if (const auto* pose = std::get_if<OptionalPoseValue>(&in_a); pose != nullptr && *pose->member)
  {
    const Pose& A = **pose->member;
    ASSERT_TRUE(std::get<OptionalPoseValue>(in_b).member->has_value()) << row.key;
    const Pose& B = **std::get<OptionalPoseValue>(in_b).member;
    EXPECT_TRUE(A.R.isApprox(B.R, 1e-12)) << row.key;
    EXPECT_TRUE(A.p.isApprox(B.p, 1e-12)) << row.key;
  }
  else if (const auto* real = std::get_if<RealValue>(&in_a);
           real != nullptr && real->si_per_unit == 1.0)
    EXPECT_EQ(*real->member, *std::get<RealValue>(in_b).member) << row.key;
  else if (real != nullptr)
    EXPECT_DOUBLE_EQ(*real->member, *std::get<RealValue>(in_b).member) << row.key;
  else
    EXPECT_EQ(valueText(in_a), valueText(in_b)) << row.key;
}

std::string originOf(std::string_view key)
{
  return key == "map.radius" ? "a file, line 3" : "default";
}
}  // namespace

TEST(ConfigTable, KeysAreUniqueAndGroupsStandTogether)
{
  std::set<std::string_view> keys, groups;
  std::string_view group = "-";
  for (const auto& row : configTable())
  {
    EXPECT_TRUE(keys.insert(row.key).second) << row.key << " appears twice";
    EXPECT_EQ(findOption(configTable(), row.key), &row);
    EXPECT_FALSE(row.effect.empty()) << row.key;
    if (groupOf(row.key) != group && !groupOf(row.key).empty())
    {
      EXPECT_TRUE(groups.insert(groupOf(row.key)).second) << groupOf(row.key);
    }
    group = groupOf(row.key);
  }
  EXPECT_EQ(findOption(configTable(), "no.such"), nullptr);
}

TEST(ConfigTable, MainOptionsAreFew)
{
  const auto& table = configTable();
  EXPECT_EQ(
      std::count_if(
          table.begin(), table.end(), [](const auto& row) { return row.tier == OptionTier::Main; }),
      26);
}

TEST(ConfigTable, MembersAreDistinct)
{
  // A row that points to the wrong member would change another row's value.
  std::mt19937 random(3);
  for (const auto& row : configTable())
  {
    Config changed;
    do
    {
      std::visit(RandomValue<std::mt19937>{random}, row.value(changed));
    } while (valueText(row, changed) == valueText(row, Config{}));
    for (const auto& other : configTable())
    {
      if (other.key != row.key)
      {
        EXPECT_EQ(valueText(other, changed), valueText(other, Config{}))
            << row.key << " changes " << other.key;
      }
    }
  }
}

TEST(ConfigDocument, GivenKeysAreWrittenAtTheirDefaults)
{
  Config config;
  config.odometry.lidar.min_range = 0.7;
  EXPECT_EQ(
      toYaml(
          config, [](std::string_view key) { return key == "lidar.max_range"; }, "# x\n"),
      "# x\nlidar:\n  min_range: 0.7\n  max_range: 150\n");
}

TEST(ConfigDocument, YamlLoadsBackToTheSame)
{
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i)
  {
    const Config config = randomConfig(random);
    const Config back = loadConfig(yaml::FromText(toYaml(config)));
    for (const auto& row : configTable())
      expectEqual(row, config, back);
  }
}

TEST(ConfigDocument, YamlHoldsWhatDiffersFromTheDefaults)
{
  EXPECT_EQ(toYaml(Config{}, "# Header.\n"), "# Header.\n");
  Config config;
  config.odometry.map.radius = 50.0;
  config.odometry.threads = 2;
  EXPECT_EQ(toYaml(config), "map:\n  radius: 50\nthreads: 2\n");
}

TEST(ConfigDocument, DumpsLoadBackToTheSameAndTellOrigins)
{
  std::mt19937 random(11);
  const Config config = randomConfig(random);
  const std::string dump = configDump(config, originOf, false);
  const Config back = loadConfig(yaml::FromText(dump));
  for (const auto& row : configTable())
  {
    expectEqual(row, config, back);
    EXPECT_NE(dump.find(std::string(nameOf(row.key)) + ": "), std::string::npos) << row.key;
  }
  EXPECT_NE(dump.find("  # a file, line 3\n"), std::string::npos);
}

TEST(ConfigDocument, DumpsOfTheMainOptionsHoldTheseAndWhatWasChanged)
{
  const auto count = [](const std::string& text)
  { return std::count(text.begin(), text.end(), '#'); };
  EXPECT_EQ(count(configDump({}, originOf, true)), 26);
  const auto origin = [](std::string_view key)
  { return std::string(key == "imu.hold" ? "a file" : "default"); };
  EXPECT_EQ(count(configDump({}, origin, true)), 27);
}

TEST(ConfigDocument, PosesAtTheGimbalLockSurvive)
{
  for (const double pitch : {-90.0, 90.0})
  {
    const std::string six = "[0, 0, 0, 30, " + std::to_string(pitch) + ", 50]";
    const Config p = loadConfig(yaml::FromText("input: {T_vehicle_imu: " + six + "}"));
    const Config back = loadConfig(yaml::FromText(toYaml(p)));
    EXPECT_TRUE(p.sensors.T_vehicle_imu->R.isApprox(back.sensors.T_vehicle_imu->R, 1e-9)) << six;
  }
}

TEST(ConfigDocument, NumbersAreShortAndDegreesRound)
{
  const Config p =
      loadConfig(yaml::FromText("initialization: {max_gyro_mean: 12.5}\nimu: {max_gap: 0.1}\n"));
  EXPECT_EQ(valueText(*findOption(configTable(), "initialization.max_gyro_mean"), p), "12.5");
  EXPECT_EQ(valueText(*findOption(configTable(), "imu.max_gap"), p), "0.1");
}

TEST(ConfigDocument, TheMarkdownPageIsInStep)
{
  const std::string page = configAsMarkdown();
  const auto expert = page.find("# Expert parameters");
  for (const auto& row : configTable())
  {
    const auto place = page.find("`" + std::string(row.key) + "`");
    EXPECT_NE(place, std::string::npos) << row.key;
    EXPECT_EQ(place < expert, row.tier == OptionTier::Main) << row.key;
  }
  expectInStep(kRoot / "docs" / "parameters.md", page);
}
