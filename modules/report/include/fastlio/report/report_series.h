// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file report_series.h Quantities of a run over time, in bounded memory. */
#pragma once

#include <fastlio/interface/scan_result.h>
#include <fastlio/matching/degeneracy.h>
#include <fastlio/run/bounded_path.h>
#include <fastlio/run/pose_output.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** Quantities drawn over time. Three in a row: x, y, z. */
enum ReportChannel : std::size_t
{
  kHeightChannel,                                     //!< of the body [m]
  kSpeedChannel,                                      //!< of the IMU [m/s]
  kRateChannel,                                       //!< mean from scan to scan [deg/s]
  kGyroBiasChannel,                                   //!< [deg/s]
  kGyroSigmaChannel = kGyroBiasChannel + 3,           //!< its standard deviation
  kAccelBiasChannel = kGyroSigmaChannel + 3,          //!< [m/s^2]
  kAccelSigmaChannel = kAccelBiasChannel + 3,         //!< its standard deviation
  kPositionSigmaChannel = kAccelSigmaChannel + 3,     //!< of the body [m]
  kAttitudeSigmaChannel = kPositionSigmaChannel + 3,  //!< of the body [deg]
  kHealthChannel = kAttitudeSigmaChannel + 3,
  kResidualChannel,       //!< [mm]
  kInnovationChannel,     //!< normalized
  kUnconstrainedChannel,  //!< number of degenerate directions
  kPointsInChannel,
  kPointsDownsampledChannel,
  kPointsEffectiveChannel,
  kMapPointsChannel,
  kStagesChannel,                       //!< milliseconds: propagate, ..., insert, total
  kMemoryChannel = kStagesChannel + 7,  //!< of the process [MB]
  kReportChannels
};

/** Lines are not drawn across a longer time without scans [s]. */
constexpr double kReportGapSeconds = 1.0;

/** Scans that follow each other: the smallest and the largest value of each channel. */
struct ReportBin
{
  double begin_s = 0.0, end_s = 0.0;                 //!< since the first scan's begin
  std::array<float, kReportChannels> low{}, high{};  //!< not a number: no scan has one
  double worst_health = 1.0;
  HealthCause cause = HealthCause::None;  //!< of the scan that fared worst
  std::optional<Vec3> position;           //!< of the body, at the last pose [m]
  /** The weakest degenerate translation of the bin's last scan that has one. */
  std::optional<Vec3> open_axis;
};

/** Collects the results of a run. When there are too many bins, each two become one. */
class ReportSeries
{
 public:
  static constexpr std::size_t kMaxBins = 800;
  static constexpr std::size_t kMaxPath = 8000;  //!< positions

  explicit ReportSeries(Pose T_imu_body) : T_imu_body_(std::move(T_imu_body)) {}

  /** One scan, in time order. */
  void add(const ScanResult& result);

  [[nodiscard]] const std::vector<ReportBin>& bins() const { return bins_; }
  /** Positions of the body: BoundedPath::positions(). */
  [[nodiscard]] std::vector<Vec3> path() const { return path_.positions(); }
  [[nodiscard]] std::vector<Vec3> pathWithin(const std::vector<UntrustedStretch>& stretches) const
  {
    return path_.positionsWithin(stretches);
  }
  [[nodiscard]] std::int64_t beginNs() const { return begin_ns_; }

 private:
  using Values = std::array<float, kReportChannels>;

  [[nodiscard]] Values valuesOf(const ScanResult& result, const PoseEstimate& body);
  ReportBin& openBin(double begin_s);

  Pose T_imu_body_;
  std::vector<ReportBin> bins_;
  std::size_t scans_per_bin_ = 1, scans_in_last_ = 0;
  BoundedPath path_{kMaxPath, kReportGapSeconds};
  std::optional<Mat3> last_attitude_;
  std::int64_t begin_ns_ = 0, last_pose_ns_ = 0;
};

}  // namespace fastlio
