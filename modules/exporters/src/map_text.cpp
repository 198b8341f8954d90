// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_file_exporter.h"
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
}  // namespace

std::unique_ptr<Exporter> makeTextMapExporter(const std::string& path)
{
  return mapFile(
      path,
      [](const OutputMap& map, AtomicFile& file)
      {
        file.write("# x y z [m, world] intensity time [s]\n");
        map.forEachTile([&](const OutputPoints& tile) { writeTextTile(tile, map.origin(), file); });
      });
}

}  // namespace fastlio
