// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file MapServer.h As DiagnosticsProvider.h beside it. */
#pragma once

#include <string>

namespace mola
{
class MapServer
{
 public:
  struct ReturnStatus
  {
    bool success = false;
    std::string error_message;
  };
  virtual ReturnStatus map_load(const std::string& path) = 0;
  virtual ReturnStatus map_save(const std::string& path) = 0;
};
}  // namespace mola
