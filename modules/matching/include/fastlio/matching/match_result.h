// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file match_result.h A scan ready to be matched, and what the match found. */
#pragma once

#include <fastlio/filter/scan_pose.h>
#include <fastlio/filter/update.h>
#include <fastlio/lidar/deskew.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/matching/degeneracy.h>
#include <fastlio/matching/measured_scan.h>
#include <fastlio/matching/point_to_plane.h>

#include <vector>

namespace fastlio
{
/** With fewer matches the scan is not used: a handful of points agrees with any pose. */
inline constexpr std::size_t kMinEffectivePoints = 20;

/** A scan after eq. 9-10: its points in the body frame at its end, and how they got there. */
struct DeskewedScan
{
  BodyPoints surfaces;  //!< to be matched with planes
  BodyPoints edges;     //!< to be matched with lines; may be empty
  CompensatedWith compensation;
  Pose T_imu_lidar;           //!< where the beams start
  bool sparse_lines = false;  //!< Downsampler::seesSparseLines()
};

/** Enough points, of surfaces and edges together, to be matched or to begin a map. */
[[nodiscard]] inline bool hasEnoughPoints(const DeskewedScan& scan)
{
  return scan.surfaces.size() + scan.edges.size() >= kMinEffectivePoints;
}

/** The posterior of a scan, and the evidence for it. */
struct MatchResult
{
  UpdateResult update;          //!< posterior, gain, and the sums at the last iterate
  ResidualModel model;          //!< decided which matches count
  ScanConstraints constraints;  //!< degenerate directions, which the update left alone
  double association_ms = 0.0;  //!< time spent on searching the map [ms]
  std::size_t mapped = 0;  //!< points where the map has a plane or a line, of the last association
  /** Of the last association, by surface point; storage of the matcher. */
  const std::vector<PlaneMatch>* matches = nullptr;
  /** At the last iterate; storage of the matcher. */
  const MeasuredScan* measured = nullptr;
};

}  // namespace fastlio
