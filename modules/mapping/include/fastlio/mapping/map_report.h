// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file map_report.h A built map for people (a page) and for programs (JSON). */
#pragma once

#include <fastlio/files/atomic_file.h>
#include <fastlio/loops/wall_thickness.h>
#include <fastlio/mapping/georeference.h>
#include <fastlio/mapping/map_builder.h>
#include <fastlio/mapping/moving_objects.h>
#include <fastlio/run/run_summary.h>

#include <optional>
#include <string>
#include <vector>

namespace fastlio
{
/** Where the odometry has a submap, in the world of the map. The odometry of a session has a world
 * of its own; the session takes its place in the map from SessionAnchor. */
[[nodiscard]] Pose odometryPose(const MappingResult& result, std::size_t submap);

/** How far a submap moved from there [m]. */
[[nodiscard]] Vec3 correctionOf(const MappingResult& result, std::size_t submap);

/** How well two passes over the same surfaces agree: the median distance across planes of the one
 * submap from those of the other. */
struct ClosureAgreement
{
  std::size_t closure = 0;  //!< index among MappingResult::closures
  /** With the poses of the odometry [m]; sessions have none in common. */
  std::optional<double> before;
  double after = 0.0;  //!< with the corrected ones [m]
};

/** Of the accepted closures. */
[[nodiscard]] std::vector<ClosureAgreement> agreements(const MappingResult& result);

/** The median of ClosureAgreement::after [m]. */
[[nodiscard]] double medianAfter(const std::vector<ClosureAgreement>& all);

/** The content of a report about a map. */
struct MapAccount
{
  std::string version;
  std::vector<std::string> inputs;
  std::string configuration;
  const BuiltMap& map;
  std::optional<Georeference> place;
  std::vector<ClosureAgreement> agreements;
  std::optional<WallThickness> walls;    //!< where walls were seen twice
  std::size_t points = 0;                //!< of the map
  std::optional<RemovedPoints> removed;  //!< where moving objects were to be removed
  std::vector<std::string> notes;        //!< for people
  std::vector<OutputFile> outputs;       //!< files that are complete
  std::vector<std::string> output_problems;
  double wall_seconds = 0.0;
  ExitStatus status = ExitStatus::Ok;
  const OutputMap* points_map = nullptr;  //!< for the page; null: without its points
  std::string points_problem;             //!< why some of its points are missing
};

/** One sentence: what came out. */
[[nodiscard]] std::string mapSentence(const MapAccount& account);

/** One short sentence: whether loops were closed, and how well the map agrees with itself. */
[[nodiscard]] std::string mapHeadline(const MapAccount& account);

/** `summary.json`. */
[[nodiscard]] std::string mapSummaryJson(const MapAccount& account);

/** `report.html`: the map, the path before and after, closures and why others were rejected, walls
 * that were seen twice. Opens without a network. */
[[nodiscard]] std::string mapReportHtml(const MapAccount& account);

}  // namespace fastlio
