// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_class_tools.h Maps as MRPT handles them: into archives and out of them, and from map
 * definitions. */
#pragma once

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <string>
#include <vector>

namespace fastlio::testing
{
/** Bytes of an archive that holds the map. It begins with a flag, the class's name, its version. */
inline std::vector<std::uint8_t> archived(const mrpt::serialization::CSerializable& map)
{
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << map;
  const auto* bytes = static_cast<const std::uint8_t*>(stream.getRawBufferData());
  return {bytes, bytes + stream.getTotalBytesCount()};
}

inline void load(const std::vector<std::uint8_t>& content, mrpt::serialization::CSerializable& map)
{
  mrpt::io::CMemoryStream stream(content.data(), content.size());
  mrpt::serialization::archiveFrom(stream) >> map;
}

/** A value in a section of a map definition. */
struct DefinitionEntry
{
  std::string section, key;
  double value = 0.0;
};

/** The map that a definition of one map, called \a name, makes. */
template <typename Map>
typename Map::Ptr mapFromDefinition(
    const std::string& name, const std::vector<DefinitionEntry>& entries)
{
  mrpt::config::CConfigFileMemory config;
  config.write("Maps", name + "_count", 1);
  for (const DefinitionEntry& e : entries)
    config.write("Maps_" + name + "_00_" + e.section, e.key, e.value);
  mrpt::maps::TSetOfMetricMapInitializers definitions;
  definitions.loadFromConfigFile(config, "Maps");
  mrpt::maps::CMultiMetricMap maps;
  maps.setListOfMaps(definitions);
  return maps.mapByClass<Map>();
}

}  // namespace fastlio::testing
