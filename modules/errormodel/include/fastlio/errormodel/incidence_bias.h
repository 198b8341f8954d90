// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file incidence_bias.h The range of a slanted surface is measured too short or too long: the near
 * side of the beam's footprint returns first. */
#pragma once

#include <fastlio/errormodel/calibration_sums.h>
#include <fastlio/matching/measured_scan.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** The bias of the range at an angle of incidence, over that at 80 deg: (1 - cos) / (1 - cos 80).
 * \param cosine of the angle of incidence, positive */
[[nodiscard]] double incidenceShape(double cosine);

/** Learns the bias from planes that are seen at several angles of incidence: a plane lies where the
 * scans before have put it, with the bias of their angles, so only the difference shows. */
class IncidenceBias
{
 public:
  /** \param along cosine between beam and normal, of either sign
   * \param plane the plane that the point lies on */
  void add(std::uint32_t plane, double along, const PointMeasurement& point);
  /** All points of a scan were added. \param information sum of w h h^T over them */
  void finishScan(const Matrix6& information);

  /** There is no map any more. */
  void forgetMap() { planes_.clear(); }
  [[nodiscard]] const BiasSums& sums() const { return sums_; }

 private:
  /** What one unit of the bias does to a plane. */
  struct Plane
  {
    float weight = 0.0F, mean = 0.0F;
  };

  std::vector<Plane> planes_;
  BiasSums scan_, sums_;
  Vector6 pull_ = Vector6::Zero();  // sum of w h times the derivative, of the scan
};

}  // namespace fastlio
