// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_bytes.h"
#include <fastlio/exporters/number_text.h>
#include <fastlio/exporters/standard_exporters.h>

namespace fastlio
{
namespace
{
constexpr int kCoordinateDecimals = 4;  // a tenth of a millimetre

void writeTextTile(const OutputPoints& p, AtomicFile& file)
{
  std::string lines;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    for (const float number : {p.x[i], p.y[i], p.z[i]})
      lines += fixedText(static_cast<double>(number), kCoordinateDecimals) + " ";
    lines += roundTripText(static_cast<double>(p.intensity[i])) + " " + secondsText(p.stamp_ns[i]) +
             "\n";
  }
  file.write(lines);
}

class TextMapExporter : public Exporter
{
 public:
  explicit TextMapExporter(const std::string& path) : file_(path) {}

  void onScan(const ScanResult& /*result*/) override {}
  [[nodiscard]] bool needsMap() const override { return true; }

  std::vector<OutputFile> finish(const RunEnd& end) override
  {
    file_.write("# x y z [m, world] intensity time [s]\n");
    end.map.forEachTile([this](const OutputPoints& tile) { writeTextTile(tile, file_); });
    return {file_.commit()};
  }

 private:
  AtomicFile file_;
};
}  // namespace

std::unique_ptr<Exporter> makeTextMapExporter(const std::string& path)
{
  return std::make_unique<TextMapExporter>(path);
}

}  // namespace fastlio
