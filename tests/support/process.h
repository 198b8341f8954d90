// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file process.h Runs a program and waits, with a limit. */
#pragma once

#include <chrono>
#include <string>
#include <sys/types.h>
#include <vector>

namespace fastlio::testing
{
/** How a program ended and what it printed. */
struct ProcessResult
{
  int exit_status = -1;  //!< -1: ended by a signal or by the time limit
  std::string output;    //!< standard output and error together
};

/** A running program; killed on destruction if it still runs. */
class Process
{
 public:
  /** Starts \a command (program and arguments), its output going to the file \a log. */
  Process(const std::vector<std::string>& command, std::string log);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  [[nodiscard]] ProcessResult wait(std::chrono::seconds limit = std::chrono::seconds(120));

 private:
  pid_t pid_ = -1;
  std::string log_;
};

}  // namespace fastlio::testing
