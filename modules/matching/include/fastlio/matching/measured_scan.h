// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file measured_scan.h The measurements of a scan at one pose (eq. 14), kept for everybody who
 * needs them: the update, the search for degenerate directions, the models of shared errors. */
#pragma once

#include <fastlio/filter/update.h>
#include <fastlio/lidar/deskew.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/matching/measurement_block.h>
#include <fastlio/matching/point_to_plane.h>
#include <fastlio/parallel/workers.h>

#include <cstddef>
#include <vector>

namespace fastlio
{
/** Reserves for twice as many elements where there is no room for \a n: scans differ in size, and a
 * scan that is a little larger shall not allocate. */
template <typename Element>
void makeRoom(std::vector<Element>& elements, std::size_t n)
{
  if (n > elements.capacity()) elements.reserve(2 * n);
}

/** The consistent matches of a scan, in the order of its points. The chunks are those of Workers;
 * the result does not depend on how many share them. Keeps its storage. */
class MeasuredScan
{
 public:
  /** Measures a scan at a pose; forgets the one before. */
  void measure(
      const Workers& workers, const Pose& T_world_scan, const BodyPoints& body,
      const std::vector<PlaneMatch>& matches, const ResidualModel& model);

  /** Sums over all points. */
  [[nodiscard]] const InformationSums& sums() const { return sums_; }

  [[nodiscard]] std::size_t chunks() const { return chunks_.size(); }
  /** Blocks of all chunks are numbered through; numbers below this one may occur. */
  [[nodiscard]] std::size_t blockNumbers() const { return blocks_.size(); }

  /** Calls use(block, number of the block) for the blocks of a chunk, in order. */
  template <typename Use>
  void forEachBlockOf(std::size_t chunk, const Use& use) const
  {
    const std::size_t first = chunk * kBlocksPerChunk;
    for (std::size_t number = first; number < first + chunks_[chunk].blocks; ++number)
      use(blocks_[number], number);
  }

  /** The same for all chunks. */
  template <typename Use>
  void forEachBlock(const Use& use) const
  {
    for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk)
      forEachBlockOf(chunk, use);
  }

 private:
  struct Chunk
  {
    std::size_t blocks = 0;  // in use
    InformationSums sums;
  };
  static constexpr std::size_t kBlocksPerChunk = Workers::kChunk / kLanes;

  std::vector<MeasurementBlock> blocks_;
  std::vector<Chunk> chunks_;
  InformationSums sums_;
};

}  // namespace fastlio
