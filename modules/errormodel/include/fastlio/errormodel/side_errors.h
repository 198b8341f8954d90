// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file side_errors.h Errors that all points on one side of the sensor share in a scan: a dark wall
 * is measured too far, a bright one too near, and so are wet or rough surfaces. Walls to the left
 * and to the right then turn a vehicle little by little, and no number of points averages it out.
 */
#pragma once

#include <fastlio/matching/measured_scan.h>

#include <array>
#include <cstddef>

namespace fastlio
{
/** Where a beam goes, and what it meets; in the axes of the sensor. */
struct BeamGeometry
{
  double forward = 0.0, left = 0.0;  //!< along the sensor's x and y axis [m]
  double along = 0.0;                //!< cosine between beam and normal, of either sign
  double upright = 0.0;              //!< cosine between the sensor's z axis and the normal
};

/** Learns how large such errors are, as an offset of the range, from the means of the residuals on
 * each side; says what they do to a scan. */
class SideErrors
{
 public:
  /** A new scan begins. */
  void beginScan() { sides_ = {}; }
  /** \param pull derivative of sum w h r by the offset: the cosine times the point's w h */
  void add(const BeamGeometry& beam, const PointMeasurement& point, const Vector6& pull);
  /** A beam that created the plane which a point of the scan is on. \param pull as of add() */
  void addCreation(const BeamGeometry& beam, const Vector6& pull);
  /** Learns from the scan, all of whose points were added. */
  void learn();

  /** Covariance of sum w h b over the scan, b by the offsets of the sides. */
  [[nodiscard]] Matrix6 covariance() const;
  /** Root mean square of the offsets; 0 while it is not known [m]. */
  [[nodiscard]] double rangeOffset() const;

 private:
  /** The points of one side; floor and ceiling are sides of their own. */
  struct Side
  {
    double information = 0.0, weighted = 0.0;  // of the offset
    Vector6 pull = Vector6::Zero();
  };
  static constexpr std::size_t kSides = 16;

  [[nodiscard]] double rangeVariance() const;

  std::array<Side, kSides> sides_;
  double squares_ = 0.0, noise_ = 0.0;  // sums over the offsets of all scans [m^2]
  double count_ = 0.0;
};

}  // namespace fastlio
