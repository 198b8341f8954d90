// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_file_exporter.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/files/gzip_file.h>

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/serialization/CArchive.h>

#include <limits>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr unsigned char kLengthBits = 0x7F;

/** The bytes of a map without points in an archive, around its number of points. */
struct EmptyMap
{
  std::string before;  //!< class and version
  std::string after;   //!< options
};

/** A class that every MRPT program knows, whatever the run's own map class. */
EmptyMap serializedEmptyMap()
{
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << mrpt::maps::CSimplePointsMap();
  const auto* first = static_cast<const char*>(stream.getRawBufferData());
  const std::string bytes(first, first + stream.getTotalBytesCount());
  const std::size_t name_length = static_cast<unsigned char>(bytes.at(0)) & kLengthBits;
  const std::size_t header = 1 + name_length + 1;  // length, name, version
  return {bytes.substr(0, header), bytes.substr(header + sizeof(std::uint32_t))};
}

/** As CSimplePointsMap serialises itself, without ever having all points in memory: their number,
 * then all x, all y, all z. */
void writeMetricMap(const RunEnd& end, GzipFile& file)
{
  if (end.map.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::runtime_error("map.metricmap cannot hold more than 2^32 points; use map.ply");
  const EmptyMap empty = serializedEmptyMap();
  file.write(empty.before);
  auto archive = mrpt::serialization::archiveFrom(file);
  archive << static_cast<std::uint32_t>(end.map.size());
  for (const auto column : {&OutputPoints::x, &OutputPoints::y, &OutputPoints::z})
    end.map.forEachTile(
        [&](const OutputPoints& tile)
        {
          const std::vector<float>& values = tile.*column;
          archive.WriteBufferFixEndianness(values.data(), values.size());
        });
  file.write(empty.after);
}
}  // namespace

std::unique_ptr<Exporter> makeMetricMapExporter(const std::string& path)
{
  return archiveAtEnd(path, true, writeMetricMap);
}

}  // namespace fastlio
