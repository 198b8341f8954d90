// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file degeneracy.h Which motions a scan does not constrain: along a tunnel, across an open
 * field, in front of one wall. */
#pragma once

#include <fastlio/interface/scan_constraints.h>
#include <fastlio/matching/point_to_plane.h>

#include <cstdint>
#include <vector>

namespace fastlio
{
/** The consistent matches of a scan in the order of their planes. Keeps its storage. */
class RowsByPlane
{
 public:
  /** Allocates for so many points, and for some more. */
  void reserve(std::size_t points);
  /** Forgets all rows and makes room for those of so many points. */
  void clear(std::size_t points);
  /** Row h and weight of the match of point i; different points may come from different threads. */
  void set(std::size_t i, std::uint32_t plane, double weight, const Vector6& h);
  /** To be called once all rows are set. */
  void sort();
  /** Information along a direction of the three planes that say most about it [1/m^2].
   * \param direction of a step of the scan pose */
  [[nodiscard]] double strongest(const Vector6& direction) const;

 private:
  struct Row
  {
    std::uint32_t plane = 0;
    double weight = 0.0;  // 0: no consistent match
    Vector6 h;
  };

  std::vector<Row> rows_;             // by point
  std::vector<std::uint64_t> order_;  // plane and point of each consistent match
};

/** What a plane's own points do not show about its normal: walls bend, lasers have offsets, and the
 * map turned a little between two of its planes. Half a degree about each of two axes [rad^2]. */
inline constexpr double kNormalVariance = 2.0 * 0.00873 * 0.00873;

/** Information that appears where there is none, because the normals of the map are noisy: the sum
 * of w_j cov(h_j), the rows' covariance for the normals' variance and kNormalVariance. A wall of a
 * tunnel that is known to a degree seems to constrain the position along the tunnel. Of the points
 * [first, last); the parts of a scan add up.
 * \param rows receives the consistent matches of these points */
[[nodiscard]] Matrix6 normalNoiseInformation(
    const Pose& T_world_scan, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const ResidualModel& model, std::size_t first, std::size_t last, RowsByPlane& rows);

/** The information of a scan by direction, of which none is left out yet. \param information the
 * sum of w h h^T \param noise_information from normalNoiseInformation() */
[[nodiscard]] ScanConstraints informationByDirection(
    const Matrix6& information, const Matrix6& noise_information);

/** Computes the supported information of the weak directions. A plane that a voxel at an edge has
 * fitted to points of two walls may stand across a tunnel. It is certain of a position that nothing
 * else confirms, so one or two planes never constrain a direction. \param rows of the whole scan,
 * sorted */
void withoutStrongestPlanes(const RowsByPlane& rows, ScanConstraints& constraints);

/** A direction is unconstrained where its information is not more than \a min_signal_to_noise times
 * that of the noise, or where its supported information is not more than six tenths of that; and
 * so are all weaker ones. */
void leaveOutUnconstrained(double min_signal_to_noise, ScanConstraints& constraints);

/** True when some direction has so much less information than the best one that it is worth the
 * while to look for noise in it. */
[[nodiscard]] bool mayBeDegenerate(const Matrix6& information);

/** The direction has so much less information than the best one that few planes may show it. */
[[nodiscard]] bool isWeak(const ScanConstraints& constraints, int direction);

/** The unconstrained directions as plain motions, each by its larger part. */
[[nodiscard]] std::vector<MotionDirection> unconstrainedMotions(const ScanConstraints& constraints);

/** The sums with the unconstrained directions taken out: what is left moves the others only. */
[[nodiscard]] InformationSums constrainedSums(
    const InformationSums& sums, const ScanConstraints& constraints);

}  // namespace fastlio
