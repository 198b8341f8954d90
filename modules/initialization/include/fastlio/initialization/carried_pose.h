// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file carried_pose.h The run is re-initialised: what is carried over to the new start. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/interface/odometry_options.h>

namespace fastlio
{
/** The last state that is believed, moved on to the new start. */
struct CarriedPose
{
  NavState x;                           //!< pose, gravity and calibration count
  StateMatrix P = StateMatrix::Zero();  //!< of \a x
  bool new_map = false;                 //!< the old one is not to be trusted
};

/** The state \a unknown_s seconds later when nothing is known about the motion in between but
 * that it accelerates (1 m/s^2) and turns (20 deg/s): the velocity goes on for a second at most.
 * What it turns moves it off the straight way. */
[[nodiscard]] CarriedPose carriedOver(const FilterState& last, double unknown_s);

/** A start in a world of its own (position zero, heading free) as a start in the world of the
 * carried pose: gravity has its direction there, position and heading are the carried ones, with
 * their uncertainty. */
[[nodiscard]] FilterState startInCarriedWorld(const FilterState& start, const CarriedPose& carried);

}  // namespace fastlio
