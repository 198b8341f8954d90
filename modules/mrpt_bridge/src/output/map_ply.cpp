// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mrpt_bridge/output/standard_exporters.h>

#include <cstring>

namespace fastlio
{
namespace
{
constexpr std::size_t kPointsPerWrite = 4096;

/** Appends the four bytes of a float, least significant first on every machine. */
void appendLittleEndian(std::string& bytes, float value)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  for (int shift = 0; shift < 32; shift += 8)
    bytes.push_back(static_cast<char>((bits >> shift) & 0xFFU));
}

std::string header(std::size_t points)
{
  return "ply\nformat binary_little_endian 1.0\n"
         "comment map of the LiDAR-inertial odometry, world frame, metres\n"
         "element vertex " +
         std::to_string(points) +
         "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
}

class PlyMapExporter : public Exporter
{
 public:
  explicit PlyMapExporter(const std::string& path) : file_(path) {}

  void onScan(const ScanResult& /*result*/) override {}

  std::vector<OutputFile> finish(const RunEnd& end) override
  {
    const auto& x = end.map.getPointsBufferRef_x();
    const auto& y = end.map.getPointsBufferRef_y();
    const auto& z = end.map.getPointsBufferRef_z();
    file_.write(header(x.size()));
    std::string bytes;
    for (std::size_t first = 0; first < x.size(); first += kPointsPerWrite)
    {
      bytes.clear();
      for (std::size_t i = first; i < std::min(first + kPointsPerWrite, x.size()); ++i)
        for (const float coordinate : {x[i], y[i], z[i]})
          appendLittleEndian(bytes, coordinate);
      file_.write(bytes);
    }
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
