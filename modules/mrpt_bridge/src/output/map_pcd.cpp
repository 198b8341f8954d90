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
  const std::string n = std::to_string(points);
  return "# .PCD v0.7 - Point Cloud Data file format\n"
         "# map of the LiDAR-inertial odometry, world frame, metres; time in seconds\n"
         "VERSION 0.7\nFIELDS x y z intensity time\nSIZE 4 4 4 4 8\nTYPE F F F F F\n"
         "COUNT 1 1 1 1 1\nWIDTH " +
         n + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA binary\n";
}

class PcdMapExporter : public Exporter
{
 public:
  explicit PcdMapExporter(const std::string& path) : file_(path) {}

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

std::unique_ptr<Exporter> makePcdMapExporter(const std::string& path)
{
  return std::make_unique<PcdMapExporter>(path);
}

}  // namespace fastlio
