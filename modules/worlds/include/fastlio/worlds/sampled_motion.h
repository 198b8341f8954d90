// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file sampled_motion.h Poses of a motion at many instants that lie close together. */
#pragma once

#include <fastlio/worlds/motion.h>

#include <array>
#include <cstdint>
#include <optional>

namespace fastlio
{
/** The motion's poses every 0.1 ms, and polynomials of degree 5 between them. A laser fires every
 * few microseconds, and a vibrating carrier's pose takes sixty sines.
 *
 * The error is below 1e-11 m and rad for vibrations up to 200 Hz, and the pose at an instant is the
 * same whichever was asked for before. The motion must outlive it. */
class SampledMotion
{
 public:
  explicit SampledMotion(const Motion& motion) : motion_(&motion) {}

  /** Pose of the IMU at t [s] since the start; a later instant near the last one is the fastest. */
  [[nodiscard]] Pose at(double t);

 private:
  static constexpr std::size_t kKnots = 6;

  void moveTo(std::int64_t first);

  const Motion* motion_;
  std::array<Pose, kKnots> knots_;
  std::optional<std::int64_t> first_;  // number of the first knot
};

}  // namespace fastlio
