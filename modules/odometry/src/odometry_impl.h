// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file odometry_impl.h Queues, the order of events, and who processes what (internal). */
#pragma once

#include "carried_pose.h"
#include "health_monitor.h"
#include "initialization.h"
#include "scan_intake.h"
#include "scan_pipeline.h"
#include <fastlio/imu/imu_buffer.h>
#include <fastlio/imu/imu_conditioner.h>
#include <fastlio/odometry/odometry.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
class Odometry::Impl
{
 public:
  explicit Impl(const Parameters& parameters);

  void addImu(const ImuSample& sample);
  void addScan(LidarScan scan);
  std::optional<ScanResult> next(bool at_end);
  [[nodiscard]] std::optional<ImuRateState> stateAtNewestSample();
  [[nodiscard]] const InputStatistics& inputStatistics();
  [[nodiscard]] ImuReport imuReport() const { return conditioner_.report(); }

  const Parameters parameters_;
  ScanPipeline pipeline_;
  std::vector<Diagnostic> diagnostics_;

 private:
  /** The run is to be split here. */
  struct Break
  {
    std::int64_t begin_ns = 0, end_ns = 0;  // nothing is known in between
    bool new_map = false;                   // nothing before was right
  };

  void take(const std::vector<ConditionedSample>& samples);
  void take(const ConditionedSample& conditioned);
  void finishInputs();
  [[nodiscard]] std::optional<ScanResult> waitForStart(bool at_end);
  [[nodiscard]] std::optional<ScanResult> giveUpOldest(bool at_end);
  [[nodiscard]] std::optional<ScanResult> passBreaks();
  [[nodiscard]] std::optional<ScanResult> processOldest();
  void start(const StartDecision& decision);
  void split(const CarriedPose& carried, const std::string& why, std::int64_t stamp_ns);
  void noticeLoss(const ScanResult& result);
  void diagnostic(std::int64_t stamp_ns, std::string text);
  [[nodiscard]] bool waitsTooLong(std::int64_t end_ns) const;
  [[nodiscard]] bool usable(const ScanSpan& span);
  [[nodiscard]] QueuedScan popScan();

  InputStatistics statistics_;  // completed by inputStatistics()
  std::size_t imu_out_of_order_ = 0, scans_out_of_order_ = 0, scans_without_time_ = 0;
  ImuConditioner conditioner_;
  ImuBuffer imu_;
  ScanIntake intake_;
  StartFinder start_finder_;
  HealthMonitor health_;
  std::deque<Break> breaks_;
  std::optional<CarriedPose> carried_;    // the run was split and has not started anew yet
  std::optional<FilterState> last_good_;  // of the latest scan that was tracked well
  std::int64_t last_good_ns_ = 0;
  std::int64_t lost_since_ns_ = 0;  // scans see enough, the pose is not trusted; 0: it is
};

}  // namespace fastlio
