// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "command_line.h"

#include "../shared/parsing.h"
#include <fastlio/run/run_summary.h>

#include <CLI/CLI.hpp>
#include <mrpt/system/os.h>

#include <algorithm>

namespace fastlio
{
namespace
{
constexpr const char* kDescription =
    "Makes a consistent map: runs the odometry, finds the places that were passed more than once,\n"
    "closes these loops, and puts every scan where it belongs. Several recordings of one place\n"
    "become one map.";

constexpr const char* kExits =
    "Exit status:\n"
    "    0  ok\n"
    "    1  wrong command line or configuration, or outputs that would destroy something;\n"
    "       nothing was run\n"
    "    2  input unreadable or without usable LiDAR and IMU; nothing was computed\n"
    "    3  input truncated or corrupt; results of what could be read are written\n"
    "    4  the odometry diverged: results are written; or it never initialised: there are none\n"
    "    5  an output file could not be written; the others are complete. Or submaps on the disk\n"
    "       were lost: closures are missing\n"
    "    6  degraded: stretches of a run cannot be trusted; results are written\n"
    "  130  interrupted; nothing was written\n\n"
    "Example:\n"
    "  fastlio-map walk.rawlog -o map\n"
    "  fastlio-map monday.rawlog tuesday.rawlog -o both --export ply,las,report,summary";

std::string fileHelp()
{
  constexpr std::size_t kNameWidth = 12, kFileWidth = 21;
  const auto padded = [](const std::string& text, std::size_t width)
  { return text + std::string(width - std::min(width, text.size()), ' '); };
  std::string text = "Files (--export):\n";
  for (const MapFileKind& kind : mapFileKinds())
    text += "  " + padded(kind.name, kNameWidth) + padded(kind.file, kFileWidth) + kind.content +
            (kind.standard ? "" : " *") + "\n";
  return text +
         "\nThose with * are written when they are named. With several runs, the files of each one "
         "have\n"
         "its name: trajectory.NAME.tum.\n\n";
}

std::vector<std::string> kindNames()
{
  std::vector<std::string> names;
  for (const MapFileKind& kind : mapFileKinds())
    names.emplace_back(kind.name);
  return names;
}

void addOptions(CLI::App& app, MapArguments& arguments)
{
  app.add_option(
         "runs,--input-rawlog", arguments.runs,
         "Recordings, or folders that fastlio-replay has written (their recording and parameters); "
         "of several, all show the same place")
      ->type_name("RUN");
  auto* join = app.add_flag(
      "--join", arguments.join, "The recordings are parts of one, in this order: a single run");
  app.add_flag(
         "--no-join", arguments.no_join,
         "Each recording is a run of its own, also one that continues another")
      ->excludes(join);
  app.add_option("-c,--config", arguments.config_file, "Parameters (YAML)")->type_name("FILE.yaml");
  app.add_option("--set", arguments.settings, "Set a parameter over the file; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option(
         "-o,--output-dir", arguments.output_directory,
         "Folder for all files; default: a new one, named after the first run")
      ->type_name("DIR");
  app.add_flag(
      "--overwrite", arguments.overwrite,
      "Replace files in --output-dir also where no earlier run of fastlio-map has written them");
  app.add_option("--export", arguments.exporters, "Files to write, by the names listed below")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(kindNames()))
      ->type_name("NAME,...");
  app.add_option("--frame", arguments.frame, "Body whose pose is written: vehicle or imu")
      ->check(CLI::IsMember({"vehicle", "imu"}))
      ->capture_default_str();
  app.add_flag(
      "--remove-moving", arguments.remove_moving,
      "Leave moving objects out of the map: what is where rays of other scans pass; takes another "
      "pass through the recordings");
  app.add_flag_callback(
      "--no-gnss", [&arguments] { arguments.use_gnss = false; },
      "Leave positions of GNSS in the recordings out of the map");
  app.add_flag_callback(
      "--no-wheels", [&arguments] { arguments.use_wheels = false; },
      "Leave wheel odometry in the recordings out of the map");
  app.add_option(
         "--crs", arguments.crs,
         "Reference system of map.las, for example EPSG:25832; default: the UTM zone of the place")
      ->type_name("CODE");
  app.add_option(
         "--control-points", arguments.control_points,
         "Places that are known in the map and on the earth (CSV, see docs/georeferencing.md); "
         "they "
         "go before GNSS")
      ->type_name("FILE.csv");
  app.add_option("--threads", arguments.threads, "Threads; 0: as many as there are cores")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  app.add_flag("-q,--quiet", arguments.quiet, "Print nothing but errors");
  addVersion(app, MRPT_FASTLIO_VERSION, mrpt::system::MRPT_getVersion());
}
}  // namespace

const std::vector<MapFileKind>& mapFileKinds()
{
  static const std::vector<MapFileKind> kinds = {
      {"trajectory", "trajectory.tum", "corrected pose at each scan's end (TUM)", true},
      {"states", "states.csv", "the whole state and its standard deviations", true},
      {"covariance", "covariance.csv", "corrected pose and its 6x6 covariance", true},
      {"ply", "map.ply", "map: points with intensity and time (PLY)", true},
      {"pcd", "map.pcd", "the same as PCD", false},
      {"text", "map.txt", "the same as text", false},
      {"las", "map.las", "the same as LAS 1.4, in projected coordinates where the place is known",
       false},
      {"metricmap", "map.metricmap", "map for MRPT programs", false},
      {"planes", "map.planes", "map of planes, for fastlio-replay --map-in", true},
      {"simplemap", "keyframes.simplemap", "keyframes with their raw scans, of one run", false},
      {"graph", "poses.graph", "pose graph with the closures, for MRPT", true},
      {"g2o", "poses.g2o", "the same for g2o", true},
      {"report", "report.html", "page that shows what was closed, and what was not", true},
      {"summary", "summary.json", "submaps, closures with their evidence, files", true},
  };
  return kinds;
}

std::variant<MapArguments, int> parseCommandLine(int argc, const char* const* argv)
{
  CLI::App app(kDescription, "fastlio-map");
  app.footer(fileHelp() + kExits);
  MapArguments arguments;
  addOptions(app, arguments);
  const auto checks = [&arguments]
  {
    if (arguments.runs.empty()) throw CLI::RequiredError("a recording (fastlio-map walk.rawlog)");
  };
  if (const auto end =
          endAfterParsing(app, argc, argv, static_cast<int>(ExitStatus::Usage), checks))
    return *end;
  return arguments;
}

}  // namespace fastlio
