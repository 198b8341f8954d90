// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_search.h Searches for the pose of a scan in a map where the prediction may be far off.
 */
#pragma once

#include <fastlio/interface/odometry_options.h>
#include <fastlio/localmap/local_map.h>
#include <fastlio/matching/pose_search.h>
#include <fastlio/matching/scan_matcher.h>

#include <optional>
#include <vector>

namespace fastlio
{
/** Inliers of a first match with a given map: half of the scan may be new or have moved. */
inline constexpr double kGivenMapInlierRatio = 0.5;
/** Residuals that are so many times the noise come of a wrong pose. Clocks that are apart and noise
 * that is set too small make a few times the noise: trouble, but a match. */
inline constexpr double kWrongPoseInnovation = 10.0;

/** The best match of a search. */
struct MapSearchResult
{
  MatchResult match;                      //!< the prediction, uncorrected, when the search failed
  bool found = false;                     //!< the scan matches the map well enough
  std::optional<PoseSearchResult> poses;  //!< evidence of a search within the prediction
  bool after_outage = false;  //!< of the LiDAR: the pose is searched, or a new map begun without it
  bool expects_new_view = false;  //!< of OutageSearch
};

/** Most planes that the map has where the points lie do not fit them: it is another place. */
[[nodiscard]] bool isContradicted(
    const MatchResult& match, const DeskewedScan& scan, const LocalMap& map);

/** The residuals and the inlier ratio of a match are those of the right pose, as far as one scan
 * can show. Along a degenerate direction residuals stay large by design: nothing corrects them. */
[[nodiscard]] bool isConvincing(
    const MatchResult& match, const DeskewedScan& scan, const LocalMap& map);

/** Little of the scan is mapped, but all of that fits: a narrow view that turns to what it has not
 * seen yet. This shows the pose only where scans and inertial data agree. Where they do not, the
 * planes that would show it may have left the gate. */
[[nodiscard]] bool fitsAllThatIsMapped(
    const MatchResult& match, const DeskewedScan& scan, const LocalMap& map);

/** As many points match as a searched pose has to show. A match from an uncertain prediction needs
 * that: its gate is narrow, so that whatever matches has small residuals. */
[[nodiscard]] bool matchesAsFound(
    const MatchResult& match, const DeskewedScan& scan, const LocalMap& map);

/** Searches for one scan in one map. */
class MapSearch
{
 public:
  MapSearch(
      const OdometryOptions& options, ScanMatcher& matcher, const DeskewedScan& scan,
      const LocalMap& map)
      : options_(options), matcher_(matcher), scan_(scan), map_(map)
  {
  }

  /** Tries places and headings around the prediction, as far as initialization.pose_*_std reach.
   * Half of the points have to match, and not badly: rooms and streets are alike. */
  [[nodiscard]] MapSearchResult aroundGivenPose(const FilterState& predicted) const;
  /** As aroundPrediction(), from a pose that was carried over a time without inertial data: tries
   * more places, as it is searched once in a while. */
  [[nodiscard]] MapSearchResult aroundCarriedPose(const FilterState& predicted) const;
  /** Tries places and headings within the prediction's uncertainty, and asks for more evidence than
   * an ordinary match needs: inlier ratio, residuals, no rival nearly as good. */
  [[nodiscard]] MapSearchResult aroundPrediction(const FilterState& predicted) const;
  /** Nothing is tried; the prediction stays. */
  [[nodiscard]] MapSearchResult postponed(const FilterState& predicted) const;

 private:
  [[nodiscard]] MapSearchResult around(const FilterState& predicted, bool carried) const;
  [[nodiscard]] MatchResult approach(const FilterState& predicted, const Pose& candidate) const;
  /** The match there. \param ambiguous directions of which another place may be the right one */
  [[nodiscard]] MatchResult at(
      const Pose& found, const FilterState& predicted, const Mat3& ambiguous) const;
  [[nodiscard]] double ratioOf(const UpdateResult& update) const;

  const OdometryOptions& options_;
  ScanMatcher& matcher_;
  const DeskewedScan& scan_;
  const LocalMap& map_;
};

}  // namespace fastlio
