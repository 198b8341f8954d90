// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file plane_numbers.h The planes of the map that a scan has points on, numbered. */
#pragma once

#include <fastlio/map/surface_map.h>
#include <fastlio/matching/measured_scan.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
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
  /** Number of a plane of the map; kNone: the scan has no points on it. */
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  [[nodiscard]] std::uint32_t find(std::uint32_t plane) const;

 private:
  /** Where a plane has its number, if it has one. */
  struct Slot
  {
    std::uint32_t plane = 0;
    std::uint32_t number = kNone;  // the slot is free
  };

  /** How many slots a scan of so many points needs. */
  [[nodiscard]] static std::size_t slotsFor(std::size_t points);
  /** Of the plane or, if it has none, the one that is free for it. */
  [[nodiscard]] std::size_t slotOf(std::uint32_t plane) const;

  std::vector<Slot> slots_;  // at least a quarter is free; their number is a power of two
  std::vector<std::uint32_t> numbers_;
  std::uint32_t count_ = 0;
};

}  // namespace fastlio
