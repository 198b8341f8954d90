// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file import_inputs.h The inputs one after the other, or merged by their stamps. */
#pragma once

#include <fastlio/rawlog/rawlog_source.h>

#include <string>
#include <vector>

namespace fastlio
{
class ImportInputs
{
 public:
  ImportInputs(const std::vector<std::string>& files, bool merge);

  /** Null after the last one. */
  [[nodiscard]] mrpt::obs::CObservation::Ptr next();
  [[nodiscard]] std::vector<ReadProblem> problems() const;
  [[nodiscard]] ReadProgress progress() const;

 private:
  struct Input
  {
    RawlogSource source;
    mrpt::obs::CObservation::Ptr waiting;  //!< its next one
  };
  std::vector<Input> inputs_;
};

}  // namespace fastlio
