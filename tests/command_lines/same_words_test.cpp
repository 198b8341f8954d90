// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// The options of the programs have the same names.

#include "process.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace fastlio::testing
{
namespace
{
/** A program, and the words beside -q, --help and --version that it shares. */
struct Program
{
  const char* name;
  std::vector<std::string> words;
  std::string example = {};  //!< of an option with a letter exchanged
};

/** The name of a test in lists. */
std::ostream& operator<<(std::ostream& out, const Program& program)
{
  return out << program.name;
}

const Program kPrograms[] = {
    {"fastlio-replay", {"-c,--config", "-o,--output-dir", "--set", "--overwrite"}, "--overwrit"},
    {"fastlio-info", {"-c,--config", "--set", "--json", "--write-config"}, "--jsn"},
    {"fastlio-eval", {"--json", "--plot"}, "--plto"},
    {"fastlio-sim", {"-o,--output-dir", "--set", "--overwrite"}, "--overwrit"},
    {"fastlio-import", {"-o,--output", "--overwrite"}, "--overwrit"},
    {"fastlio-calibrate",
     {"-c,--config", "-o,--output", "--set", "--json", "--overwrite"},
     "--jsn"},
    {"fastlio-map", {"-c,--config", "-o,--output-dir", "--set", "--overwrite"}, "--overwrit"},
    {"fastlio-tune", {"-c,--config", "-o,--output", "--json", "--overwrite"}, "--jsn"},
};

class SameWords : public ::testing::TestWithParam<Program>
{
 protected:
  [[nodiscard]] ProcessResult run(std::vector<std::string> arguments) const
  {
    arguments.insert(arguments.begin(), std::string(FASTLIO_PROGRAM_FOLDER "/") + GetParam().name);
    return Process(arguments, folder_.file("log.txt")).wait();
  }

  TemporaryFolder folder_;
};

TEST_P(SameWords, AreInTheHelp)
{
  const ProcessResult help = run({"--help"});
  EXPECT_EQ(help.exit_status, 0);
  std::vector<std::string> words = GetParam().words;
  words.insert(words.end(), {"-h,--help", "--version", "-q,--quiet"});
  for (const std::string& word : words)
    EXPECT_NE(help.output.find(word), std::string::npos) << "no " << word << " in\n" << help.output;
}

TEST_P(SameWords, TheHelpShowsNothingOfTheParser)
{
  const ProcessResult help = run({"--help"});
  for (const char* rest : {"->", "{false}", "\n  --input-rawlog FILE REQUIRED"})
    EXPECT_EQ(help.output.find(rest), std::string::npos) << rest << " in\n" << help.output;
  // An option that is a positional argument, too, is not asked for twice.
  const std::size_t required = help.output.find("REQUIRED");
  EXPECT_EQ(
      help.output.find("REQUIRED", required + (required == std::string::npos ? 0 : 1)),
      std::string::npos)
      << help.output;
}

TEST_P(SameWords, TheVersionNamesTheProgram)
{
  const ProcessResult version = run({"--version"});
  EXPECT_EQ(version.exit_status, 0);
  EXPECT_EQ(version.output.find(std::string(GetParam().name) + " 0."), 0U) << version.output;
}

TEST_P(SameWords, AnUnknownOptionNamesTheNearest)
{
  const ProcessResult result = run({GetParam().example, "nothing"});
  EXPECT_NE(result.exit_status, 0);
  EXPECT_NE(result.output.find("did you mean '--"), std::string::npos) << result.output;
  EXPECT_EQ(result.output.find(GetParam().name), 0U) << result.output;
}

TEST_P(SameWords, AnUnknownOptionThatIsLikeNoneNamesNone)
{
  const ProcessResult result = run({"--qqq", "nothing"});
  EXPECT_NE(result.exit_status, 0);
  EXPECT_EQ(result.output.find("did you mean"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("--help"), std::string::npos) << result.output;
}

TEST_P(SameWords, TheBeginningOfAnOptionIsEnoughToNameIt)
{
  const ProcessResult result = run({"--vers", "nothing"});
  EXPECT_NE(result.output.find("did you mean '--version'"), std::string::npos) << result.output;
}

TEST_P(SameWords, WithoutAnythingNothingHappens)
{
  const ProcessResult result = run({});
  EXPECT_NE(result.exit_status, 0);
  EXPECT_NE(result.output.find(GetParam().name), std::string::npos) << "no example in\n"
                                                                    << result.output;
  EXPECT_EQ(result.output.find("--input-rawlog is required"), std::string::npos) << result.output;
}

INSTANTIATE_TEST_SUITE_P(
    Programs, SameWords, ::testing::ValuesIn(kPrograms),
    [](const auto& parameter)
    {
      std::string name = parameter.param.name;
      name.erase(name.find('-'), 1);
      return name;
    });

}  // namespace
}  // namespace fastlio::testing
