// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file degeneracy.h Which motions a scan does not constrain: along a tunnel, across an open
 * field, in front of one wall. */
#pragma once

#include <fastlio/interface/scan_constraints.h>
#include <fastlio/matching/measured_scan.h>
#include <fastlio/matching/plane_numbers.h>
#include <fastlio/matching/point_to_plane.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastlio
{
/** What a plane's own points do not show about its normal: walls bend, lasers have offsets, and the
 * map turned a little between two of its planes. Half a degree about each of two axes [rad^2]. */
inline constexpr double kNormalVariance = 2.0 * 0.00873 * 0.00873;

/** Scans whose weakest direction has more than this fraction of the strongest one's information are
 * far from degenerate: normals would have to be off by tens of degrees. */
inline constexpr double kClearlyConstrained = 0.05;

/** Information that appears where there is none, because the normals of the map are noisy: the sum
 * of w_j cov(h_j), the rows' covariance for the normals' variance and kNormalVariance. A wall of a
 * tunnel that is known to a degree seems to constrain the position along the tunnel. Of a chunk of
 * the measurements; the chunks of a scan add up. */
[[nodiscard]] Matrix6 normalNoiseInformation(
    const Mat3& R_world_scan, const BodyPoints& body, const std::vector<PlaneMatch>& matches,
    const MeasuredScan& scan, std::size_t chunk);

/** This part of the signal-to-noise ratio has to be left without the few planes that say most. In
 * corridors, spurious planes of realistic sensors leave up to two thirds, a floor that only near
 * points see more. */
inline constexpr double kSupportedPart = 0.8;
/** Of the scans of a start in motion, which have few planes and leave nothing out lightly. */
inline constexpr double kSupportedPartAtStart = 0.6;

/** Axes in the world, a column each; three at most, on the stack. */
using TranslationAxes = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::DontAlign, 3, 3>;

/** The information of a scan by direction, of which none is left out yet. \param information the
 * sum of w h h^T \param noise_information from normalNoiseInformation() \param translations
 * orthogonal axes whose translations are directions of their own, the first ones */
[[nodiscard]] ScanConstraints informationByDirection(
    const Matrix6& information, const Matrix6& noise_information,
    const TranslationAxes& translations = TranslationAxes(3, 0));

/** The planes that say most about a direction. A plane that a voxel at an edge has fitted to points
 * of two walls may stand across a tunnel. It is certain of a position that nothing else confirms,
 * so one or two planes never constrain a direction. Keeps its storage. */
class StrongestPlanes
{
 public:
  /** Makes room for a scan of so many points. */
  void reserve(std::size_t points);
  /** Looks at a scan, which the next calls are about. */
  void look(const MeasuredScan& scan, const std::vector<PlaneMatch>& matches);
  /** The axes along which the scan says nothing but for small planes and for noise. The direction
   * with the least information may be a turn about such a plane, in which it does not show. */
  [[nodiscard]] TranslationAxes unsupportedTranslations(
      const MeasuredScan& scan, const Matrix6& information, const Matrix6& noise_information,
      double min_signal_to_noise);
  /** Takes the few and the many strongest ones from what supports the weak directions. */
  void takeFromSupport(const MeasuredScan& scan, ScanConstraints& constraints);

 private:
  /** Information of each plane along a direction [1/m^2]. \param direction of a step of the scan
   * pose \param most_points planes with more are left out */
  void informationAlong(const MeasuredScan& scan, const Vector6& direction, double most_points);
  /** Sum over the planes that say most, so many of them. */
  [[nodiscard]] double ofStrongest(std::size_t planes);

  PlaneNumbers planes_;
  std::vector<double> of_plane_;                // information by number of the plane, or sorted
  std::vector<std::uint32_t> points_of_plane_;  // likewise
};

/** A direction is unconstrained where its information is not more than \a min_signal_to_noise times
 * that of the noise, or where its supported information is not more than \a supported_part of that;
 * and so are all weaker ones. On open ground three tenths of it are enough where many planes say
 * the same. */
void leaveOutUnconstrained(
    double min_signal_to_noise, ScanConstraints& constraints,
    double supported_part = kSupportedPart);

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
