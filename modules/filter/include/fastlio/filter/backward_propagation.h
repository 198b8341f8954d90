// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file backward_propagation.h Where the body was at each instant of a scan, seen from its pose at
 * the scan's end (eq. 9). */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/filter/state.h>

#include <vector>

namespace fastlio
{
/** Body motion at one instant relative to the body at the scan's end t_k (frame I_k). */
struct MotionKnot
{
  std::int64_t stamp_ns = 0;  //!< instant of the knot
  Mat3 R = Mat3::Identity();  //!< R_Ik_Ij
  Vec3 p = Vec3::Zero();      //!< position of I_j in I_k [m]
  Vec3 v = Vec3::Zero();      //!< velocity at the knot, in I_k [m/s]
  Vec3 w = Vec3::Zero();      //!< bias-free rate held from this knot to the next [rad/s]
  Vec3 a = Vec3::Zero();      //!< bias-free acceleration held likewise, gravity included, in I_k;
                              //!< with the attitude in the middle of that time
};

/** Eq. 9 from t_k backwards over the scan's inertial samples, as the exact inverse of the forward
 * steps (eq. 4): the knots meet the forward poses relative to the end to within rounding.
 * \param end_state state at t_k
 * \param end_ns t_k [ns]
 * \param samples time-ordered; sample i holds until sample i+1, the last one until t_k; samples at
 * or after t_k take no part
 * \param knots replaced by knots at the samples' stamps, ascending, the last being t_k itself (it
 * repeats the last input, for instants after t_k); its storage is reused from scan to scan
 * \throw std::invalid_argument when a sample is older than its predecessor */
void backwardPropagate(
    const NavState& end_state, std::int64_t end_ns, const std::vector<ImuSample>& samples,
    std::vector<MotionKnot>& knots);

/** T_Ik_Ij: pose of the body dt [s], of either sign, after a knot whose inputs hold that long. */
[[nodiscard]] Pose poseAfter(const MotionKnot& knot, double dt);

/** T_Ik_Ij: pose of the body at stamp_ns in the body frame at the scan's end, from the knot at its
 * left. Continuous over the knots; instants before the first knot use the first knot's input.
 * \throw std::invalid_argument when there are no knots */
[[nodiscard]] Pose bodyPoseAt(const std::vector<MotionKnot>& knots, std::int64_t stamp_ns);

}  // namespace fastlio
