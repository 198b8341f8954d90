// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file import_inputs.h The inputs one after the other, or merged by their stamps. */
#pragma once

#include <fastlio/rawlog/rawlog_source.h>

#include <map>
#include <string>
#include <vector>

namespace fastlio
{
class ImportInputs
{
 public:
  /** Inputs that are merged may each have an IMU of the same label: those of later inputs get
   * another one. */
  ImportInputs(const std::vector<std::string>& files, bool merge);

  /** Labels that inputs got, beside those that they have. */
  [[nodiscard]] std::vector<std::string> newLabels() const;

  /** Which labels are others now, for people. */
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

  /** Null after the last one. */
  [[nodiscard]] mrpt::obs::CObservation::Ptr next();
  [[nodiscard]] std::vector<ReadProblem> problems() const;
  [[nodiscard]] ReadProgress progress() const;

 private:
  struct Input
  {
    RawlogSource source;
    std::map<std::string, std::string> labels = {};  //!< of IMUs: new ones by old ones
    mrpt::obs::CObservation::Ptr waiting = {};       //!< its next one
  };

  void relabel(const std::vector<std::string>& files);

  std::vector<Input> inputs_;
  std::vector<std::string> notes_;
};

}  // namespace fastlio
