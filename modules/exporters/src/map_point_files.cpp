// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_file_exporter.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/math/little_endian.h>
#include <fastlio/math/time.h>

#include <algorithm>

namespace fastlio
{
namespace
{
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

constexpr std::size_t kPointsPerWrite = 4096;

/** In double precision where the map has an origin: those are coordinates of the earth. */
void appendPosition(std::string& bytes, const OutputPoints& p, std::size_t i, const Vec3& origin)
{
  if (origin.isZero())
    for (const float number : {p.x[i], p.y[i], p.z[i]})
      appendLittle(bytes, number);
  else
    for (const double number :
         {static_cast<double>(p.x[i]) + origin.x(), static_cast<double>(p.y[i]) + origin.y(),
          static_cast<double>(p.z[i]) + origin.z()})
      appendLittle(bytes, number);
}

void writeTile(const OutputPoints& p, const Vec3& origin, AtomicFile& file)
{
  std::string bytes;
  for (std::size_t first = 0; first < p.size(); first += kPointsPerWrite)
  {
    bytes.clear();
    for (std::size_t i = first; i < std::min(first + kPointsPerWrite, p.size()); ++i)
    {
      appendPosition(bytes, p, i, origin);
      appendLittle(bytes, p.intensity[i]);
      appendLittle(bytes, toSeconds(p.stamp_ns[i]));
    }
    file.write(bytes);
  }
}

/** A header, then the points: both formats have the same binary rows of x, y, z, intensity as float
 * (see appendPosition()) and time as double, little-endian. */
std::unique_ptr<Exporter> pointFile(
    const std::string& path, std::string (*header)(const OutputMap& map))
{
  return mapFile(
      path,
      [header](const OutputMap& map, AtomicFile& file)
      {
        file.write(header(map));
        map.forEachTile([&](const OutputPoints& tile) { writeTile(tile, map.origin(), file); });
      });
}
}  // namespace

std::unique_ptr<Exporter> makePcdMapExporter(const std::string& path)
{
  return pointFile(path, pcdHeader);
}

std::unique_ptr<Exporter> makePlyMapExporter(const std::string& path)
{
  return pointFile(path, plyHeader);
}

}  // namespace fastlio
