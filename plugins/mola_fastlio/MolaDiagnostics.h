// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file MolaDiagnostics.h The health of the odometry for MOLA's diagnostics, where MOLA has them.
 */
#pragma once

#include <fastlio/interface/scan_result.h>

#include <mutex>
#include <optional>

#if __has_include(<mola_kernel/interfaces/DiagnosticsProvider.h>)
#define FASTLIO_MOLA_HAS_DIAGNOSTICS 1
#include <mola_kernel/interfaces/DiagnosticsProvider.h>
#include <vector>
#else
#define FASTLIO_MOLA_HAS_DIAGNOSTICS 0
#endif

namespace fastlio
{
/** MOLA asks about once a second, from a thread of its own. */
class MolaDiagnostics
#if FASTLIO_MOLA_HAS_DIAGNOSTICS
    : public mola::DiagnosticsProvider
#endif
{
 public:
  /** Of every scan, also those without a pose. */
  void note(const ScanResult& result)
  {
    const std::lock_guard lock(mutex_);
    latest_ = Scan{result.status, result.health, result.statistics};
  }

#if FASTLIO_MOLA_HAS_DIAGNOSTICS
  /** One status: level 1 (WARN) where a measure of the health exceeds its limit, 2 (ERROR) where
   * the pose is not to be trusted, 3 (STALE) before the first scan. */
  void getDiagnostics(std::vector<mola::DiagnosticStatusMsg>& status) override;
#endif

 private:
  struct Scan
  {
    ScanStatus status;
    ScanHealth health;
    ScanStatistics statistics;
  };

  std::mutex mutex_;
  std::optional<Scan> latest_;
};

}  // namespace fastlio
