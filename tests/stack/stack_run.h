// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file stack_run.h A simulated walk through fastlio-replay, and MRPT's own programs on what it
 * wrote. */
#pragma once

#include "process.h"
#include <fastlio/simulation/simulation.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** Where a program is, when it is installed. */
[[nodiscard]] std::optional<std::string> findProgram(const std::string& name);

/** One recording and its outputs, shared by the tests of this program and removed at the end. */
class StackRun
{
 public:
  /** Simulates and replays at the first call. */
  static const StackRun& get();

  [[nodiscard]] const Simulation& simulation() const { return simulation_; }
  [[nodiscard]] std::string file(const std::string& name) const
  {
    return (folder_ / name).string();
  }
  /** Of the replay with single observations ("observations") or pairs ("actions"). */
  [[nodiscard]] std::string output(const std::string& form, const std::string& name) const
  {
    return (folder_ / form / name).string();
  }

  StackRun(const StackRun&) = delete;
  StackRun& operator=(const StackRun&) = delete;
  ~StackRun();

 private:
  StackRun();
  void replay(const std::string& form, const std::string& exporters) const;

  std::filesystem::path folder_;
  Simulation simulation_;
};

/** A test that runs a program of MRPT; skipped, loudly, where it is not installed. */
class StackTest : public ::testing::Test
{
 protected:
  /** Runs it with arguments, in the environment of this process and \a variables (NAME=VALUE). */
  [[nodiscard]] ProcessResult run(
      const std::string& program, const std::vector<std::string>& arguments,
      const std::vector<std::string>& variables = {}) const;

  [[nodiscard]] std::string file(const std::string& name) const { return stack().file(name); }
  [[nodiscard]] std::string write(const std::string& name, const std::string& content) const;
  [[nodiscard]] static const StackRun& stack() { return StackRun::get(); }
};

#define REQUIRE_PROGRAM(name)                               \
  if (!findProgram(name))                                   \
  GTEST_SKIP() << "*** NOT TESTED: the program '" << (name) \
               << "' is not installed (Debian: apt-get install mrpt-apps)"

}  // namespace fastlio::testing
