// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_statistics.h Statistics of a run, accumulated scan by scan. */
#pragma once

#include <fastlio/filter/update.h>
#include <fastlio/interface/scan_result.h>
#include <fastlio/run/run_health.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** Number of values of ScanStatus. */
constexpr std::size_t kScanStatusCount = 5;

/** toString() with underscores, for keys and columns: "prediction_only". */
[[nodiscard]] std::string machineName(ScanStatus status);

/** A scan that was not tracked as it should be. */
struct Trouble
{
  std::size_t scan_index = 0;  //!< counted from 0 over the scans that were processed
  std::int64_t stamp_ns = 0;
  ScanStatus status = ScanStatus::Initializing;
  std::string message;
};

/** Milliseconds of computation per scan, over the scans from the start on. */
struct ScanTimeSummary
{
  double mean = 0, median = 0, p99 = 0;
  double max = 0;  //!< over all scans: the search for a start may take longest
};

/** Milliseconds of each scan. */
class ScanTimes
{
 public:
  /** \param started from the start on */
  void add(double ms, bool started);
  [[nodiscard]] ScanTimeSummary summary() const;
  [[nodiscard]] double total() const { return total_; }

 private:
  std::vector<float> started_;  //!< 35 MB for a day and a night at 100 Hz
  double longest_ = 0.0, total_ = 0.0;
};

/** Sums of the per-scan point counts. */
struct PointTotals
{
  std::size_t in = 0, invalid = 0, near = 0, far = 0, own_body = 0, downsampled = 0, effective = 0;
};

/** Scans that did not constrain all directions of motion. */
struct DegenerateDirections
{
  std::size_t scans = 0;
  std::int64_t first_ns = 0, last_ns = 0;  //!< stamps of the first and the last of them
  MotionDirection weakest;                 //!< of the scan that constrained it least
  double signal_to_noise = 0.0;            //!< its information over that of noise in the normals
};

/** Digest of the ScanResults of a run. */
class RunStatistics
{
 public:
  void add(const ScanResult& result);
  /** RunHealth::addLostEnd() */
  void addLostEnd(std::int64_t until_ns, std::size_t scans, const std::string& reason)
  {
    health_.addLostEnd(until_ns, scans, reason);
  }

  [[nodiscard]] std::size_t scans() const { return scans_; }
  [[nodiscard]] std::size_t count(ScanStatus status) const;
  /** Scans that the intervals between those processed leave room for. */
  [[nodiscard]] std::size_t missingScans() const;
  /** Scans whose pose is in the trajectory. */
  [[nodiscard]] std::size_t poses() const;
  /** Length of the IMU's path through the poses at the scans' ends [m]. */
  [[nodiscard]] double pathLength() const { return path_length_; }
  /** From the first processed scan's first point to the last one's end [s]. */
  [[nodiscard]] double duration() const;
  [[nodiscard]] std::int64_t beginNs() const { return begin_ns_; }
  [[nodiscard]] std::int64_t endNs() const { return end_ns_; }
  [[nodiscard]] const PointTotals& points() const { return points_; }
  [[nodiscard]] ScanTimeSummary scanTimes() const { return times_.summary(); }
  /** Sum of the computation of all scans [s]. */
  [[nodiscard]] double computeSeconds() const { return times_.total() * 1e-3; }
  /** The first scan that was predicted only or diverged; without any pose, why there is none. */
  [[nodiscard]] std::optional<Trouble> firstTrouble() const;
  /** The first kMaxTroubles scans that were predicted only or diverged. */
  [[nodiscard]] const std::vector<Trouble>& troubles() const { return troubles_; }

  [[nodiscard]] const RunHealth& health() const { return health_; }
  /** Where scans left directions of motion open. */
  [[nodiscard]] const DegenerateDirections& degenerateDirections() const { return open_; }
  /** The last pose's state and covariance: what has become of the calibration. */
  [[nodiscard]] const std::optional<FilterState>& lastState() const { return last_state_; }
  /** Standard deviation of the last position along its most uncertain axis [m]. */
  [[nodiscard]] double endPositionStd() const;
  /** How wrong the calibration in use seemed at the last pose. */
  [[nodiscard]] const CalibrationCheck& calibration() const { return calibration_; }

  static constexpr std::size_t kMaxTroubles = 20;

 private:
  void addPose(const ScanResult& result);
  void addDegenerateDirections(const ScanResult& result);

  std::size_t scans_ = 0;
  std::array<std::size_t, kScanStatusCount> counts_{};
  std::int64_t begin_ns_ = 0, end_ns_ = 0;
  std::optional<Vec3> last_position_;
  std::optional<FilterState> last_state_;
  CalibrationCheck calibration_;
  DegenerateDirections open_;
  RunHealth health_;
  double path_length_ = 0;
  ScanTimes times_;
  std::vector<float> intervals_s_;  //!< between the ends of scans
  PointTotals points_;
  std::vector<Trouble> troubles_;
  std::optional<Trouble> not_initialized_;
};

/** Number of scans, of each status that occurs, and of missing ones: "299: 1 first scan, 298
 * tracking". */
[[nodiscard]] std::string scanCountsText(const RunStatistics& statistics);

/** How well the end of the path is known, by the covariance relative to the start: "0.012 m, 0.05
 * deg (1 sigma)"; empty without a pose. */
[[nodiscard]] std::string endUncertaintyText(const RunStatistics& statistics);

/** "1.20 ms median, 3.40 ms p99, 5.60 ms max". */
[[nodiscard]] std::string scanTimesText(const ScanTimeSummary& times);

/** "rotation about [1.00 0.00 0.00]", or "translation along [...]". */
[[nodiscard]] std::string directionText(const MotionDirection& direction);

}  // namespace fastlio
