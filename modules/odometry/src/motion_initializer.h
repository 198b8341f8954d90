// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file motion_initializer.h The filter's start from the first scans of a platform in motion.
 *
 * Nothing is known of velocity, gravity's direction and gyro bias, but the filter estimates all of
 * them as soon as there are scans. So it is run over a window of scans from a prior that claims
 * nothing about them; the state at the window's end, followed back through the same inertial
 * samples (the exact inverse of eq. 4), is what the start should have been. Run again from there,
 * the first scans are compensated with the right motion and the map is sharp. After a few passes
 * the start no longer changes. The scans then go through the odometry once more, from that start
 * with the wide prior, so that none of them counts twice.
 *
 * The world is fixed by the pose at the first scan's *end*, where the map begins: that pose is
 * exact, and the prior at the scan's begin is what leads there, P_0 = Phi^-1 P_1 Phi^-T.
 */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/imu/imu_buffer.h>
#include <fastlio/initialization/motion_window.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/lidar/queued_scan.h>

#include <optional>
#include <string>

namespace fastlio
{
/** A start in motion, or why there is none. */
struct MotionStart
{
  std::optional<FilterState> state;  //!< at the first scan's begin; velocity etc. with wide prior
  MotionWindow motion_window;        //!< the scans of the window
  std::string message;
};

/** How many scans at the front of the queue make up a window of \a duration [s] that the inertial
 * samples cover; 0 while it is not complete. */
[[nodiscard]] std::size_t motionWindow(
    const ScanQueue& scans, const ImuBuffer& imu, double duration);

/** What scans say about a start at rest. */
enum class RestVerdict
{
  Confirmed,
  Open,   //!< they do not see motion along a direction, too little of it, or too few points match
  Denied  //!< the platform was not at rest, or they do not match each other
};

/** Do the first \a count scans agree with a start at rest? A single pass tells, where a start in
 * motion takes several. Poses that stay say so even where the accelerometer has a wrong scale.
 * Where they leave, the pass has to find the state that it began with: a platform that speeds up
 * evenly has a tilt, not a rest. A pass that takes the platform for resting leaves out the planes
 * that would show the motion, as they do not match: then the direction is open, and only a start in
 * motion can tell.
 * \param imu covers them \param at_rest the state at \a stamp_ns, not after the first scan's begin:
 * the platform may have moved off since */
[[nodiscard]] RestVerdict verdictOnRest(
    const ScanQueue& scans, std::size_t count, const ImuBuffer& imu,
    const OdometryOptions& parameters, const FilterState& at_rest, std::int64_t stamp_ns);

/** The start from the first \a count scans. \param imu covers them */
[[nodiscard]] MotionStart startInMotion(
    const ScanQueue& scans, std::size_t count, const ImuBuffer& imu,
    const OdometryOptions& parameters);

}  // namespace fastlio
