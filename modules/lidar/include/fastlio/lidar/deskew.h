// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file deskew.h Motion compensation: every point to the body frame at the scan's end (eq. 10). */
#pragma once

#include <fastlio/filter/backward_propagation.h>
#include <fastlio/lidar/beam_corrections.h>
#include <fastlio/lidar/scan.h>
#include <fastlio/parallel/workers.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace fastlio
{
/** Compensated points in the body (IMU) frame at the scan's end, columns of equal length. */
struct BodyPoints
{
  std::vector<float> x, y, z;           //!< [m]
  std::vector<float> ux, uy, uz;        //!< unit vector of the beam, body frame
  std::vector<std::uint16_t> beam_bin;  //!< of the elevation as measured (beamBin())

  [[nodiscard]] std::size_t size() const { return x.size(); }
  void resize(std::size_t n);
};

/** A short time of the motion: a point of the LiDAR frame at dt [s] from the middle comes to the
 * body frame at the scan's end by p_I_end = (M + dt N) p_L + (b + dt c). */
struct MotionStep
{
  std::int64_t begin_ns = 0, middle_ns = 0;
  Eigen::Matrix<float, 3, 3, Eigen::DontAlign> M, N;  //!< rotation, and its rate [1/s]
  Eigen::Matrix<float, 3, 1, Eigen::DontAlign> b, c;  //!< translation [m], and its rate [m/s]
};

/** Moves the points of scans to the body frame at the scan's end; its storage is reused. */
class Deskewer
{
 public:
  /** \param workers who share the points; the result does not depend on them */
  explicit Deskewer(std::shared_ptr<const Workers> workers = std::make_shared<const Workers>(1));

  /** Compensates the chosen points with the motion of backwardPropagate(), to first order within
   * short steps of it; points outside of the knots' span move with the nearest step.
   * \param indices which points of the scan, any order; output i belongs to indices[i]
   * \param body reused storage
   * of the result */
  void deskew(
      const LidarScan& scan, const std::vector<std::uint32_t>& indices,
      const std::vector<MotionKnot>& knots, BodyPoints& body,
      const BeamCorrections& beams = BeamCorrections());

  /** The same without motion: the extrinsic only. */
  void transformToBody(
      const LidarScan& scan, const std::vector<std::uint32_t>& indices, BodyPoints& body,
      const BeamCorrections& beams = BeamCorrections()) const;

 private:
  std::shared_ptr<const Workers> workers_;
  std::vector<MotionStep> steps_;
};

}  // namespace fastlio
