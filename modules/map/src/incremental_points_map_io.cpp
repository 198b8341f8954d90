// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_index.h"
#include <fastlio/compat/bounded_read.h>
#include <fastlio/map/incremental_points_map.h>

#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/serialization/CArchive.h>

#include <ostream>
#include <stdexcept>
#include <string>

MAP_DEFINITION_REGISTER(
    "fastlio::CIncrementalPointsMap,incrementalPointsMap", fastlio::CIncrementalPointsMap)
IMPLEMENTS_SERIALIZABLE(CIncrementalPointsMap, CSimplePointsMap, fastlio)

namespace fastlio
{
namespace
{
using mrpt::maps::CPointsMap;
using mrpt::serialization::CArchive;
using Column = mrpt::aligned_std_vector<float>;

constexpr const char* kName = "CIncrementalPointsMap";

void writeColumn(CArchive& out, const Column& column)
{
  if (!column.empty()) out.WriteBufferFixEndianness(column.data(), column.size());
}

// The options are written field by field: the layout of MRPT's own writer changed in 2.15.3, and
// older versions cannot read the newer one.
void writeOptions(
    CArchive& out, const CPointsMap::TInsertionOptions& i, const CPointsMap::TLikelihoodOptions& l)
{
  out << i.minDistBetweenLaserPoints << i.addToExistingPointsMap << i.also_interpolate
      << i.fuseWithExisting << i.isPlanarMap << i.horizontalTolerance
      << i.maxDistForInterpolatePoints << i.insertInvalidPoints;
  out << l.sigma_dist << l.max_corr_distance << l.decimation;
}

void readOptions(CArchive& in, CPointsMap::TInsertionOptions& i, CPointsMap::TLikelihoodOptions& l)
{
  in >> i.minDistBetweenLaserPoints;
  i.addToExistingPointsMap = readFlag(in);
  i.also_interpolate = readFlag(in);
  i.fuseWithExisting = readFlag(in);
  i.isPlanarMap = readFlag(in);
  in >> i.horizontalTolerance >> i.maxDistForInterpolatePoints;
  i.insertInvalidPoints = readFlag(in);
  in >> l.sigma_dist >> l.max_corr_distance >> l.decimation;
}
}  // namespace

// ---- Archives ----

std::uint8_t CIncrementalPointsMap::serializeGetVersion() const
{
  return 0;
}

void CIncrementalPointsMap::serializeTo(CArchive& out) const
{
  out << creation_options_.cell_size << creation_options_.min_spacing;
  out << static_cast<std::uint32_t>(size());
  writeColumn(out, m_x);
  writeColumn(out, m_y);
  writeColumn(out, m_z);
  out << genericMapParams;
  writeOptions(out, insertionOptions, likelihoodOptions);
  renderOptions.writeToStream(out);
}

void CIncrementalPointsMap::serializeFrom(CArchive& in, std::uint8_t version)
{
  if (version != 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  TCreationOptions options;
  std::uint32_t count = 0;
  in >> options.cell_size >> options.min_spacing >> count;
  auto x = readColumn<Column>(in, count, kName);
  auto y = readColumn<Column>(in, count, kName);
  auto z = readColumn<Column>(in, count, kName);
  setCreationOptions(options);
  m_x.swap(x);
  m_y.swap(y);
  m_z.swap(z);
  totals_ = {};
  mark_as_modified();
  in >> genericMapParams;
  readOptions(in, insertionOptions, likelihoodOptions);
  renderOptions.readFromStream(in);
}

// ---- Map definition ----

void CIncrementalPointsMap::TCreationOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& source, const std::string& section)
{
  cell_size = source.read_double(section, "cell_size", cell_size);
  min_spacing = source.read_double(section, "min_spacing", min_spacing);
}

void CIncrementalPointsMap::TCreationOptions::dumpToTextStream(std::ostream& out) const
{
  out << "cell_size   = " << cell_size << " m\n";
  out << "min_spacing = " << min_spacing << " m\n";
}

CIncrementalPointsMap::TMapDefinition::TMapDefinition() = default;

void CIncrementalPointsMap::TMapDefinition::loadFromConfigFile_map_specific(
    const mrpt::config::CConfigFileBase& source, const std::string& sectionNamePrefix)
{
  creationOpts.loadFromConfigFile(source, sectionNamePrefix + "_creationOpts");
  insertionOpts.loadFromConfigFile(source, sectionNamePrefix + "_insertOpts");
  likelihoodOpts.loadFromConfigFile(source, sectionNamePrefix + "_likelihoodOpts");
  renderOpts.loadFromConfigFile(source, sectionNamePrefix + "_renderOpts");
}

void CIncrementalPointsMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const
{
  creationOpts.dumpToTextStream(out);
  insertionOpts.dumpToTextStream(out);
  likelihoodOpts.dumpToTextStream(out);
  renderOpts.dumpToTextStream(out);
}

CreatedMap CIncrementalPointsMap::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& def)
{
  const auto& definition = dynamic_cast<const TMapDefinition&>(def);
  auto map = std::make_unique<CIncrementalPointsMap>(definition.creationOpts);
  map->insertionOptions = definition.insertionOpts;
  map->likelihoodOptions = definition.likelihoodOpts;
  map->renderOptions = definition.renderOpts;
#if FASTLIO_MRPT_HAS_NN_INTERFACE
  return CreatedMap(std::move(map));
#else
  return map.release();
#endif
}

}  // namespace fastlio
