// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file measurement.h Times of whole runs of the odometry, scan by scan and stage by stage. */
#pragma once

#include "inputs.h"
#include <fastlio/interface/scan_result.h>

#include <cstdint>
#include <vector>

namespace fastlio::benchmarks
{
/** One scan over all repetitions of a run; every repetition does exactly the same work. */
struct ScanTime
{
  StageTimings least;        //!< of each stage, the least [ms]: what the work takes undisturbed
  std::vector<double> each;  //!< total of each repetition [ms]
  std::size_t effective_points = 0;
};

/** All scans that were tracked, on one number of threads. */
struct RunTimes
{
  int threads = 1;
  std::vector<ScanTime> scans;
  std::uint64_t digest = 0;  //!< of all states and covariances: equal bytes, equal digest
};

/** Runs the inputs \a repeats times with each number of threads, in turns, so that a disturbance of
 * the machine meets all of them alike. */
[[nodiscard]] std::vector<RunTimes> measure(
    const Inputs& inputs, const std::vector<int>& threads, int repeats);

/** Value below which the fraction \a p of them lies, by the nearest rank; 0 for none. */
[[nodiscard]] double percentile(std::vector<double> values, double p);

}  // namespace fastlio::benchmarks
