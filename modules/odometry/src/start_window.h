// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file start_window.h The first scans, over which a start is tried. */
#pragma once

#include <fastlio/imu/imu_buffer.h>
#include <fastlio/initialization/motion_prior.h>
#include <fastlio/initialization/motion_window.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/lidar/queued_scan.h>
#include <fastlio/math/pose.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** Of a start in motion, about zero: that of cars and drones [m/s]. */
inline constexpr double kFirstVelocityStd = 10.0;

/** One run over the window. */
struct StartPass
{
  NavState start;                   // that follows from the state at the window's end
  double mean_speed = 0.0;          // along the straight line from the first pose to the last [m/s]
  double rate_error = 0.0;          // of the gyro with the bias at the start [rad/s]
  double inlier_ratio = 0.0;        // of the scans, in the median
  double velocity_std = 0.0;        // at the end, least known direction [m/s]
  Vec3 least_known = Vec3::Zero();  // that direction, in the IMU frame at the start
  bool blind = false;               // the scans do not see motion in that direction
  std::string problem;
};

/** The first scans and the inertial samples that cover them, both of which it refers to. */
class StartWindow
{
 public:
  StartWindow(
      const ScanQueue& scans, std::size_t count, const ImuBuffer& imu,
      const OdometryOptions& parameters);

  [[nodiscard]] const MotionWindow& motionWindow() const { return window_; }
  [[nodiscard]] double force() const { return meanForce(all_); }
  [[nodiscard]] NavState guess() const { return firstGuess(all_, parameters_.initialization); }
  [[nodiscard]] FilterState prior(const NavState& x0, const PriorWidth& width) const
  {
    return startPrior(x0, width, first_scan_, parameters_.initialization);
  }

  /** \param far_off the scans lie far from the map: planes are searched for longer
   * \param stamp_ns of \a start, if not of the first scan's begin: an earlier one */
  [[nodiscard]] StartPass run(
      const FilterState& start, const OdometryOptions& parameters, bool far_off,
      std::optional<std::int64_t> stamp_ns = std::nullopt) const;

 private:
  /** Velocity and gravity at the first scan's end from all poses, then back to its begin. */
  void describeStart(
      const FilterState& end, const std::vector<StampedPose>& poses, const Inputs& between,
      StartPass& pass) const;

  const ScanQueue& scans_;
  std::size_t count_;
  const ImuBuffer& imu_;
  const OdometryOptions& parameters_;
  Inputs all_, first_scan_;
  MotionWindow window_;
};

}  // namespace fastlio
