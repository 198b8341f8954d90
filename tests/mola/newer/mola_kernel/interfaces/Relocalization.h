// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file Relocalization.h As DiagnosticsProvider.h beside it. */
#pragma once

#include <mrpt/poses/CPose3DPDFGaussian.h>

namespace mola
{
class Relocalization
{
 public:
  virtual ~Relocalization() = default;
  virtual void relocalize_near_pose_pdf(const mrpt::poses::CPose3DPDFGaussian& pose) = 0;
  virtual void relocalize_from_gnss() = 0;
};
}  // namespace mola
