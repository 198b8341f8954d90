// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/standard_exporters.h>

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
         "stamp_ns,x,y,z,qx,qy,qz,qw" +
         covarianceNames() + "\n";
}

class CovarianceExporter : public Exporter
{
 public:
  CovarianceExporter(const std::string& path, const OutputFrame& frame)
      : file_(path), T_imu_body_(frame.T_imu_body)
  {
    file_.write(covarianceHeader(frame.name));
  }

  void onScan(const ScanResult& result) override
  {
    if (!hasPose(result.status)) return;
    const PoseEstimate estimate = poseEstimateOf(result.filter, T_imu_body_);
    file_.write(
        std::to_string(result.stamp_ns) + "," + poseColumns(estimate.T_world_body, ',') +
        covarianceText(estimate.covariance) + "\n");
  }

  std::vector<OutputFile> finish(const RunEnd& /*end*/) override { return {file_.commit()}; }

 private:
  AtomicFile file_;
  Pose T_imu_body_;
};
}  // namespace

std::unique_ptr<Exporter> makeCovarianceExporter(const std::string& path, const OutputFrame& frame)
{
  return std::make_unique<CovarianceExporter>(path, frame);
}

}  // namespace fastlio
