// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file downsampling.h Which points of a scan take part: range gates and an even, unbiased
 * thinning.
 */
#pragma once

#include <fastlio/lidar/laser_widths.h>
#include <fastlio/lidar/scan.h>
#include <fastlio/parallel/workers.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace fastlio
{
/** Limits of the downsampling. */
struct DownsamplingLimits
{
  float min_range = 0.5F;            //!< [m]
  float max_range = 150.0F;          //!< [m]
  std::size_t target_points = 2000;  //!< about so many points are kept; 0 keeps all
  /** RMS range [m] beyond which the target grows with the range's square: as large as the surfaces
   * around the sensor are, so many points cover them as densely. */
  float wide_range = std::numeric_limits<float>::infinity();
  std::size_t wide_points = 0;  //!< where that growth ends
};

/** Chosen points, by index into the scan, and what was left out. */
struct ScanSelection
{
  std::vector<std::uint32_t> indices;  //!< ascending
  std::size_t dropped_invalid = 0;     //!< not finite, or exactly at the sensor
  std::size_t dropped_near = 0;
  std::size_t dropped_far = 0;
};

/** Thins scans to about the same density everywhere on the surfaces around the sensor.
 *
 * A scan's density on a surface falls with the square of the range r and with the distance w
 * between lasers, so a point is kept with probability min(1, c w r^2), c such that the target is
 * met. Where lasers are about evenly spaced, w is 1. So it is in narrow places, where the lines of
 * all lasers lie close together. The draw is a low-discrepancy sequence over the point index,
 * another one for each scan: reproducible, and a resting sensor does not keep choosing the same
 * beams.
 *
 * A voxel grid would not do: it keeps one point of every voxel that has any, so where a wall lies
 * near a voxel's face the few points that noise carries across count as much as all others, and the
 * wall appears shifted towards the face by up to the noise. Here the choice hardly depends on the
 * noise. */
class Downsampler
{
 public:
  /** \param workers who share the loops; the choice does not depend on them */
  explicit Downsampler(std::shared_ptr<const Workers> workers = std::make_shared<const Workers>(1));

  /** Chooses points of the raw (not yet compensated) scan: those left out cost no compensation.
   * \param selection reused storage of the result */
  void select(
      const PointColumns& points, const DownsamplingLimits& limits, ScanSelection& selection);

  /** In the latest scan, some lasers are several times as far apart as most, and so far from the
   * surfaces that their lines are metres apart. */
  [[nodiscard]] bool seesSparseLines() const { return sparse_lines_; }

 private:
  static constexpr std::size_t kBins = 256;
  static constexpr std::size_t kChunk = 4096;  // points

  /** The effect of the range gates on some points. */
  struct Ranges
  {
    std::array<std::uint32_t, kBins> counts{};  //!< of usable points, by logarithm of w r^2
    std::size_t usable = 0, invalid = 0, near = 0, far = 0;
    double area_excess = 0.0;  //!< sum of w r^2 - r^2 over the usable points [m^2]

    void countDropped(float squared_range, float least_squared_range);
  };

  [[nodiscard]] Ranges gateRanges(
      const PointColumns& points, const DownsamplingLimits& limits, std::size_t first,
      std::size_t last);
  [[nodiscard]] Ranges gateRanges(const PointColumns& points, const DownsamplingLimits& limits);
  [[nodiscard]] double weighByWidth(const std::uint16_t* rings, std::size_t n, float* areas) const;
  [[nodiscard]] static std::size_t targetOf(const Ranges& ranges, const DownsamplingLimits& limits);
  [[nodiscard]] static float densityFactor(const Ranges& ranges, std::size_t target);
  [[nodiscard]] std::size_t keep(float factor, std::size_t first, std::size_t last);
  void gather(std::vector<std::uint32_t>& indices) const;

  std::shared_ptr<const Workers> workers_;
  std::uint32_t scan_ = 0;
  LaserWidths widths_;
  bool sparse_lines_ = false;
  // Per point, and per chunk of points.
  std::vector<float> areas_;              //!< w r^2 [m^2]; 0 for points that are left out
  std::vector<std::uint32_t> kept_;       //!< a chunk's chosen points, at the chunk's beginning
  std::vector<std::size_t> kept_counts_;  //!< how many these are
  std::vector<Ranges> chunk_ranges_;
};

}  // namespace fastlio
