// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/number_text.h>

namespace fastlio
{
namespace
{
constexpr int kDecimals = 9;

std::string matrixLine(const Pose& pose)
{
  std::string line;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
      line += fixedText(pose.R(row, column), kDecimals) + " ";
    line += fixedText(pose.p[row], kDecimals) + (row < 2 ? " " : "\n");
  }
  return line;
}

class KittiExporter : public Exporter
{
 public:
  KittiExporter(const std::string& path, const OutputFrame& frame)
      : poses_(path), times_(path + "_times"), T_imu_body_(frame.T_imu_body)
  {
  }

  void onScan(const ScanResult& result) override
  {
    if (!hasPose(result.status)) return;
    poses_.write(matrixLine(result.filter.x.pose() * T_imu_body_));
    times_.write(secondsText(result.stamp_ns) + "\n");
  }

  std::vector<OutputFile> finish(const RunEnd& /*end*/) override
  {
    return {poses_.commit(), times_.commit()};
  }

 private:
  AtomicFile poses_, times_;
  Pose T_imu_body_;
};
}  // namespace

std::unique_ptr<Exporter> makeKittiExporter(const std::string& path, const OutputFrame& frame)
{
  return std::make_unique<KittiExporter>(path, frame);
}

}  // namespace fastlio
