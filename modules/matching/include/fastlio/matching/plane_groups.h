// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plane_groups.h The measurements of a scan, put together by the plane of the map that they
 * lie on: points on one plane share its error. */
#pragma once

#include <fastlio/filter/state.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/matching/measured_scan.h>
#include <fastlio/matching/plane_numbers.h>
#include <fastlio/parallel/workers.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** The points of a scan on one plane; rows h by the scan pose, weights w = 1 / variance. */
struct PlaneGroup
{
  Vector6 g = Vector6::Zero();   //!< sum of w h
  double shared_variance = 0.0;  //!< of the plane's offset, weighted mean over the points [m^2]
  double weight = 0.0;           //!< sum of w
  std::uint32_t created_insertion = 0;         //!< insertion that created the plane
  std::uint32_t before = PlaneNumbers::kNone;  //!< number of its group in the scan before
};

/** A scan's measurements by plane. */
struct GroupedMeasurements
{
  Matrix6 information = Matrix6::Zero();   //!< sum of w h h^T
  Matrix6 shared_noise = Matrix6::Zero();  //!< sum of w^2 s h h^T, s the points' shared variance
  /** Covariance of the sums by the planes' own errors: sum of s g g^T over the planes. */
  Matrix6 plane_errors = Matrix6::Zero();
  /** The same with those of the scan before: s g g'^T over the planes that both have seen. */
  Matrix6 plane_errors_before = Matrix6::Zero();
  std::vector<PlaneGroup> groups;  //!< in the order of their first point
};

/** Groups scan after scan; remembers what the scan before has seen. */
class PlaneGrouping
{
 public:
  /** The measurements of a scan by plane; valid until the next call. */
  const GroupedMeasurements& group(
      const Workers& workers, const MeasuredScan& scan, const std::vector<PlaneMatch>& matches);

 private:
  void addPoints(const MeasuredScan& scan, const std::vector<PlaneMatch>& matches);
  void finishGroups();

  GroupedMeasurements result_;
  std::vector<PlaneGroup> groups_before_;  // of the scan before
  std::vector<Matrix6> chunk_noise_;
  PlaneNumbers planes_, planes_before_;  // of the scan and of the one before
};

}  // namespace fastlio
