// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "pcd_file.h"
#include <fastlio/compat/register_classes.h>
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/rawlog/saved_map_file.h>

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/opengl/PLY_import_export.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace fastlio
{
namespace
{
[[noreturn]] void failMap(const std::string& path, const std::string& why)
{
  throw std::runtime_error("map '" + path + "' " + why);
}

std::string beginningOf(const std::string& path)
{
  constexpr std::size_t kEnough = 256;
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    failMap(path, "cannot be read; check the path given to --map-in and the permissions");
  std::string bytes(kEnough, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

bool isPcd(const std::string& beginning)
{
  return beginning.rfind("# .PCD", 0) == 0 || beginning.rfind("VERSION", 0) == 0;
}

WorldPoints pointsOf(const mrpt::maps::CPointsMap& map)
{
  WorldPoints points;
  points.x.assign(map.getPointsBufferRef_x().begin(), map.getPointsBufferRef_x().end());
  points.y.assign(map.getPointsBufferRef_y().begin(), map.getPointsBufferRef_y().end());
  points.z.assign(map.getPointsBufferRef_z().begin(), map.getPointsBufferRef_z().end());
  return points;
}

WorldPoints readPly(const std::string& path)
{
  mrpt::maps::CSimplePointsMap map;
  if (!map.loadFromPlyFile(path)) failMap(path, "is a PLY file that cannot be read");
  return pointsOf(map);
}

SavedMap fromMetricMap(const mrpt::maps::CMetricMap::Ptr& map)
{
  SavedMap saved;
  if (const auto planes = std::dynamic_pointer_cast<CVoxelPlanesMap>(map))
  {
    if (!planes->isEmpty()) saved.planes = {planes, &planes->planes()};
    saved.points = pointsOf(planes->points());
  }
  else if (const auto several = std::dynamic_pointer_cast<mrpt::maps::CMultiMetricMap>(map))
  {
    for (const auto& one : several->maps)
      if (saved.empty()) saved = fromMetricMap(mrpt::maps::CMetricMap::Ptr(one));
  }
  else if (const auto points = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(map))
    saved.points = pointsOf(*points);
  return saved;
}

SavedMap fromArchive(const std::string& path)
{
  registerBridgeClasses();
  mrpt::serialization::CSerializable::Ptr object;
  try
  {
    mrpt::io::CFileGZInputStream stream(path);
    auto archive = mrpt::serialization::archiveFrom(stream);
    object = archive.ReadObject();
  }
  catch (const std::exception& e)
  {
    failMap(path, std::string("is neither PLY nor PCD nor an archive of MRPT: ") + e.what());
  }
  const auto map = std::dynamic_pointer_cast<mrpt::maps::CMetricMap>(object);
  if (!map)
    failMap(
        path, std::string("holds a ") +
                  (object ? object->GetRuntimeClass()->className : "nothing") + ", not a map");
  return fromMetricMap(map);
}
}  // namespace

SavedMap loadSavedMap(const std::string& path)
{
  const std::string beginning = beginningOf(path);
  SavedMap saved;
  if (beginning.rfind("ply", 0) == 0)
    saved.points = readPly(path);
  else if (isPcd(beginning))
    saved.points = readPcd(path);
  else
    saved = fromArchive(path);
  if (saved.empty()) failMap(path, "has no points");
  return saved;
}

}  // namespace fastlio
