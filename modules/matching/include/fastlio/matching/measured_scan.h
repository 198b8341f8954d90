// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file measured_scan.h The measurements of a scan at one pose (eq. 14), kept for everybody who
 * needs them: the update, the search for degenerate directions, the models of shared errors. */
#pragma once

#include <fastlio/filter/update.h>
#include <fastlio/lidar/deskew.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/matching/point_to_plane.h>
#include <fastlio/parallel/workers.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** As many double-precision numbers as the widest registers of the processor family hold. */
inline constexpr std::size_t kLanes = 8;

/** Reserves for twice as many elements where there is no room for \a n: scans differ in size, and a
 * scan that is a little larger shall not allocate. */
template <typename Element>
void makeRoom(std::vector<Element>& elements, std::size_t n)
{
  if (n > elements.capacity()) elements.reserve(2 * n);
}

/** The measurement of one point. */
struct PointMeasurement
{
  Vector6 weighted_h = Vector6::Zero();  //!< w h, the row by the scan pose
  double weight = 0.0;                   //!< w = 1 / variance
  double z = 0.0;                        //!< residual [m]
};

/** The measurements of eight points side by side, one per lane. Where the weight is 0 the lane does
 * not count, and its row and residual are 0, too. */
struct MeasurementBlock
{
  std::uint32_t index[kLanes] = {};  //!< of the points in the scan
  double weight[kLanes] = {};        //!< w = 1 / variance [1/m^2]
  double z[kLanes] = {};             //!< residuals [m]
  double h[6][kLanes] = {};          //!< rows by the scan pose

  [[nodiscard]] PointMeasurement point(std::size_t lane) const
  {
    PointMeasurement m;
    for (std::size_t k = 0; k < 6; ++k)
      m.weighted_h[static_cast<Eigen::Index>(k)] = weight[lane] * h[k][lane];
    m.weight = weight[lane];
    m.z = z[lane];
    return m;
  }
};

/** The consistent matches of a scan, in the order of its points. Its chunks are those of Workers;
 * different ones may be measured by different threads. Keeps its storage. */
class MeasuredScan
{
 public:
  /** Forgets all and makes room for a scan of so many points. */
  void clear(std::size_t points);

  /** Measures the points [first, last), which are all of a chunk. */
  void measure(
      const Pose& T_world_scan, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
      const ResidualModel& model, std::size_t chunk, std::size_t first, std::size_t last);

  /** Sums over all points. */
  [[nodiscard]] InformationSums sums() const;

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
};

/** The planes of a scan, numbered 0, 1, ... in the order of their first points. Keeps its storage.
 */
class PlaneNumbers
{
 public:
  /** Makes room for the planes of a scan of so many points. */
  void reserve(std::size_t points);
  /** Numbers the planes of a scan. */
  void assign(const MeasuredScan& scan, const std::vector<PlaneMatch>& matches);

  /** How many planes there are. */
  [[nodiscard]] std::size_t count() const { return count_; }
  /** Number of the plane of a point: lane of a block. 0 where the lane does not count. */
  [[nodiscard]] std::uint32_t of(std::size_t block, std::size_t lane) const
  {
    return numbers_[block * kLanes + lane];
  }
  /** Whether the scan has points on a plane of the map. */
  [[nodiscard]] bool contains(std::uint32_t plane) const;

 private:
  /** Where a plane has its number, if it has one. */
  struct Slot
  {
    std::uint32_t plane = 0;
    std::uint32_t number = kFree;
  };
  static constexpr std::uint32_t kFree = ~std::uint32_t{0};

  /** How many slots a scan of so many points needs. */
  [[nodiscard]] static std::size_t slotsFor(std::size_t points);
  /** Of the plane or, if it has none, the one that is free for it. */
  [[nodiscard]] std::size_t slotOf(std::uint32_t plane) const;

  std::vector<Slot> slots_;  // at least a quarter is free; their number is a power of two
  std::vector<std::uint32_t> numbers_;
  std::uint32_t count_ = 0;
};

}  // namespace fastlio
