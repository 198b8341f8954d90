// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file feature_lines.h The scan lines of a sweep: points in the order in which one laser saw
 * them.
 */
#pragma once

#include <fastlio/lidar/scan.h>

#include <array>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** The order that makes points neighbours in the scan. */
enum class ScanLineOrder
{
  Automatic,  //!< Ring when the points have rings, else Elevation or Time, whichever fits
  Ring,       //!< a line per value of the ring field (spinning sensors, lasers of a rosette)
  Elevation,  //!< a line per elevation of the beam: spinning sensors whose rings are not known
  Time        //!< one line in the order of time: a single, non-repetitive beam
};

/** Points by scan line: line k consists of the points order[begin[k] .. begin[k + 1]). */
struct ScanLines
{
  std::vector<std::uint32_t> order;  //!< indices into the scan, in the order of time within a line
  std::vector<std::uint32_t> begin;  //!< one more than there are lines

  [[nodiscard]] std::size_t count() const { return begin.empty() ? 0 : begin.size() - 1; }
};

/** Sorts points into scan lines. Points of the same line and time keep their order. */
class ScanLineSorter
{
 public:
  /** \param usable indices of the points that take part, ascending; they must be finite and not at
   * the origin
   * \param lines reused storage of the result; empty lines are left out
   * \return the order in use: what Automatic has chosen */
  ScanLineOrder sort(
      const PointColumns& points, const std::vector<std::uint32_t>& usable, ScanLineOrder order,
      ScanLines& lines);

 private:
  /** Elevations are distinguished in steps of 0.1 deg: finer than the lines of any sensor. */
  static constexpr std::size_t kElevationBins = 1800;

  [[nodiscard]] bool haveRings(
      const PointColumns& points, const std::vector<std::uint32_t>& usable) const;
  [[nodiscard]] ScanLineOrder chooseWithoutRings(
      const PointColumns& points, const std::vector<std::uint32_t>& usable);
  void labelByElevation(const PointColumns& points, const std::vector<std::uint32_t>& usable);
  void labelByRing(const PointColumns& points, const std::vector<std::uint32_t>& usable);
  void collect(
      const PointColumns& points, const std::vector<std::uint32_t>& usable, ScanLines& lines);

  std::vector<std::uint16_t> label_;  // line of each usable point
  std::vector<std::uint32_t> by_time_, line_begin_;
  std::array<std::uint16_t, kElevationBins + 1> line_of_bin_{};
};

}  // namespace fastlio
