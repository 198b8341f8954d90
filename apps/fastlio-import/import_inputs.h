// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file import_inputs.h The inputs one after the other, or merged by their stamps. */
#pragma once

#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/sensors/sensor_summary.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fastlio
{
class ImportInputs
{
 public:
  /** Inputs that are merged may each have an IMU or a LiDAR of the same label: those of later
   * inputs get another one. */
  ImportInputs(const std::vector<std::string>& files, bool merge);

  /** Labels that sensors of a kind got, beside those that they have. */
  [[nodiscard]] std::vector<std::string> newLabels(SensorKind kind) const;

  /** Which labels are others now, for people. */
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

  /** Null after the last one. */
  [[nodiscard]] mrpt::obs::CObservation::Ptr next();
  [[nodiscard]] std::vector<ReadProblem> problems() const;
  [[nodiscard]] ReadProgress progress() const;

 private:
  struct NewLabel
  {
    SensorKind kind;
    std::string label;
  };

  struct Input
  {
    RawlogSource source;
    /** By class of the observation and label in the file. */
    std::map<std::pair<std::string, std::string>, NewLabel> labels = {};
    mrpt::obs::CObservation::Ptr waiting = {};  //!< its next one
  };

  void relabel(const std::vector<std::string>& files);
  /** \param sensors of each file */
  void relabel(
      SensorKind kind, const std::vector<std::string>& files,
      const std::vector<std::vector<SensorSummary>>& sensors);

  std::vector<Input> inputs_;
  std::vector<std::string> notes_;
};

}  // namespace fastlio
