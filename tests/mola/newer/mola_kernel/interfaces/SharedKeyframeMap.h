// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file SharedKeyframeMap.h As DiagnosticsProvider.h beside it. */
#pragma once

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include <cstdint>
#include <optional>
#include <string>

namespace mola
{
class SharedKeyframeMap
{
 public:
  using KeyFrameID = std::uint64_t;
  struct KeyframeInsertRequest
  {
    mrpt::Clock::time_point timestamp;
    std::string source_frame_id;
    mrpt::poses::CPose3DPDFGaussian pose_in_source;
    mrpt::obs::CSensoryFrame observations;
    double quality = 1.0;
  };
  virtual ~SharedKeyframeMap() = default;
  virtual std::optional<KeyFrameID> requestInsertKeyframe(const KeyframeInsertRequest& request) = 0;
};
}  // namespace mola
