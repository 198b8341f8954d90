// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file odometry_impl.h Queues, the order of events, and who processes what (internal). */
#pragma once

#include "estimator.h"
#include "initialization.h"
#include "reinitialization.h"
#include "scan_intake.h"
#include <fastlio/health/classify.h>
#include <fastlio/health/run_diagnostics.h>
#include <fastlio/imu/imu_buffer.h>
#include <fastlio/imu/imu_conditioner.h>
#include <fastlio/lidar/beam_corrections.h>
#include <fastlio/lidar/own_body.h>
#include <fastlio/lidar/range_unit.h>
#include <fastlio/odometry/odometry.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
class Odometry::Impl
{
 public:
  explicit Impl(const OdometryOptions& options);

  void startIn(const SavedMap& map);
  [[nodiscard]] bool relocalize(const PoseGuess& guess, const SavedMap* other);
  void addImu(const ImuSample& sample);
  void addScan(LidarScan scan);
  std::optional<ScanResult> next(bool at_end);
  /** A result as it is handed over: the estimator counts from the origin of its map. */
  [[nodiscard]] std::optional<ScanResult> handedOver(std::optional<ScanResult> result);
  [[nodiscard]] std::optional<ImuRateState> stateAtNewestSample();
  [[nodiscard]] const std::vector<ImuRateState>& imuRateStates() const;
  [[nodiscard]] const InputStatistics& inputStatistics();
  [[nodiscard]] ImuReport imuReport() const { return conditioner_.report(); }

  const OdometryOptions options_;
  Estimator estimator_;
  Vec3 map_origin_ = Vec3::Zero();
  RunDiagnostics diagnostics_;
  std::function<void(const ImuSample&)> sample_callback_;  // may be empty

 private:
  void take(const std::vector<ConditionedSample>& samples);
  void take(const ConditionedSample& conditioned);
  void finishInputs();
  [[nodiscard]] StartDecision decideStart(bool at_end);
  [[nodiscard]] std::optional<ScanResult> waitForStart(bool at_end);
  [[nodiscard]] std::optional<ScanResult> giveUpOldest(bool at_end);
  [[nodiscard]] std::optional<ScanResult> passBreaks();
  [[nodiscard]] std::optional<ScanResult> processOldest();
  void judgeOwnBody(const ScanResult& result, const Pose& T_imu_lidar);
  void start(const StartDecision& decision);
  void reinitialise(const std::string& why, std::int64_t stamp_ns);
  [[nodiscard]] bool waitsTooLong(std::int64_t end_ns) const;
  [[nodiscard]] bool usable(const ScanSpan& span, bool is_repeated);

  InputStatistics counted_;     // here, without what other stages drop
  InputStatistics statistics_;  // with it
  ImuConditioner conditioner_;
  ImuBuffer imu_;
  RangeUnit range_unit_;
  BeamCorrections beam_corrections_;
  OwnBody own_body_;
  ScanIntake intake_;
  StartFinder start_finder_;
  Reinitialization reinitialization_;
  std::vector<ImuRateState> imu_rate_in_world_;  // where map_origin_ is not zero
};

}  // namespace fastlio
