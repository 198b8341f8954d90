// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/number_text.h>

namespace fastlio
{
namespace
{
class TumExporter : public Exporter
{
 public:
  TumExporter(const std::string& path, const OutputFrame& frame)
      : file_(path), T_imu_body_(frame.T_imu_body)
  {
  }

  void onScan(const ScanResult& result) override
  {
    if (!hasPose(result.status)) return;
    const Pose T_world_body = result.filter.x.pose() * T_imu_body_;
    file_.write(secondsText(result.stamp_ns) + " " + poseColumns(T_world_body, ' ') + "\n");
  }

  std::vector<OutputFile> finish(const RunEnd& /*end*/) override { return {file_.commit()}; }

 private:
  AtomicFile file_;
  Pose T_imu_body_;
};
}  // namespace

std::unique_ptr<Exporter> makeTumExporter(const std::string& path, const OutputFrame& frame)
{
  return std::make_unique<TumExporter>(path, frame);
}

}  // namespace fastlio
