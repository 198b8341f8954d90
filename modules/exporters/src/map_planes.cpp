// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_file_exporter.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/files/gzip_file.h>
#include <fastlio/map/mrpt_voxel_planes_map.h>

#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

namespace fastlio
{
namespace
{
void writePlanes(const RunEnd& end, GzipFile& file)
{
  const auto* planes = dynamic_cast<const VoxelPlaneMap*>(end.surfaces);
  if (planes == nullptr)
    throw std::runtime_error(
        "map.planes was not written: scans were not matched with a map of planes (map.type); use "
        "map.ply");
  mrpt::serialization::archiveFrom(file) << CVoxelPlanesMap(*planes);
}
}  // namespace

std::unique_ptr<Exporter> makePlanesExporter(const std::string& path)
{
  return archiveAtEnd(path, false, writePlanes);
}

}  // namespace fastlio
