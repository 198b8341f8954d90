// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_outputs.h The files of a map. */
#pragma once

#include "command_line.h"
#include <fastlio/exporters/exporter.h>
#include <fastlio/map/voxel_plane_map.h>
#include <fastlio/mapping/georeference.h>
#include <fastlio/mapping/map_builder.h>
#include <fastlio/mapping/moving_objects.h>
#include <fastlio/run/output_map.h>
#include <fastlio/run/pose_output.h>
#include <fastlio/run/run_folder.h>
#include <fastlio/submaps/submap_store.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** A file that fastlio-map can write. */
struct MapFileKind
{
  const char* name;     //!< for --export
  const char* file;     //!< of several sessions, each one's has its name: "trajectory.walk.tum"
  const char* content;  //!< for people
  bool standard;
  enum class Of
  {
    Session,  //!< there is one for each
    Map,      //!< of the points of the map
    Result    //!< of the poses, or of everything
  } of;
  /** Nothing: no exporter writes it. */
  std::unique_ptr<Exporter> (*make)(const std::string& path) = nullptr;
};

/** All of them. */
[[nodiscard]] const std::vector<MapFileKind>& mapFileKinds();

/** Which files a command line asks for. */
class MapFiles
{
 public:
  MapFiles(const MapArguments& arguments, const std::vector<std::string>& sessions);

  [[nodiscard]] bool wants(const std::string& kind) const;
  [[nodiscard]] bool wantsMap() const;
  [[nodiscard]] const std::vector<MapFileKind>& wanted() const { return kinds_; }
  /** Path of a file of the whole map, or of a session. */
  [[nodiscard]] std::string path(const std::string& kind, std::size_t session = 0) const;
  /** Names of all files, without the folder. */
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  [[nodiscard]] std::string nameOf(const MapFileKind& kind, std::size_t session) const;

  std::string directory_;
  std::vector<std::string> sessions_;
  std::vector<MapFileKind> kinds_;
};

/** Whether a run of the program, of whatever sessions, writes a file of this name. */
[[nodiscard]] bool isMapFileName(const std::string& name);

/** How many planes of submaps stay in memory, and where the others go. */
[[nodiscard]] SubmapStoreOptions submapStoreOptions(
    const MapArguments& arguments, const Config& config);

/** The second pass: corrected scans into files. */
class MapOutputs
{
 public:
  /** Opens the files. \exception std::runtime_error one cannot be opened */
  MapOutputs(
      const MapArguments& arguments, const MapFiles& files, const std::vector<Session>& sessions);

  /** Puts the scans of one session in their places. \param moving what is left out of the map;
   * null: nothing \return false: interrupted */
  bool add(
      const Session& session, std::size_t number, const MappingResult& result,
      MovingObjects* moving, const PassHooks& hooks);

  /** Completes the map, and writes the graph. */
  void finish(
      const MappingResult& result, const OutputFrame& frame,
      const std::optional<Georeference>& place);

  [[nodiscard]] const std::vector<OutputFile>& files() const { return written_; }
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }
  [[nodiscard]] const OutputMap& map() const { return map_; }
  /** Why some points of the map are missing; empty: none are. */
  [[nodiscard]] const std::string& mapProblem() const { return map_problem_; }

 private:
  void take(const PlacedScan& scan);
  void collect(RunSummary summary);

  const MapFiles& plan_;
  std::string frame_;
  OutputMap map_;
  std::unique_ptr<VoxelPlaneMap> planes_;
  std::vector<ExporterSet> of_sessions_;  //!< get their names when all scans are in their places
  ExporterSet of_map_;
  std::vector<OutputFile> written_;
  std::vector<std::string> problems_;
  std::string map_problem_;
};

}  // namespace fastlio
