// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mrpt_bridge/output/number_text.h>
#include <fastlio/mrpt_bridge/output/standard_exporters.h>

#include <array>

namespace fastlio
{
namespace
{
constexpr std::array<const char*, 6> kAxes = {"rx", "ry", "rz", "px", "py", "pz"};

std::string header(const std::string& frame)
{
  std::string text = "# Pose of the " + frame +
                     " frame in the world at each scan's end and its covariance.\n"
                     "# Order (rx,ry,rz,px,py,pz): attitude error in the " +
                     frame +
                     " frame [rad] (R_true = R Exp(error)),\n"
                     "# position error in the world frame [m]; upper triangle, row by row.\n"
                     "stamp_ns,x,y,z,qx,qy,qz,qw";
  for (std::size_t row = 0; row < 6; ++row)
    for (std::size_t col = row; col < 6; ++col)
      text += std::string(",c_") + kAxes[row] + "_" + kAxes[col];
  return text + "\n";
}

class CovarianceExporter : public Exporter
{
 public:
  CovarianceExporter(const std::string& path, const OutputFrame& frame)
      : file_(path), T_imu_body_(frame.T_imu_body)
  {
    file_.write(header(frame.name));
  }

  void onScan(const ScanResult& result) override
  {
    if (!hasPose(result.status)) return;
    const PoseEstimate estimate = poseEstimateOf(result.filter, T_imu_body_);
    std::string row = std::to_string(result.stamp_ns) + "," + poseText(estimate.T_world_body, ',');
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j)
        row += "," + roundTripText(estimate.covariance(i, j));
    file_.write(row + "\n");
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
