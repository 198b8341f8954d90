// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file failing_run.h fastlio-replay on a tiny recording while one of its calls fails. */
#pragma once

#include "process.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** A call of the program: "write path bytes", "rename path other", "injected kind path". */
struct JournalLine
{
  std::string what, path, other;
};

/** How a run ended whose call was refused. */
struct FailingRun
{
  ProcessResult result;
  std::vector<JournalLine> journal;
  bool injected = false;  //!< false: there were not so many calls
  std::string about;      //!< the file that the refused call was about
};

/** Names and contents of the files in a folder. */
using Files = std::map<std::string, std::string>;
[[nodiscard]] Files filesIn(const std::string& folder);

/** A recording, a configuration and an earlier run, and runs over it. */
class FailingRuns : public ::testing::Test
{
 protected:
  FailingRuns();

  /** The n-th call of a kind fails; the folder holds the earlier run, or does not exist. */
  [[nodiscard]] FailingRun run(const std::string& kind, int n, bool with_earlier) const;

  [[nodiscard]] std::string out() const { return folder_.file("out"); }
  [[nodiscard]] const Files& earlier() const { return earlier_; }
  [[nodiscard]] const Files& complete() const { return complete_; }
  [[nodiscard]] bool inputsAreUntouched() const { return filesIn(folder_.file("in")) == inputs_; }

 private:
  [[nodiscard]] std::vector<std::string> command() const;

  TemporaryFolder folder_;
  Files inputs_, earlier_, complete_;
};

}  // namespace fastlio::testing
