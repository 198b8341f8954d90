// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file health_json.h How a run fared, for summary.json (internal). */
#pragma once

#include <fastlio/exporters/run_health.h>
#include <fastlio/imu/imu_report.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace fastlio
{
[[nodiscard]] nlohmann::ordered_json healthJson(const RunHealth& health);
[[nodiscard]] nlohmann::ordered_json imuJson(const ImuReport& imu);
[[nodiscard]] nlohmann::ordered_json diagnosticsJson(const std::vector<Diagnostic>& diagnostics);

}  // namespace fastlio
