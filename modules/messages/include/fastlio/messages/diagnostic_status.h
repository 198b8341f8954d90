// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file diagnostic_status.h The content of a diagnostic message. */
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace fastlio
{
/** How something is, for tools that show the diagnostics of a robot. */
struct DiagnosticStatus
{
  enum class Level : std::uint8_t
  {
    Ok,
    Warning,
    Error
  };
  Level level = Level::Ok;
  std::string name, message;
  std::vector<std::pair<std::string, std::string>> values;  //!< names and what they are
};

}  // namespace fastlio
