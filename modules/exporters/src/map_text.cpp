// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_bytes.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/number_text.h>

namespace fastlio
{
namespace
{
constexpr int kCoordinateDecimals = 4;  // a tenth of a millimetre

void writeTextTile(const OutputPoints& p, const Vec3& origin, AtomicFile& file)
{
  std::string lines;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    for (const double number :
         {static_cast<double>(p.x[i]) + origin.x(), static_cast<double>(p.y[i]) + origin.y(),
          static_cast<double>(p.z[i]) + origin.z()})
      lines += fixedText(number, kCoordinateDecimals) + " ";
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
    end.map.forEachTile([&](const OutputPoints& tile)
                        { writeTextTile(tile, end.map.origin(), file_); });
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
