// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file laser_widths.h How much of the surroundings each laser of a spinning LiDAR stands for. */
#pragma once

#include <fastlio/lidar/scan.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** Measures the lasers' distances in elevation with the first scans.
 *
 * Many LiDARs have most of their lasers near the horizon, a third of a degree apart, and few below,
 * several degrees apart. Each of these stands for as much of the ground as dozens of the others
 * would. The solid angle between two lasers is the difference of the sines of their elevations. */
class LaserWidths
{
 public:
  /** Looks at a scan in the LiDAR frame, whose z axis is the one that the lasers spin about. Does
   * nothing after the first scans: the lasers stay as they are. */
  void learn(const PointColumns& points);

  /** Solid angle of each laser over the mean of all, by PointColumns::ring. Empty where the lasers
   * are about evenly spaced or have no elevation of their own, as those of a rosette. */
  [[nodiscard]] const std::vector<float>& relative() const { return relative_; }

  /** The same of one laser: 1 where nothing is known.
   * \param ring any */
  [[nodiscard]] float of(std::uint16_t ring) const
  {
    return ring < relative_.size() ? relative_[ring] : 1.0F;
  }

 private:
  /** The elevations that a laser was seen at. */
  struct Laser
  {
    double sum = 0.0, squares = 0.0;  // of their sines
    std::size_t count = 0;
  };

  void update();

  std::vector<Laser> lasers_;  // by ring
  std::vector<float> relative_;
  int scans_ = 0;
};

}  // namespace fastlio
