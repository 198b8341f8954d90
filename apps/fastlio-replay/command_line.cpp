// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "command_line.h"

#include "../shared/choices.h"
#include "../shared/common_options.h"
#include "../shared/parsing.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/options/nearest_name.h>
#include <fastlio/options/printable.h>
#include <fastlio/run/run_summary.h>

#include <CLI/CLI.hpp>
#include <mrpt/system/os.h>

#include <map>
#include <sstream>
#include <string_view>

namespace fastlio
{
namespace
{
constexpr const char* kDescription =
    "LiDAR-inertial odometry (FAST-LIO) on recordings of a 3D LiDAR and an IMU: rawlogs of MRPT,\n"
    "bags of ROS, MCAP, captures of a network, folders. Writes the trajectory, states with\n"
    "covariances, the map, a report, timings and a summary.";

constexpr const char* kFooter =
    "Exit status:\n"
    "    0  ok\n"
    "    1  wrong command line or configuration, or outputs that would destroy something;\n"
    "       nothing was run\n"
    "    2  input unreadable or without usable LiDAR and IMU; nothing was computed\n"
    "    3  input truncated or corrupt; results of what could be read are written\n"
    "    4  the odometry diverged or never initialised; results are written\n"
    "    5  an output file could not be written; the others are complete\n"
    "    6  degraded: stretches of the run cannot be trusted (untrusted.csv says which);\n"
    "       results are written\n"
    "  130  interrupted (Ctrl-C, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ); results up to there are\n"
    "       written\n"
    "When several apply, the order is 130, 5, 3, 4, 6.\n\n"
    "Example:\n"
    "  fastlio-replay walk.rawlog\n"
    "  fastlio-replay walk.rawlog -c params/velodyne_vlp16.yaml --set map.voxel_size=0.3 -o out";

const std::map<std::string, mrpt::system::VerbosityLevel>& verbosityNames()
{
  using namespace mrpt::system;
  static const std::map<std::string, VerbosityLevel> names = {
      {"ERROR", LVL_ERROR}, {"WARN", LVL_WARN}, {"INFO", LVL_INFO}, {"DEBUG", LVL_DEBUG}};
  return names;
}

void addInputOptions(
    CLI::App& app, ReplayArguments& arguments, std::vector<std::string>& positional)
{
  addParameterOptions(
      app, arguments.parameters, "Parameters (YAML); the rest has the defaults of the sensor");
  app.add_option(
         "recordings", positional,
         "Recordings: rawlogs, bags, MCAP, captures, folders (docs/import.md); of several, each "
         "gets a run of its own, but those that follow each other in time are one recording")
      ->type_name("RECORDING");
  addJoinOptions(app, arguments.joining);
  app.add_option(
         "--input-rawlog,--input-rosbag2", arguments.input_files,
         "A recording, too, of any format; repeated: the parts of a split one, in order")
      ->allow_extra_args(false)
      ->type_name("FILE");
  app.add_option(
         "--lidar-sensor-label", arguments.lidar_sensor_label,
         "LiDAR to use: regular expression for the whole sensor label; default: found "
         "automatically")
      ->type_name("REGEX");
  app.add_option("--imu-sensor-label", arguments.imu_sensor_label, "IMU to use, likewise")
      ->type_name("REGEX");
  app.add_option(
         "--skip-first-n", arguments.skip_first_n,
         "Leave out everything before the LiDAR scan with this number (from 0)")
      ->check(wholeNumber())
      ->type_name("N");
  app.add_option(
         "--only-first-n", arguments.only_first_n,
         "Stop after this many LiDAR scans (after the skipped ones); 0: all")
      ->check(wholeNumber())
      ->type_name("N");
}

void addOutputOptions(CLI::App& app, ReplayArguments& arguments)
{
  app.add_option(
         "-o,--output-dir", arguments.output_directory,
         "Folder for all output files (see docs/outputs.md); created when absent; default: a new "
         "one, named after the recording, and 'latest' is a link to it")
      ->type_name("DIR");
  app.add_option(
         "--output-tum-path", arguments.output_tum_path,
         "Write the trajectory (TUM format) to this file; without --output-dir nothing else")
      ->type_name("FILE");
  app.add_option(
         "--reference", arguments.reference,
         "Compare with this trajectory in report.html; default: NAME.gt.tum beside NAME.rawlog")
      ->type_name("FILE.tum");
  app.add_flag(
      "--overwrite", arguments.overwrite,
      "Replace files in --output-dir also where no earlier run of fastlio-replay has written them");
  app.add_option(
         "--export", arguments.exporters,
         "Files to write into --output-dir, by the names listed below; default: those without *")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME,...");
  app.add_flag(
      "--imu-rate", arguments.imu_rate,
      "Also write imu_rate.csv: the state at each inertial sample (sets output.imu_rate)");
  app.add_option("--frame", arguments.frame, "Body whose pose is written: vehicle or imu")
      ->check(CLI::IsMember({"vehicle", "imu"}))
      ->capture_default_str();
}

/** \exception CLI::ValidationError they are not six */
std::vector<double> sixNumbersOf(const std::string& text)
{
  std::vector<double> numbers;
  std::istringstream parts(text);
  bool all_read = true;
  for (std::string part; std::getline(parts, part, ',');)
  {
    const auto number = parsed<double>(part);
    all_read = all_read && number.has_value();
    numbers.push_back(number.value_or(0.0));
  }
  if (numbers.size() == 6 && all_read) return numbers;
  throw CLI::ValidationError(
      "--initial-pose", "must be six numbers X,Y,Z,YAW,PITCH,ROLL [m, deg] between commas, not '" +
                            printable(text) + "'");
}

void addMapOptions(CLI::App& app, ReplayArguments& arguments)
{
  auto* map = app.add_option(
                     "--map-in", arguments.map_in,
                     "Start in this map of an earlier run: PLY, PCD, or an archive of MRPT")
                  ->type_name("FILE");
  app.add_option_function<std::string>(
         "--initial-pose",
         [&arguments](const std::string& text) { arguments.initial_pose = sixNumbersOf(text); },
         "About where the body (--frame) is in that map: x,y,z,yaw,pitch,roll [m, deg]; default: "
         "the map's origin")
      ->needs(map)
      ->type_name("X,Y,Z,YAW,PITCH,ROLL");
  app.add_flag(
         "--no-map-update", arguments.no_map_update,
         "Only localise: the map stays as it is (sets map.update: false)")
      ->needs(map);
}

void addRunOptions(CLI::App& app, ReplayArguments& arguments)
{
  app.add_flag(
      "--calibrate", arguments.calibrate,
      "First calibrate the rig with the recording, as fastlio-calibrate does; used where it is "
      "better on data that it was not fitted to");
  app.add_option(
         "--dump-config", arguments.dump_config,
         "Print all parameters in effect as YAML, each with where it comes from, and run nothing; "
         "main: those that most users need")
      ->expected(0, 1)
      ->default_str("all")
      ->check(CLI::IsMember({"all", "main"}))
      ->type_name("[main]");
  app.add_option(
         "--threads", arguments.threads,
         "Threads of computation; 0: all cores; default: as configured. Results do not depend on "
         "it")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  app.add_option("-v,--verbosity", arguments.verbosity, "ERROR, WARN, INFO (default) or DEBUG")
      ->transform(choiceOf(verbosityNames()))
      ->type_name("LEVEL");
  app.add_flag("-q,--quiet", arguments.quiet, "Print nothing but errors");
  addVersion(app, FASTLIO_VERSION, mrpt::system::MRPT_getVersion());
}

void requireOutput(const ReplayArguments& arguments)
{
  if (!arguments.dump_config.empty()) return;
  if (arguments.input_files.empty())
    throw CLI::RequiredError("a recording (fastlio-replay walk.rawlog)");
  if (arguments.batch && !arguments.output_tum_path.empty())
    throw CLI::ValidationError(
        "--output-tum-path", "has one file for several recordings; use --output-dir or --join");
  if (!arguments.output_directory.empty() || arguments.output_tum_path.empty()) return;
  if (arguments.imu_rate)
    throw CLI::RequiredError("--output-dir, where --imu-rate writes imu_rate.csv,");
  if (!arguments.reference.empty())
    throw CLI::RequiredError("--output-dir, where report.html compares with the --reference,");
  if (!arguments.exporters.empty())
    throw CLI::RequiredError("--output-dir, where --export writes,");
}

/** Positional recordings are of their own (or joined later, by their stamps), those of
 * --input-rawlog parts of one. */
void joinInputs(ReplayArguments& arguments, const std::vector<std::string>& positional)
{
  arguments.batch = arguments.joining != Joining::Always && positional.size() > 1;
  if (!positional.empty() && !arguments.input_files.empty())
    throw CLI::ValidationError(
        "--input-rawlog", "is given beside other recordings; give all of them in one way");
  if (!positional.empty()) arguments.input_files = positional;
}
}  // namespace

std::variant<ReplayArguments, int> parseCommandLine(int argc, const char* const* argv)
{
  CLI::App app(kDescription, "fastlio-replay");
  app.footer("Files (--export):\n" + exporterHelp() + "\n" + kFooter);
  ReplayArguments arguments;
  std::vector<std::string> positional;
  addInputOptions(app, arguments, positional);
  addOutputOptions(app, arguments);
  addMapOptions(app, arguments);
  addRunOptions(app, arguments);
  const auto checks = [&]
  {
    joinInputs(arguments, positional);
    if (arguments.quiet) arguments.verbosity = mrpt::system::LVL_ERROR;
    requireOutput(arguments);
  };
  if (const auto end =
          endAfterParsing(app, argc, argv, static_cast<int>(ExitStatus::Usage), checks))
    return *end;
  return arguments;
}

}  // namespace fastlio
