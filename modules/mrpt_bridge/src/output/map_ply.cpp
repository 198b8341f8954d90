// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_bytes.h"
#include <fastlio/mrpt_bridge/output/standard_exporters.h>

namespace fastlio
{
namespace
{
std::string header(std::size_t points)
{
  return "ply\nformat binary_little_endian 1.0\n"
         "comment map of the LiDAR-inertial odometry, world frame, metres; time in seconds\n"
         "element vertex " +
         std::to_string(points) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity\n"
         "property double time\nend_header\n";
}

class PlyMapExporter : public Exporter
{
 public:
  explicit PlyMapExporter(const std::string& path) : file_(path) {}

  void onScan(const ScanResult& /*result*/) override {}
  [[nodiscard]] bool needsMap() const override { return true; }

  std::vector<OutputFile> finish(const RunEnd& end) override
  {
    file_.write(header(end.map.size()));
    writePoints(end.map, file_);
    return {file_.commit()};
  }

 private:
  AtomicFile file_;
};
}  // namespace

std::unique_ptr<Exporter> makePlyMapExporter(const std::string& path)
{
  return std::make_unique<PlyMapExporter>(path);
}

}  // namespace fastlio
