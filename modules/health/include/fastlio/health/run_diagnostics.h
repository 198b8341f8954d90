// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_diagnostics.h Diagnostics of a run for the user, each reported once. */
#pragma once

#include <fastlio/imu/imu_report.h>
#include <fastlio/imu/noise_measurement.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/interface/scan_result.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** Collects diagnostics: those that others find, and those that show in samples and results. */
class RunDiagnostics
{
 public:
  explicit RunDiagnostics(const OdometryOptions& options)
      : calibration_(options.calibration),
        imu_noise_(options.imu.noise),
        given_time_offset_(options.lidar.time_offset)
  {
  }

  /** Beyond some hundreds, later ones are left out. */
  void report(std::int64_t stamp_ns, std::string text);

  /** Looks at the next inertial sample. */
  void consider(const ImuSample& sample);
  /** The samples so far were in a wrong unit. */
  void forgetScatter();
  /** Looks at the next result. */
  void consider(const ScanResult& result);

  /** In the order of their discovery. */
  [[nodiscard]] const std::vector<Diagnostic>& all() const { return all_; }

 private:
  void considerMounting(const ScanResult& result);
  void considerExtrinsic(const ScanResult& result);
  void considerMotion(const ScanResult& result);
  void considerStep(const ScanResult& result);
  void considerClocks(const ScanResult& result);
  void considerClockDrift(std::int64_t stamp_ns, double time_offset, double std);
  void considerClockStep(const ScanResult& result);

  CalibrationOptions calibration_;
  ImuNoise imu_noise_;
  double given_time_offset_;  // [s]
  /** The offset of the clocks when it had settled. */
  struct SettledOffset
  {
    std::int64_t known_since_ns, stamp_ns;
    double time_offset, std;  // [s]
  };
  std::optional<SettledOffset> settled_offset_;
  SampleScatter scatter_;
  bool scatter_reported_ = false, mounting_reported_ = false, extrinsic_reported_ = false,
       motion_reported_ = false, step_reported_ = false, clocks_reported_ = false,
       drift_reported_ = false;
  std::vector<Diagnostic> all_;
};

}  // namespace fastlio
