// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_definition.h Common parts of the definitions of both map classes. */
#pragma once

#include <fastlio/compat/mrpt_compat.h>

#include <mrpt/config/CConfigFileBase.h>

#include <memory>
#include <ostream>
#include <string>

namespace fastlio
{
template <typename Definition>
void loadSections(
    Definition& definition, const mrpt::config::CConfigFileBase& source, const std::string& prefix)
{
  definition.creationOpts.loadFromConfigFile(source, prefix + "_creationOpts");
  definition.insertionOpts.loadFromConfigFile(source, prefix + "_insertOpts");
  definition.likelihoodOpts.loadFromConfigFile(source, prefix + "_likelihoodOpts");
  definition.renderOpts.loadFromConfigFile(source, prefix + "_renderOpts");
}

template <typename Definition>
void dumpSections(const Definition& definition, std::ostream& out)
{
  definition.creationOpts.dumpToTextStream(out);
  definition.insertionOpts.dumpToTextStream(out);
  definition.likelihoodOpts.dumpToTextStream(out);
  definition.renderOpts.dumpToTextStream(out);
}

template <typename Definition, typename Map>
[[nodiscard]] CreatedMap withOptionsOf(const Definition& definition, std::unique_ptr<Map> map)
{
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
