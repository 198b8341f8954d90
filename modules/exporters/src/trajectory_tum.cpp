// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_file_exporter.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/number_text.h>

namespace fastlio
{
std::unique_ptr<Exporter> makeTumExporter(const std::string& path, const OutputFrame& frame)
{
  return rowPerScan(
      path, "",
      [T_imu_body = frame.T_imu_body](const ScanResult& result) -> std::string
      {
        if (!hasPose(result.status)) return {};
        const Pose T_world_body = result.filter.x.pose() * T_imu_body;
        return secondsText(result.stamp_ns) + " " + poseColumns(T_world_body, ' ') + "\n";
      });
}

}  // namespace fastlio
