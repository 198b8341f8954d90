// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file scan_reduction.h Which points of a scan take part: range gates and one point per voxel. */
#pragma once

#include <fastlio/lidar/scan.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** Limits of the reduction. */
struct ReductionLimits
{
  float min_range = 0.5F;    //!< [m]
  float max_range = 150.0F;  //!< [m]
  float voxel_size = 0.5F;   //!< edge of the voxels of which one point each is kept [m]
};

/** Chosen points, by index into the scan, and what was left out. */
struct ScanSelection
{
  std::vector<std::uint32_t> indices;  //!< ascending
  std::size_t dropped_invalid = 0;     //!< not finite, or exactly at the sensor
  std::size_t dropped_near = 0;
  std::size_t dropped_far = 0;
};

/** Keeps the first point of each voxel of the raw (not yet compensated) scan.
 *
 * Choosing before the motion compensation spares compensating points that are then thrown away; the
 * choice needs no exact position. The voxel table is reused between scans, so the steady state does
 * not allocate. */
class ScanReducer
{
 public:
  /** \param selection reused storage of the result */
  void select(const PointColumns& points, const ReductionLimits& limits, ScanSelection& selection);

 private:
  struct Slot
  {
    std::uint64_t key = 0;
    std::uint32_t epoch = 0;
  };

  bool claim(std::uint64_t key);
  void startEpoch(std::size_t expected);

  std::vector<Slot> table_;
  std::uint32_t epoch_ = 0;
  std::size_t used_ = 0;
};

}  // namespace fastlio
