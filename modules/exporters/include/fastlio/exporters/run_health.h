// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_health.h When and why a run was in trouble for the first time. */
#pragma once

#include <fastlio/odometry/scan_result.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

namespace fastlio
{
/** A scan is in trouble below this health value. */
constexpr double kTroubledHealth = 0.5;

/** Digest of the scans' health, from the first pose on. */
class RunHealth
{
 public:
  /** A scan in trouble. */
  struct Trouble
  {
    std::size_t scan = 0;       //!< counted from 0 over the scans that were processed
    std::int64_t stamp_ns = 0;  //!< the scan's end
    double second = 0.0;        //!< since the first scan's begin [s]
    ScanHealth health;
  };

  void add(const ScanResult& result);

  /** Scans since the first pose. */
  [[nodiscard]] std::size_t scans() const { return scans_; }
  [[nodiscard]] std::size_t troubled() const { return troubled_; }
  [[nodiscard]] double mean() const;
  [[nodiscard]] double worst() const { return worst_; }
  [[nodiscard]] const std::optional<Trouble>& firstTrouble() const { return first_; }
  /** How many scans in trouble had each cause. */
  [[nodiscard]] const std::map<HealthCause, std::size_t>& causes() const { return causes_; }

 private:
  std::size_t seen_ = 0, scans_ = 0, troubled_ = 0;
  std::int64_t begin_ns_ = 0;
  double sum_ = 0.0, worst_ = 1.0;
  std::optional<Trouble> first_;
  std::map<HealthCause, std::size_t> causes_;
};

}  // namespace fastlio
