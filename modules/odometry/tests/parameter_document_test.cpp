// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/odometry/parameter_table.h>
#include <fastlio/odometry/parameter_text.h>
#include <fastlio/odometry/parameter_yaml.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

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

/** The comment lines that a file starts with. */
std::string headerOf(const std::string& text)
{
  std::istringstream lines(text);
  std::string header, line;
  while (std::getline(lines, line) && !line.empty() && line[0] == '#')
    header += line + "\n";
  return header;
}

/** Compares a generated file with what it should hold; with MRPT_FASTLIO_REGENERATE set, writes it.
 */
void expectInStep(const fs::path& path, const std::string& text)
{
  if (std::getenv("MRPT_FASTLIO_REGENERATE") != nullptr) std::ofstream(path) << text;
  EXPECT_EQ(textOf(path), text) << path
                                << " is out of step with parameter_table.cpp; run `make docs`";
}

std::vector<fs::path> parameterFiles()
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kRoot / "params"))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  return files;
}

/** A valid value for a row, somewhere inside of its range. */
template <class Random>
Parameters withRandomValue(const ParameterRow& row, Parameters p, Random& random)
{
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  if (const auto* real = std::get_if<RealValue>(&row.value))
    real->member.in(p) = (real->min + unit(random) * (real->max - real->min)) * real->si_per_unit;
  if (const auto* integer = std::get_if<IntegerValue>(&row.value))
    integer->member.in(p) = std::uniform_int_distribution<int>(integer->min, integer->max)(random);
  if (const auto* boolean = std::get_if<BooleanValue>(&row.value))
    boolean->member.in(p) = unit(random) < 0.5;
  if (const auto* choice = std::get_if<ChoiceValue>(&row.value))
    choice->write(p, random() % choice->names.size());
  if (const auto* regex = std::get_if<RegexValue>(&row.value))
    regex->member.in(p) = R"(it's # a: 'label' \d+ "[a-z]*" )" + std::to_string(random() % 100);
  if (const auto* text = std::get_if<TextValue>(&row.value))
    text->member.in(p) = "it's # a: 'list', of " + std::to_string(random() % 100);
  if (const auto* pose = std::get_if<PoseValue>(&row.value))
    pose->member.in(p) =
        Pose{Eigen::Quaterniond::UnitRandom().toRotationMatrix(), 10.0 * Vec3::Random()};
  return p;
}

template <class Random>
Parameters randomParameters(Random& random)
{
  Parameters p;
  for (const auto& row : parameterTable())
    p = withRandomValue(row, p, random);
  p.lidar.min_range = 0.5 * p.lidar.max_range < 1000.0 ? 0.5 * p.lidar.max_range : 1000.0;
  return p;
}

void expectEqual(const ParameterRow& row, const Parameters& a, const Parameters& b)
{
  const auto* pose = std::get_if<PoseValue>(&row.value);
  const auto* real = std::get_if<RealValue>(&row.value);
  if (pose != nullptr && pose->member.of(a).has_value())
  {
    ASSERT_TRUE(pose->member.of(b).has_value()) << row.key;
    EXPECT_TRUE(pose->member.of(a)->R.isApprox(pose->member.of(b)->R, 1e-12)) << row.key;
    EXPECT_TRUE(pose->member.of(a)->p.isApprox(pose->member.of(b)->p, 1e-12)) << row.key;
  }
  else if (real != nullptr && real->si_per_unit == 1.0)
    EXPECT_EQ(real->member.of(a), real->member.of(b)) << row.key;
  else if (real != nullptr)
    EXPECT_DOUBLE_EQ(real->member.of(a), real->member.of(b)) << row.key;
  else
    EXPECT_EQ(valueText(row, a), valueText(row, b)) << row.key;
}

std::size_t keyCount(const yaml::node_t& node)
{
  if (!node.isMap()) return 1;
  std::size_t count = 0;
  for (const auto& entry : node.asMap())
    count += keyCount(entry.second);
  return count;
}
}  // namespace

TEST(ParameterTable, keysAreUniqueAndGroupsStandTogether)
{
  std::set<std::string_view> keys, groups;
  std::string_view group = "-";
  for (const auto& row : parameterTable())
  {
    EXPECT_TRUE(keys.insert(row.key).second) << row.key << " appears twice";
    EXPECT_EQ(findParameter(row.key), &row);
    EXPECT_FALSE(row.effect.empty()) << row.key;
    if (row.group() != group)
    {
      EXPECT_TRUE(groups.insert(row.group()).second) << row.group();
    }
    group = row.group();
  }
  EXPECT_EQ(findParameter("no.such"), nullptr);
}

TEST(ParameterTable, membersAreDistinct)
{
  // A row that points to the wrong member would change another row's value.
  std::mt19937 random(3);
  for (const auto& row : parameterTable())
  {
    Parameters changed = withRandomValue(row, Parameters{}, random);
    while (valueText(row, changed) == valueText(row, Parameters{}))
      changed = withRandomValue(row, changed, random);
    for (const auto& other : parameterTable())
    {
      if (other.key != row.key)
      {
        EXPECT_EQ(valueText(other, changed), valueText(other, Parameters{}))
            << row.key << " changes " << other.key;
      }
    }
  }
}

TEST(ParameterDocument, yamlLoadsBackToTheSame)
{
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i)
  {
    const Parameters p = randomParameters(random);
    const Parameters back = loadParameters(yaml::FromText(toYaml(p)));
    for (const auto& row : parameterTable())
      expectEqual(row, p, back);
  }
}

TEST(ParameterDocument, posesAtTheGimbalLockSurvive)
{
  for (const double pitch : {-90.0, 90.0})
  {
    const std::string six = "[0, 0, 0, 30, " + std::to_string(pitch) + ", 50]";
    const Parameters p = loadParameters(yaml::FromText("input: {T_vehicle_imu: " + six + "}"));
    const Parameters back = loadParameters(yaml::FromText(toYaml(p)));
    EXPECT_TRUE(p.input.T_vehicle_imu->R.isApprox(back.input.T_vehicle_imu->R, 1e-9)) << six;
  }
}

TEST(ParameterDocument, numbersAreShortAndDegreesRound)
{
  const Parameters p = loadParameters(
      yaml::FromText("initialization: {max_gyro_mean: 12.5}\nimu: {max_gap: 0.1}\n"));
  EXPECT_EQ(valueText(*findParameter("initialization.max_gyro_mean"), p), "12.5");
  EXPECT_EQ(valueText(*findParameter("imu.max_gap"), p), "0.1");
}

TEST(ParameterDocument, theVelodyneFileHoldsEveryKeyWithItsDefault)
{
  const auto path = kRoot / "params" / "velodyne_vlp16.yaml";
  expectInStep(path, toYaml(Parameters{}, headerOf(textOf(path))));
  EXPECT_EQ(keyCount(yaml::FromFile(path.string()).node()), parameterTable().size());
}

TEST(ParameterDocument, everyFileOfParamsLoadsAndIsInStep)
{
  ASSERT_FALSE(parameterFiles().empty());
  for (const auto& path : parameterFiles())
  {
    const Parameters p = loadParametersFromFile(path.string());
    expectInStep(path, toYaml(p, headerOf(textOf(path))));
  }
}

TEST(ParameterDocument, theMarkdownPageIsInStep)
{
  const std::string page = parametersAsMarkdown();
  for (const auto& row : parameterTable())
    EXPECT_NE(page.find("`" + std::string(row.key) + "`"), std::string::npos) << row.key;
  expectInStep(kRoot / "docs" / "parameters.md", page);
}
