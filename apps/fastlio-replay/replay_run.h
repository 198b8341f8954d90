// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file replay_run.h One recording through the odometry into files. */
#pragma once

#include "progress_meter.h"
#include "run_setup.h"
#include <fastlio/exporters/exporter.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/rawlog/decode_ahead_source.h>

#include <mrpt/system/COutputLogger.h>

#include <optional>
#include <string>

namespace fastlio
{
/** Reads, estimates and writes; whatever happens on the way, what was computed gets written. */
class ReplayRun
{
 public:
  /** Makes the output places and opens the files.
   * \exception std::invalid_argument a parameter is out of range
   * \exception std::runtime_error an output file cannot be opened, or another run writes there */
  ReplayRun(RunSetup setup, mrpt::system::COutputLogger& logger);

  /** To the end of the input, of the scans asked for, or until interrupted(). Call once. */
  [[nodiscard]] RunSummary execute();

 private:
  void consume(DecodeAheadSource& source);
  /** False when no further input is wanted. */
  bool feed(DecodedInput input);
  bool feedScan(LidarScan scan);
  void checkEnd();
  void drain();
  void take(const ScanResult& result);
  void extendOutputMap();
  void reportChange(const ScanResult& result);
  void reportRemarks();
  void reportExporters();
  [[nodiscard]] RunSummary summarize(const DecodeAheadSource& source) const;

  RunSetup setup_;
  mrpt::system::COutputLogger& logger_;
  OutputPlaces places_;  //!< outlives what writes there
  Odometry odometry_;
  ExporterSet exporters_;
  OutputMap output_map_;
  ProgressMeter progress_;
  RunStatistics statistics_;
  double input_share_ = 0.0;  //!< of the input's bytes that have been read
  std::size_t scans_seen_ = 0;
  std::optional<ScanStatus> last_status_;
  std::size_t exporter_problems_told_ = 0;
  std::size_t diagnostics_reported_ = 0;
  std::optional<Diagnostic> end_diagnostic_;  //!< the recording goes on after the trajectory
  std::string failure_;                       //!< an exception that ended the loop
};

}  // namespace fastlio
