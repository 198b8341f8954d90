// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file consistency_case.h Runs whose covariance is compared with the truth. */
#pragma once

#include "simulated_run.h"
#include <fastlio/math/time.h>

#include <ostream>

namespace fastlio::testing
{
struct ConsistencyCase
{
  const char* name;
  const char* scenario;
  LidarKind lidar;
  // Where beams are sparse, the planes that they draw are not those of the world.
  int stride;
};

/** The name of a test in lists. */
inline std::ostream& operator<<(std::ostream& out, const ConsistencyCase& c)
{
  return out << c.name;
}

/** The last estimate up to an instant [s after the start]. */
inline const JudgedScan& estimateAt(const SimulatedRun& run, std::int64_t start_ns, double instant)
{
  const auto limit = start_ns + toNanoseconds(instant);
  const JudgedScan* last = &run.scans.front();
  for (const JudgedScan& scan : run.scans)
    if (scan.result.stamp_ns <= limit) last = &scan;
  return *last;
}

}  // namespace fastlio::testing
