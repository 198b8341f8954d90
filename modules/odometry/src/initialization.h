// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file initialization.h When and with what state the filter starts. */
#pragma once

#include "motion_initializer.h"
#include <fastlio/imu/imu_buffer.h>
#include <fastlio/initialization/motion_window.h>
#include <fastlio/initialization/static_initializer.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/lidar/queued_scan.h>

#include <optional>
#include <string>

namespace fastlio
{
/** The filter's start, or why it has to wait. */
struct StartDecision
{
  std::optional<FilterState> state;
  std::int64_t stamp_ns = 0;                  //!< instant of the state
  std::optional<MotionWindow> motion_window;  //!< of a start in motion
  bool drop_oldest = false;                   //!< no start is possible with the oldest scan
  std::string message;                        //!< without a state: why
};

/** Looks for a start in the oldest scans and samples, in the way of initialization.mode.
 *
 * At rest: the platform rests all through an accepted window, so that the filter may start anywhere
 * in it: it starts with the first scan, and the scans taken at rest build the map. In motion: see
 * motion_initializer.h. */
class StartFinder
{
 public:
  explicit StartFinder(const OdometryOptions& parameters) : parameters_(parameters) {}

  /** \param scans not empty \param imu not empty; samples that no start needs any more are
   * forgotten \param at_end nothing more will come */
  [[nodiscard]] StartDecision decide(const ScanQueue& scans, ImuBuffer& imu, bool at_end);

 private:
  [[nodiscard]] StartDecision decideAtRest(const ScanQueue& scans, ImuBuffer& imu, bool at_end);
  [[nodiscard]] StartDecision decideInMotion(const ScanQueue& scans, ImuBuffer& imu, bool at_end);
  [[nodiscard]] StartDecision decideAutomatically(
      const ScanQueue& scans, ImuBuffer& imu, bool at_end);
  [[nodiscard]] StartDecision confirmRest(
      StartDecision at_rest, bool sways, const ScanQueue& scans, ImuBuffer& imu, bool at_end);
  [[nodiscard]] StartDecision refuse(
      const MotionStart& start, const ScanQueue& scans, std::size_t count, ImuBuffer& imu);

  OdometryOptions parameters_;
  std::size_t refusals_ = 0;           // of starts in motion
  std::int64_t refused_until_ns_ = 0;  // scans that end by then are dropped for the reason below
  std::string refusal_;
  std::string not_at_rest_;  // why the last window was rejected; empty: none was
};

}  // namespace fastlio
