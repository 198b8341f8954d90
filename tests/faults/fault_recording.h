// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file fault_recording.h A small recording to put faults into, and its bytes. */
#pragma once

#include <fastlio/simulation/simulation.h>

#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <string>
#include <vector>

namespace fastlio::testing
{
using Observations = std::vector<mrpt::obs::CObservation::Ptr>;

/** A simulated recording in memory, in the order of a recorder. */
struct FaultRecording
{
  Observations observations;
  std::string ground_truth;  //!< TUM
  std::string config;        //!< YAML with matching parameters
};

/** An office, some seconds at rest and then some in motion. \param kind of LiDAR: packets or points
 */
[[nodiscard]] FaultRecording makeFaultRecording(LidarKind kind);

/** A copy that shares nothing. */
[[nodiscard]] Observations copyOf(const Observations& observations);

/** An uncompressed rawlog, and where its objects begin. */
struct RawlogBytes
{
  std::string bytes;
  std::vector<std::size_t> begins;
};

[[nodiscard]] RawlogBytes serialized(const Observations& observations);
[[nodiscard]] std::string gzipped(const std::string& bytes);

}  // namespace fastlio::testing
