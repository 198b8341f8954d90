// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file mcap_output.h Observations, and the results of a run, as MCAP. */
#pragma once

#include "rawlog_parts.h"
#include "run_results.h"
#include <fastlio/bags/mcap_writer.h>

#include <cstddef>
#include <string>

namespace fastlio
{
/** Whether an output of this name is MCAP. */
[[nodiscard]] bool isMcapName(const std::string& path);

class McapOutput : public ImportOutput
{
 public:
  /** \exception std::runtime_error the output cannot be opened */
  McapOutput(const std::string& path, RunResults results);

  bool write(const mrpt::obs::CObservation& observation) override;
  [[nodiscard]] std::vector<OutputFile> finish() override;

 private:
  void writeResultsUntil(std::int64_t stamp_ns);

  RunResults results_;
  std::size_t next_pose_ = 0, next_diagnostic_ = 0;
  McapWriter writer_;
  bool anything_ = false;
};

}  // namespace fastlio
