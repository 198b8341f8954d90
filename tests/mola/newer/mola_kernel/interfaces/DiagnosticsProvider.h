// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file DiagnosticsProvider.h What our module uses of an interface of MOLA that the kernel which the
 * test builds does not have yet. For the test only. */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mola
{
enum class DiagnosticLevel : std::uint8_t
{
  OK = 0,
  WARN,
  ERROR,
  STALE
};

struct DiagnosticKeyValue
{
  std::string key, value;
};

struct DiagnosticStatusMsg
{
  DiagnosticLevel level = DiagnosticLevel::OK;
  std::string name, message, hardware_id;
  std::vector<DiagnosticKeyValue> values;
};

class DiagnosticsProvider
{
 public:
  virtual ~DiagnosticsProvider() = default;
  virtual void getDiagnostics(std::vector<DiagnosticStatusMsg>& status) = 0;
};
}  // namespace mola
