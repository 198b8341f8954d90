// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "command_line.h"

#include "../shared/common_options.h"
#include "../shared/parsing.h"
#include "map_outputs.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/run/run_summary.h>

#include <CLI/CLI.hpp>
#include <mrpt/system/os.h>

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
  std::string text = "Files (--export):\n";
  for (const MapFileKind& kind : mapFileKinds())
    text += fileHelpLine(kind.name, kind.file, kind.content, kind.standard);
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
  addJoinOptions(app, arguments.joining);
  addParameterOptions(app, arguments.parameters, "Parameters (YAML)");
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
  app.add_flag(
      "--same-rig", arguments.same_rig,
      "All recordings are of one rig, whose sensors nobody has moved in between; covariances are "
      "smaller");
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
