// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_file_tools.h Files of maps for tests: written by exporters, archived, as text; and what their
 * reader says. */
#pragma once

#include "failure_message.h"
#include "output_test_support.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/savedmaps/saved_map_file.h>

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <fstream>
#include <string>

namespace fastlio
{
inline void write(Exporter& exporter)
{
  const RunSummary summary;
  const auto map = testing::smallMap();
  (void)exporter.finish({summary, *map});
}

/** Empty when the map is read. */
inline std::string messageOf(const std::string& path)
{
  return testing::failureOf<std::runtime_error>([&] { (void)loadSavedMap(path); });
}

inline void archive(const mrpt::serialization::CSerializable& object, const std::string& path)
{
  mrpt::io::CFileGZOutputStream stream(path);
  mrpt::serialization::archiveFrom(stream) << object;
}

inline void text(const std::string& path, const std::string& content)
{
  std::ofstream(path, std::ios::binary) << content;
}

}  // namespace fastlio
