// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file replay_test_support.h A folder per test and the program in it. */
#pragma once

#include "box_recording.h"
#include "folder_listing.h"
#include "process.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace fastlio::testing
{
/** Runs fastlio-replay in a folder of its own, removed at the end. */
class ReplayTest : public ::testing::Test
{
 protected:
  void SetUp() override
  {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("fastlio-replay-" + std::string(test->test_suite_name()) + "-" + test->name() + "-" +
               std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }

  void TearDown() override
  {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  [[nodiscard]] std::string file(const std::string& name) const
  {
    return (folder_ / name).string();
  }

  [[nodiscard]] std::string record(const std::string& name, const BoxRecording& recording) const
  {
    writeBoxRecording(file(name), recording);
    return file(name);
  }

  [[nodiscard]] std::string write(const std::string& name, const std::string& content) const
  {
    std::ofstream(file(name), std::ios::binary) << content;
    return file(name);
  }

  [[nodiscard]] static std::vector<std::string> command(std::vector<std::string> arguments)
  {
    arguments.insert(arguments.begin(), FASTLIO_REPLAY_PROGRAM);
    return arguments;
  }

  [[nodiscard]] ProcessResult replay(const std::vector<std::string>& arguments) const
  {
    return Process(command(arguments), file("log.txt")).wait();
  }

  /** Input and output folder "out", as most tests want them. */
  [[nodiscard]] ProcessResult replayFile(
      const std::string& rawlog, std::vector<std::string> further = {}) const
  {
    further.insert(further.end(), {"--input-rawlog", rawlog, "--output-dir", file("out")});
    return replay(further);
  }

  [[nodiscard]] static std::string contentOf(const std::string& path)
  {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

  [[nodiscard]] static std::size_t linesOf(const std::string& path)
  {
    const std::string text = contentOf(path);
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }

  /** Every output file is there, complete, and nothing else. */
  void expectAllFiles() const
  {
    for (const auto* name :
         {"trajectory.tum", "states.csv", "covariance.csv", "timing.csv", "untrusted.csv",
          "map.ply", "map.metricmap", "report.html", "summary.json"})
      EXPECT_TRUE(std::filesystem::exists(file("out/" + std::string(name)))) << name;
    const std::string names = namesIn(file("out"));
    EXPECT_EQ(names.find(".tmp"), std::string::npos) << names;
    EXPECT_EQ(names.find(".fastlio"), std::string::npos) << names;
  }

 private:
  std::filesystem::path folder_;
};

/** Checks the exit status and that the output mentions a text. */
inline void expectEnd(const ProcessResult& result, int status, const std::string& mentioned)
{
  EXPECT_EQ(result.exit_status, status) << result.output;
  EXPECT_NE(result.output.find(mentioned), std::string::npos) << "no '" << mentioned << "' in:\n"
                                                              << result.output;
}

}  // namespace fastlio::testing
