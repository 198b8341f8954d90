// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file eval_program.h Runs fastlio-eval as a user does: arguments in, exit status and text out. */
#pragma once

#include "sample_trajectories.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/wait.h>

namespace fastlio::testing
{
struct Outcome
{
  int status = -1;
  std::string output;
};

/** Runs a shell command; output is what it prints to standard output. */
inline Outcome runShell(const std::string& command)
{
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("popen failed");
  Outcome outcome;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.output.append(buffer.data(), n);
  const int status = pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

inline std::string contentOf(const std::filesystem::path& file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/** 100 m at 10 m/s; \a scale is that of the positions. */
inline std::string tumLine(double scale)
{
  std::ostringstream text;
  text << "# time x y z qx qy qz qw\n";
  for (int i = 0; i <= 100; ++i)
    text << 1700000000 + i / 10 << '.' << i % 10 << ' ' << scale * i << " 0 0 0 0 0 1\n";
  return text.str();
}

inline std::string kittiLine()
{
  std::ostringstream text;
  for (int i = 0; i <= 100; ++i)
    text << "1 0 0 " << i << " 0 1 0 0 0 0 1 0\n";
  return text.str();
}

/** Covariance of 1 m^2 and 1 rad^2 at each pose of tumLine(1.01). */
inline std::string covarianceCsv()
{
  const std::array names{"rx", "ry", "rz", "px", "py", "pz"};
  std::ostringstream header, values;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i; j < 6; ++j)
    {
      header << ",c_" << names[i] << '_' << names[j];
      values << (i == j ? ",1" : ",0");
    }
  std::ostringstream text;
  text << "# comment\nstamp_ns,x,y,z,qx,qy,qz,qw" << header.str() << '\n';
  for (int i = 0; i <= 100; ++i)
    text << 1700000000000000000 + i * 100000000LL << ',' << 1.01 * i << ",0,0,0,0,0,1"
         << values.str() << '\n';
  return text.str();
}

class FastlioEval : public ::testing::Test
{
 protected:
  FastlioEval()
  {
    write("truth.tum", tumLine(1.0));
    write("estimate.tum", tumLine(1.01));
  }

  void write(const std::string& name, const std::string& text) const
  {
    (void)folder_.write(name, text);
  }

  /** Runs the program in the folder; both output streams are captured. */
  [[nodiscard]] Outcome run(const std::string& arguments) const
  {
    return runShell(
        "cd '" + folder_.path() + "' && '" FASTLIO_EVAL_PROGRAM "' " + arguments + " 2>&1");
  }

  void expectOutcome(
      const std::string& arguments, int status, std::initializer_list<const char*> parts) const
  {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, status) << arguments << '\n' << outcome.output;
    for (const char* part : parts)
      EXPECT_NE(outcome.output.find(part), std::string::npos) << "'" << part << "' is missing in:\n"
                                                              << outcome.output;
  }

  testing::TemporaryFolder folder_;
};

}  // namespace fastlio::testing
