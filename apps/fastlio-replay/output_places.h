// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file output_places.h Where a run writes, and that it destroys nothing there. */
#pragma once

#include "command_line.h"
#include <fastlio/config/config.h>
#include <fastlio/run/run_folder.h>
#include <fastlio/run/run_summary.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** The places that a command line asks for, checked. */
struct OutputPlan
{
  std::optional<RunFolderPlan> folder;  //!< --output-dir
  std::string tum_folder;               //!< of --output-tum-path; empty: none
  std::vector<std::string> inputs;      //!< what the run reads, which it never removes
};

/** Checks, without making or changing anything, that the outputs can be written, are different
 * files than the inputs and each other, and replace only what a run has written.
 * \exception std::exception otherwise; the message names the file */
[[nodiscard]] OutputPlan planOutputs(const ReplayArguments& arguments, const Config& config);

/** The arguments without a trajectory that is written into the folder under the same name anyway.
 */
[[nodiscard]] ReplayArguments withoutDoubleTrajectory(
    ReplayArguments arguments, const Config& config);

/** The folders of a run, made and held until its end. */
class OutputPlaces
{
 public:
  /** \exception std::runtime_error another run holds the folder, or it cannot be made */
  explicit OutputPlaces(OutputPlan plan);

  /** Once all outputs are complete: removes what only the run before has written. */
  void removeLeftovers(const RunSummary& summary) const;

 private:
  OutputPlan plan_;
  std::optional<RunFolder> folder_;
  MadeFolders tum_folder_;
};

}  // namespace fastlio
