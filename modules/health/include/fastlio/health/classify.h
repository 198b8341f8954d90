// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file classify.h Is a scan's pose to be believed, and if not, why? Status, message and health of
 * every scan are written here and nowhere else. */
#pragma once

#include <fastlio/imu/noise_inflation.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/interface/scan_result.h>
#include <fastlio/lidar/queued_scan.h>
#include <fastlio/matching/match_evidence.h>
#include <fastlio/matching/pose_search.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** Corrections of the prediction over what noise, calibration, vibration and jitter of stamps
 * explain. Healthy sensors, real and simulated, stay below 9, but for a narrow view of an
 * office: 16. */
inline constexpr double kMaxMotionInnovation = 12.0;
/** Largest error of the mounting that scans and inertial data may show [rad]: a degree, or three
 * times what is known of the mounting. */
[[nodiscard]] double maxMountingError(const CalibrationOptions& options);
/** Of the gyro's scale: 2 % (datasheets of common sensors say 0.5 to 1 %), or three times what is
 * known of it. */
[[nodiscard]] double maxGyroScaleError(const CalibrationOptions& options);
/** How far the ranges may be off the changes of velocity that the accelerometer sees, as a part. */
[[nodiscard]] double maxRangeScaleError(const CalibrationOptions& options);

/** The filter's treatment of a scan, as far as the status depends on it. */
struct ScanOutcome
{
  /** Where the filter was with this scan. */
  enum class Place
  {
    InMap,            //!< it tracks
    OutsideGivenMap,  //!< the pose in a given map has not been found yet
    Reinitialised     //!< until this scan, the map has not been found since the re-initialisation
  };
  Place place = Place::InMap;
  bool map_was_empty = false;
  bool begins_map = false;                 //!< it was, and the scan has points enough for one
  bool updated = false;                    //!< the scan corrected the prediction
  bool prediction_finite = true;           //!< else the inertial data overflowed it
  std::size_t points = 0;                  //!< surface points that could have matched
  double imu_gap_s = 0.0;                  //!< longest one since the scan before
  double unaided_s = 0.0;                  //!< since a scan last corrected the state convincingly
  std::optional<PoseSearchResult> search;  //!< within the prediction, if it was needed
  bool after_outage = false;               //!< of the LiDAR, which the inertial data bridge
  double position_std = 0.0;               //!< of the filter, along the worst axis [m]
};

/** The status alone. */
[[nodiscard]] ScanStatus statusOf(const ScanOutcome& outcome, const OdometryOptions& options);

/** Quantities that the health of a scan depends on besides the scan itself. */
struct HealthContext
{
  std::int64_t since_ns = 0;    //!< end of the scan before
  double inflated_ratio = 0.0;  //!< of the time since then, in intervals of noise inflation
  bool map_is_sparse = false;   //!< few points match it yet
  /** What the standard deviation of the position has grown by since scans constrained every
   * direction for a second, squares subtracted [m]. */
  double lost_std = 0.0;
  double max_mounting_error = maxMountingError({});  //!< [rad]
  double max_gyro_scale_error = maxGyroScaleError({});
  double max_range_scale_error = maxRangeScaleError({});
};

/** Health of a scan: the smallest of its measures, each 1/2 at its limit. */
[[nodiscard]] ScanHealth healthOf(const ScanResult& result, const HealthContext& context);

/** How much of the position was lost along directions that scans left open, one after the other or
 * every now and then. What the filter itself is uncertain about does not show it: a scan that sees
 * the map of the last seconds again makes the filter certain of it, but the map has drifted. */
class LostPosition
{
 public:
  /** \param constrained the scan left no direction open \param std of the position along its
   * worst axis [m] \return HealthContext::lost_std */
  double add(std::int64_t stamp_ns, bool constrained, double std);

 private:
  std::int64_t open_ns_ = 0;  // the last scan that left a direction open
  double known_std_ = 0.0;    // when all had been constrained for a while
};

/** Classifies scan after scan. */
class ScanClassifier
{
 public:
  explicit ScanClassifier(const OdometryOptions& options) : options_(options) {}

  /** Writes status, message and health of a scan whose other fields are complete.
   * \param inflations about the inertial data since the scan before, at least */
  void classify(
      const ScanOutcome& outcome, const std::vector<NoiseInflation>& inflations,
      ScanResult& result);

 private:
  const OdometryOptions options_;
  std::int64_t previous_ns_ = 0;
  LostPosition lost_;
  int scans_until_dense_ = 0;  // of a map that does not match much yet
};

/** The result of a scan that is given up without being processed. \param started the odometry has
 * had a pose before */
[[nodiscard]] ScanResult classifyUnprocessed(
    const QueuedScan& queued, const std::string& why, bool started);

}  // namespace fastlio
