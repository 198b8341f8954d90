// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file feature_extraction.h Planar and edge features by the smoothness of the scan lines (section
 * III-B of the paper, after Zhang and Singh, "LOAM: Lidar Odometry and Mapping in Real-time", RSS
 * 2014, section V-A).
 *
 * The smoothness of a point is the distance to the chord between the centroids of its neighbours on
 * both sides in the scan line, divided by their mean distance:
 *
 *     c = |(m_l - x) x (m_r - m_l)| / |m_r - m_l| / ((|m_l - x| + |m_r - x|) / 2)
 *
 * 0 on a straight line, 0.71 at a right angle that is met symmetrically, at most 1. LOAM divides by
 * the range and by the number of neighbours instead, so that its thresholds depend on the sensor's
 * resolution; and it takes the vector to the neighbours' centroid, which on a slanting wall does
 * not vanish because the spacing grows with the range. Neighbours are those within a length, not a
 * number of points: close to the sensor a number of points would span less than the noise. */
#pragma once

#include <fastlio/lidar/feature_lines.h>
#include <fastlio/lidar/scan.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** Thresholds of the extraction. */
struct FeatureLimits
{
  float min_range = 0.5F;    //!< blind range [m]
  float max_range = 150.0F;  //!< [m]
  ScanLineOrder line_order = ScanLineOrder::Automatic;
  double half_width = 0.5;  //!< neighbours reach so far to each side [m]
  double min_incidence =
      0.3490658503988659;        //!< least angle between surface and beam [rad]; 20 deg
  double max_beam_gap = 0.0349;  //!< beams farther apart are not neighbours [rad]
};

/** The features of a scan, by index into it, ascending. A point is in one list at most. */
struct ScanFeatures
{
  std::vector<std::uint32_t> planar;
  std::vector<std::uint32_t> edges;
  std::size_t dropped_invalid = 0;  //!< not finite, or exactly at the sensor
  std::size_t dropped_near = 0;
  std::size_t dropped_far = 0;
  ScanLineOrder line_order = ScanLineOrder::Ring;  //!< that was used
};

/** Finds features; holds nothing but storage that is reused from scan to scan.
 *
 * A scan line is cut wherever it does not follow one surface: at a gap between the beams, at a
 * distance between points, and where the range jumps so far that the surface in between would be
 * met at less than the least incidence. That leaves out, on both sides, the borders of what stands
 * before something else: the far side's border is a shadow that moves with the sensor, and the near
 * side's, on a round or thin thing, mostly so. A point becomes a feature only with all neighbours
 * on both sides within its piece, which leaves out isolated points; and only where each side is met
 * under the least incidence. Nor where the laser itself turns, as in the loops of a rosette: there
 * the line bends on a flat wall too. */
class FeatureExtractor
{
 public:
  /** \param points the raw scan, not compensated: neighbours in a line are close in time
   * \param features reused storage of the result */
  void extract(const PointColumns& points, const FeatureLimits& limits, ScanFeatures& features);

 private:
  /** Neighbours of a point: [first, itself) and (itself, last]. */
  struct Window
  {
    std::size_t first = 0, last = 0;
    bool complete = false;
  };
  struct Shape
  {
    double smoothness = 0.0;
    bool usable = false;
  };
  /** Vectors from a point to the centroids of its neighbours on both sides. */
  struct Sides
  {
    Vec3 left = Vec3::Zero(), right = Vec3::Zero();
  };

  void gateRanges(const PointColumns& points, const FeatureLimits& limits, ScanFeatures& features);
  void loadLine(const PointColumns& points, std::size_t line);
  [[nodiscard]] bool isConnected(std::size_t k) const;
  void describePiece(std::size_t begin, std::size_t end, const FeatureLimits& limits);
  [[nodiscard]] std::size_t windowFirst(
      std::size_t i, std::size_t begin, std::size_t guess, const FeatureLimits& limits) const;
  [[nodiscard]] std::size_t windowLast(
      std::size_t i, std::size_t end, std::size_t guess, const FeatureLimits& limits) const;
  [[nodiscard]] bool isComplete(std::size_t i, std::size_t outermost, const FeatureLimits& l) const;
  [[nodiscard]] static Sides sidesOf(
      std::size_t i, const Window& window, const std::vector<Vec3>& values,
      const std::vector<Vec3>& sums);
  [[nodiscard]] Shape shapeOf(std::size_t i, const Window& window) const;
  [[nodiscard]] bool isSharpest(std::size_t i) const;
  void classifyLine(ScanFeatures& features) const;

  /** Values derived from the limits. */
  struct Bounds
  {
    double beam_chord = 0.0;     // between unit beams of neighbours
    double jump_per_step = 0.0;  // of the range, per distance across the beam
    double max_cosine = 0.0;     // between surface and beam
  };

  Bounds bounds_;
  ScanLineSorter sorter_;
  ScanLines lines_;
  std::vector<std::uint32_t> usable_;
  // Of the line at hand.
  std::vector<std::uint32_t> index_;
  std::vector<Vec3> point_;
  std::vector<double> range_;
  std::vector<Vec3> beam_;
  std::vector<Vec3> point_sum_, beam_sum_;  // of all points before
  std::vector<Window> window_;
  std::vector<Shape> shape_;
};

}  // namespace fastlio
