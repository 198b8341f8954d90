// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_file_exporter.h"
#include <fastlio/evaluation/trajectory_io.h>
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/split_text.h>

namespace fastlio
{
namespace
{
std::string covarianceHeader(const std::string& frame)
{
  return "# Pose of the " + frame +
         " frame in the world at each scan's end and its covariance.\n"
         "# Order (rx,ry,rz,px,py,pz): attitude error in the " +
         frame +
         " frame [rad] (R_true = R Exp(error)),\n"
         "# position error in the world frame [m]; upper triangle, row by row.\n"
         "stamp_ns,x,y,z,qx,qy,qz,qw," +
         joined(covarianceColumns(), ",") + "\n";
}
}  // namespace

std::unique_ptr<Exporter> makeCovarianceExporter(const std::string& path, const OutputFrame& frame)
{
  return rowPerScan(
      path, covarianceHeader(frame.name),
      [T_imu_body = frame.T_imu_body](const ScanResult& result) -> std::string
      {
        if (!hasPose(result.status)) return {};
        const PoseEstimate estimate = poseEstimateOf(result.filter, T_imu_body);
        return std::to_string(result.stamp_ns) + "," + poseColumns(estimate.T_world_body, ',') +
               covarianceText(estimate.covariance) + "\n";
      });
}

}  // namespace fastlio
