// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/bounded_read.h>
#include <fastlio/files/gzip_file.h>
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/pointmap/map_definition.h>

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <ostream>
#include <stdexcept>

MAP_DEFINITION_REGISTER("fastlio::CVoxelPlanesMap,voxelPlanesMap", fastlio::CVoxelPlanesMap)
IMPLEMENTS_SERIALIZABLE(CVoxelPlanesMap, mrpt::maps::CMetricMap, fastlio)

namespace fastlio
{
namespace
{
using mrpt::config::CConfigFileBase;
using mrpt::serialization::CArchive;

void readFloat(
    const CConfigFileBase& source, const std::string& section, const char* name, float& value)
{
  value = static_cast<float>(source.read_double(section, name, value));
}
}  // namespace

// ---- Archives ----

std::uint8_t CVoxelPlanesMap::serializeGetVersion() const
{
  return 1;
}

void CVoxelPlanesMap::serializeTo(CArchive& out) const
{
  planes_.writeTo(out);
  out << genericMapParams << insertionOptions.radius;
  const auto& l = likelihoodOptions;
  out << l.sigma_dist << l.max_corr_distance << l.decimation;
  out << renderOptions.points << renderOptions.planes << renderOptions.point_size;
}

void CVoxelPlanesMap::serializeFrom(CArchive& in, std::uint8_t version)
{
  if (version > 1) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  planes_.readFrom(in, version >= 1);
  points_.reset();
  in >> genericMapParams >> insertionOptions.radius;
  auto& l = likelihoodOptions;
  in >> l.sigma_dist >> l.max_corr_distance >> l.decimation;
  renderOptions.points = readFlag(in);
  renderOptions.planes = readFlag(in);
  in >> renderOptions.point_size;
}

// ---- Files ----

void CVoxelPlanesMap::saveToFile(const std::string& path) const
{
  // MRPT's gzip file stream does not report a full disk, and its compression in memory goes through
  // a temporary file whose name two programs may share.
  GzipFile file(path);
  mrpt::serialization::archiveFrom(file) << *this;
  file.commit();
}

void CVoxelPlanesMap::loadFromFile(const std::string& path)
{
  mrpt::io::CFileGZInputStream stream;
  if (!stream.open(path))
    throw std::runtime_error("map file '" + path + "' cannot be opened; check its path");
  std::shared_ptr<CVoxelPlanesMap> loaded;
  try
  {
    auto archive = mrpt::serialization::archiveFrom(stream);
    loaded = std::dynamic_pointer_cast<CVoxelPlanesMap>(archive.ReadObject());
  }
  catch (const std::exception& e)
  {
    throw std::runtime_error("map file '" + path + "' is damaged or not of MRPT: " + e.what());
  }
  if (!loaded)
    throw std::runtime_error(
        "map file '" + path + "' holds an object of another class than fastlio::CVoxelPlanesMap");
  *this = *loaded;
}

void CVoxelPlanesMap::saveMetricMapRepresentationToFile(const std::string& prefix) const
{
  // NOLINTNEXTLINE(cppcoreguidelines-slicing): the file holds points only
  if (!mrpt::maps::CSimplePointsMap(points()).saveToPlyFile(prefix + ".ply", true))
    throw std::runtime_error("'" + prefix + ".ply' cannot be written; check the folder");
  saveToFile(prefix + ".metricmap");
}

// ---- Map definition ----

void CVoxelPlanesMap::TCreationOptions::loadFromConfigFile(
    const CConfigFileBase& source, const std::string& section)
{
  planes.voxel_size = source.read_double(section, "voxel_size", planes.voxel_size);
  readFloat(source, section, "point_noise", planes.rules.point_noise);
  readFloat(source, section, "max_thickness", planes.rules.max_thickness);
  readFloat(source, section, "min_incidence", planes.rules.min_incidence);
  readFloat(source, section, "min_points", planes.rules.min_points);
}

void CVoxelPlanesMap::TCreationOptions::dumpToTextStream(std::ostream& out) const
{
  out << "voxel_size    = " << planes.voxel_size << " m\n";
  out << "point_noise   = " << planes.rules.point_noise << " m\n";
  out << "max_thickness = " << planes.rules.max_thickness << " m\n";
  out << "min_incidence = " << planes.rules.min_incidence << "\n";
  out << "min_points    = " << planes.rules.min_points << "\n";
}

void CVoxelPlanesMap::TInsertionOptions::loadFromConfigFile(
    const CConfigFileBase& source, const std::string& section)
{
  radius = source.read_double(section, "radius", radius);
}

void CVoxelPlanesMap::TInsertionOptions::dumpToTextStream(std::ostream& out) const
{
  out << "radius = " << radius << " m\n";
}

void CVoxelPlanesMap::TRenderOptions::loadFromConfigFile(
    const CConfigFileBase& source, const std::string& section)
{
  points = source.read_bool(section, "points", points);
  planes = source.read_bool(section, "planes", planes);
  readFloat(source, section, "point_size", point_size);
}

void CVoxelPlanesMap::TRenderOptions::dumpToTextStream(std::ostream& out) const
{
  out << "points     = " << (points ? "true" : "false") << "\n";
  out << "planes     = " << (planes ? "true" : "false") << "\n";
  out << "point_size = " << point_size << "\n";
}

CVoxelPlanesMap::TMapDefinition::TMapDefinition() = default;

void CVoxelPlanesMap::TMapDefinition::loadFromConfigFile_map_specific(
    const CConfigFileBase& source, const std::string& sectionNamePrefix)
{
  loadSections(*this, source, sectionNamePrefix);
}

void CVoxelPlanesMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const
{
  dumpSections(*this, out);
}

CreatedMap CVoxelPlanesMap::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& def)
{
  const auto& definition = dynamic_cast<const TMapDefinition&>(def);
  return withOptionsOf(definition, std::make_unique<CVoxelPlanesMap>(definition.creationOpts));
}

}  // namespace fastlio
