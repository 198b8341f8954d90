// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file deskew.h Motion compensation: every point to the body frame at the scan's end (eq. 10). */
#pragma once

#include <fastlio/filter/backward_propagation.h>
#include <fastlio/lidar/scan.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** Compensated points in the body (IMU) frame at the scan's end, columns of equal length. */
struct BodyPoints
{
  std::vector<float> x, y, z;     //!< [m]
  std::vector<float> ux, uy, uz;  //!< unit vector of the beam, body frame

  [[nodiscard]] std::size_t size() const { return x.size(); }
  void resize(std::size_t n);
};

/** Compensates the chosen points with the motion of backwardPropagate(), to first order within
 * short steps of it; points outside of the knots' span move with the nearest step. \param indices
 * which points of the scan, any order; output i belongs to indices[i] \param body reused storage of
 * the result */
void deskew(
    const LidarScan& scan, const std::vector<std::uint32_t>& indices,
    const std::vector<MotionKnot>& knots, BodyPoints& body);

/** The same without motion: the extrinsic only. */
void transformToBody(
    const LidarScan& scan, const std::vector<std::uint32_t>& indices, BodyPoints& body);

}  // namespace fastlio
