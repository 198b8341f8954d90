// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "point_forest.h"
#include <fastlio/compat/bounded_read.h>
#include <fastlio/pointmap/incremental_points_map.h>
#include <fastlio/pointmap/map_definition.h>

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
  return 1;
}

void CIncrementalPointsMap::serializeTo(CArchive& out) const
{
  out << min_spacing_ << static_cast<std::uint32_t>(size());
  writeColumn(out, m_x);
  writeColumn(out, m_y);
  writeColumn(out, m_z);
  out << genericMapParams;
  writeOptions(out, insertionOptions, likelihoodOptions);
  renderOptions.writeToStream(out);
}

void CIncrementalPointsMap::serializeFrom(CArchive& in, std::uint8_t version)
{
  if (version > 1) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  if (version == 0) (void)in.ReadAs<double>();  // edge of the cells of an index that is gone
  const auto min_spacing = in.ReadAs<double>();
  const auto count = in.ReadAs<std::uint32_t>();
  auto x = readColumn<Column>(in, count, kName);
  auto y = readColumn<Column>(in, count, kName);
  auto z = readColumn<Column>(in, count, kName);
  *this = CIncrementalPointsMap(min_spacing);
  m_x.swap(x);
  m_y.swap(y);
  m_z.swap(z);
  rebuildIndex();
  in >> genericMapParams;
  readOptions(in, insertionOptions, likelihoodOptions);
  renderOptions.readFromStream(in);
}

// ---- Map definition ----

void CIncrementalPointsMap::TCreationOptions::loadFromConfigFile(
    const mrpt::config::CConfigFileBase& source, const std::string& section)
{
  min_spacing = source.read_double(section, "min_spacing", min_spacing);
}

void CIncrementalPointsMap::TCreationOptions::dumpToTextStream(std::ostream& out) const
{
  out << "min_spacing = " << min_spacing << " m\n";
}

CIncrementalPointsMap::TMapDefinition::TMapDefinition() = default;

void CIncrementalPointsMap::TMapDefinition::loadFromConfigFile_map_specific(
    const mrpt::config::CConfigFileBase& source, const std::string& sectionNamePrefix)
{
  loadSections(*this, source, sectionNamePrefix);
}

void CIncrementalPointsMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const
{
  dumpSections(*this, out);
}

CreatedMap CIncrementalPointsMap::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& def)
{
  const auto& definition = dynamic_cast<const TMapDefinition&>(def);
  return withOptionsOf(
      definition, std::make_unique<CIncrementalPointsMap>(definition.creationOpts.min_spacing));
}

}  // namespace fastlio
