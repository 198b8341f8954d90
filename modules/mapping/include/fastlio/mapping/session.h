// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file session.h One run that goes into a map: its recording, and the odometry over it. */
#pragma once

#include <fastlio/config/config.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/survey/input_plan.h>
#include <fastlio/survey/sensor_selection.h>

#include <functional>
#include <string>
#include <vector>

namespace fastlio
{
/** What a pass through a recording met. */
struct SessionPass
{
  std::size_t scans = 0;
  std::vector<ReadProblem> problems;
  BridgeStatistics bridge;
  Vec3 lidar_in_imu = Vec3::Zero();  //!< position of the LiDAR, as the scans have it [m]
  bool stopped = false;              //!< \a use asked for it
};

/** A recording with everything that the odometry needs. The odometry gives the same results in
 * every pass; so nothing of a pass has to be kept for the next one. */
class Session
{
 public:
  /** Looks for the sensors; takes in the preset of the LiDAR that the recording names.
   * \param is_given whether the user gave a key of the configuration
   * \exception std::runtime_error the recording cannot be read or has no usable sensors
   * \exception std::invalid_argument an option is out of range */
  Session(
      std::string name, std::vector<std::string> files, Config config,
      const std::function<bool(std::string_view)>& is_given);

  /** Runs the odometry. \param use every result, with the odometry that made it; false: stop
   * \param share how much of the recording has been read, 0 to 1; may be empty
   * \param imu every sample, as Odometry::setSampleCallback() gives it; may be empty */
  SessionPass run(
      const std::function<bool(const ScanResult&, const Odometry&)>& use,
      const std::function<void(double share)>& progress = {},
      const std::function<void(const ImuSample&)>& imu = {}) const;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }
  [[nodiscard]] const Config& config() const { return config_; }
  [[nodiscard]] const SensorSelection& selection() const { return selection_; }
  [[nodiscard]] const InputPlan& plan() const { return plan_; }
  /** What people should know about the sensors. */
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::string name_;
  std::vector<std::string> files_;
  Config config_;
  SensorSelection selection_;
  InputPlan plan_;
  std::vector<std::string> notes_;
};

}  // namespace fastlio
