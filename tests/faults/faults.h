// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file faults.h The catalogue of faults. */
#pragma once

#include "fault_recording.h"

#include <functional>
#include <random>
#include <string>
#include <vector>

namespace fastlio::testing
{
using Random = std::mt19937_64;

using Injection = std::function<void(Observations&, Random&)>;

[[nodiscard]] bool chance(Random& random, double probability);
/** Scans lose all their points. */
[[nodiscard]] Injection emptyScans(double probability);

/** A fault of the observations, of whatever the recorder or the sensors did. */
struct ObservationFault
{
  std::string name;
  Injection inject;
  /** Poses get no worse than this many times those of the clean recording (plus 2 cm); 0: the fault
   * cannot be recovered from, and only has to be survived. */
  double error_factor = 0.0;
  double poses_share = 0.0;  //!< so many of the clean recording's poses are there, at least
  /** A regular expression for the words that name the fault in what the program prints; empty: it
   * is put right without loss, or nothing distinguishes it from measurements. */
  std::string words = {};
};

[[nodiscard]] std::vector<ObservationFault> observationFaults();
/** Those of points, for LiDARs that give points. */
[[nodiscard]] std::vector<ObservationFault> pointFaults();

/** A fault of the file. */
struct FileFault
{
  std::string name;
  std::size_t count = 1;  //!< so many of them, at different places
  std::function<std::string(const RawlogBytes&, std::size_t index, Random&)> damage;
  bool always_seen = true;  //!< false: without a checksum, another number is a number
};

[[nodiscard]] std::vector<FileFault> fileFaults();

}  // namespace fastlio::testing
