// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_bytes.h"
#include <fastlio/exporters/standard_exporters.h>

namespace fastlio
{
namespace
{
using Header = std::string (*)(const OutputMap& map);

std::string pcdHeader(const OutputMap& map)
{
  const std::string n = std::to_string(map.size());
  const std::string size = map.origin().isZero() ? "4" : "8";  // of a coordinate [bytes]
  return "# .PCD v0.7 - Point Cloud Data file format\n"
         "# map of the LiDAR-inertial odometry, world frame, metres; time in seconds\n"
         "VERSION 0.7\nFIELDS x y z intensity time\nSIZE " +
         size + " " + size + " " + size +
         " 4 8\nTYPE F F F F F\n"
         "COUNT 1 1 1 1 1\nWIDTH " +
         n + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA binary\n";
}

std::string plyHeader(const OutputMap& map)
{
  const std::string type = map.origin().isZero() ? "float" : "double";
  return "ply\nformat binary_little_endian 1.0\n"
         "comment map of the LiDAR-inertial odometry, world frame, metres; time in seconds\n"
         "element vertex " +
         std::to_string(map.size()) + "\nproperty " + type + " x\nproperty " + type +
         " y\nproperty " + type +
         " z\nproperty float intensity\n"
         "property double time\nend_header\n";
}

/** A header, then the points: both formats have the same binary rows. */
class PointFileExporter : public Exporter
{
 public:
  PointFileExporter(const std::string& path, Header header) : file_(path), header_(header) {}

  void onScan(const ScanResult& /*result*/) override {}
  [[nodiscard]] bool needsMap() const override { return true; }

  std::vector<OutputFile> finish(const RunEnd& end) override
  {
    file_.write(header_(end.map));
    writePoints(end.map, file_);
    return {file_.commit()};
  }

 private:
  AtomicFile file_;
  Header header_;
};
}  // namespace

std::unique_ptr<Exporter> makePcdMapExporter(const std::string& path)
{
  return std::make_unique<PointFileExporter>(path, pcdHeader);
}

std::unique_ptr<Exporter> makePlyMapExporter(const std::string& path)
{
  return std::make_unique<PointFileExporter>(path, plyHeader);
}

}  // namespace fastlio
