// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "command_line.h"

#include "../shared/choices.h"
#include "../shared/parsing.h"
#include "mcap_output.h"
#include <fastlio/options/printable.h>
#include <fastlio/rawlog/recording_formats.h>

#include <CLI/CLI.hpp>
#include <mrpt/system/os.h>

#include <filesystem>
#include <map>

namespace fastlio
{
namespace
{
constexpr const char* kDescription =
    "Writes recordings of other makers as an MRPT rawlog. Times of points become seconds after the "
    "stamp of their cloud, by the rules of fastlio-info.";

std::string footer()
{
  std::string text = "Formats, recognised by the content of the input:\n  MRPT rawlog\n";
  for (const RecordingFormat& format : recordingFormats())
    text += std::string("  ") + format.content + "\n";
  return text + R"(
Exit status:
  0  written
  1  wrong usage, or a file that cannot be written
  2  nothing in the input can be used: nothing is written
  3  written, but some of the input could not be read; the messages say what
  130  interrupted; nothing is written)";
}

/** Empty when the name says which format it is. */
std::string outputName(const std::string& path)
{
  const std::filesystem::path name = std::filesystem::path(path).filename();
  const bool compressed = name.extension() == ".gz" || name.extension() == ".zst";
  const std::filesystem::path ending = (compressed ? name.stem() : name).extension();
  if (ending.empty() || ending == ".rawlog" || isMcapName(path)) return "";
  return "the name must end in .rawlog or .mcap, not '" + printable(path) +
         "': these are the formats that fastlio-import writes";
}

void addOutput(CLI::App& app, ImportArguments& arguments)
{
  static const std::map<std::string, RawlogCompression> compressions{
      {"gzip", RawlogCompression::Gzip},
      {"zstd", RawlogCompression::Zstd},
      {"none", RawlogCompression::None}};
  app.add_option(
         "-o,--output", arguments.output.path,
         "Rawlog to write (.rawlog); a name that ends in .mcap: MCAP with messages of ROS 2, for "
         "Foxglove and tools of ROS")
      ->check(outputName)
      ->type_name("FILE");
  auto* run = app.add_option(
                     "--run", arguments.run,
                     "Also write the results of this run into the MCAP: the output folder of "
                     "fastlio-replay, with trajectory, covariance, map and diagnostics")
                  ->type_name("DIR");
  app.add_option(
         "--trajectory", arguments.trajectory,
         "Also write this trajectory only (--output-tum-path of fastlio-replay) into the MCAP")
      ->type_name("FILE")
      ->excludes(run);
  app.add_option(
         "--compression", arguments.output.compression,
         "Of the rawlog: gzip (every MRPT reads it), zstd (MRPT 2.15.7 and newer, and this "
         "project), none [gzip]")
      ->transform(choiceOf(compressions))
      ->type_name("NAME");
  app.add_option(
         "--split-size", arguments.output.split_mib,
         "Begin another file, NAME_001 and so on, after so many MiB before compression")
      ->type_name("MIB")
      ->check(positiveNumber());
  app.add_option(
         "--split-time", arguments.output.split_seconds,
         "Begin another file after so many seconds of the recording")
      ->type_name("S")
      ->check(positiveNumber());
  app.add_flag("--overwrite", arguments.overwrite, "Replace files of the output's name");
}

void addChoice(CLI::App& app, ImportArguments& arguments)
{
  static const std::map<std::string, PointTimeUnit> units{
      {"auto", PointTimeUnit::Auto},
      {"s", PointTimeUnit::Seconds},
      {"ms", PointTimeUnit::Milliseconds},
      {"us", PointTimeUnit::Microseconds},
      {"ns", PointTimeUnit::Nanoseconds}};
  static const std::map<std::string, PointTimeReference> references{
      {"auto", PointTimeReference::Auto},   {"stamp", PointTimeReference::Stamp},
      {"start", PointTimeReference::Start}, {"middle", PointTimeReference::Middle},
      {"end", PointTimeReference::End},     {"absolute", PointTimeReference::Absolute}};
  app.add_option(
         "--lidar-topic", arguments.lidar_topic,
         "Take only LiDARs whose whole topic matches this regular expression")
      ->type_name("REGEX");
  app.add_option(
         "--imu-topic", arguments.imu_topic,
         "Take only IMUs whose whole topic matches this regular expression")
      ->type_name("REGEX");
  app.add_option(
         "--point-time-unit", arguments.point_times.unit,
         "Unit of the times of points: auto, s, ms, us, ns [auto: found from the numbers]")
      ->transform(choiceOf(units))
      ->type_name("NAME");
  app.add_option(
         "--point-time-reference", arguments.point_times.reference,
         "What these times refer to: auto, stamp, start, middle, end, absolute [auto]")
      ->transform(choiceOf(references))
      ->type_name("NAME");
}
}  // namespace

std::variant<ImportArguments, int> parseCommandLine(int argc, const char* const* argv)
{
  CLI::App app(kDescription, "fastlio-import");
  app.footer(footer());
  ImportArguments arguments;
  app.add_option(
         "input", arguments.input_files,
         "Recording, a file or a folder; several are parts of one recording, in this order")
      ->type_name("PATH");
  app.add_flag(
      "--list", arguments.list,
      "Print the topics, what is taken and why, and what the times of points mean; write nothing");
  app.add_flag(
      "--merge", arguments.merge,
      "The inputs were recorded at the same time, by one clock: their observations are put in the "
      "order of their stamps. For a capture of a LiDAR, and an IMU in another file");
  addOutput(app, arguments);
  addChoice(app, arguments);
  app.add_flag("-q,--quiet", arguments.quiet, "Print errors and warnings only");
  addVersion(app, FASTLIO_VERSION, mrpt::system::MRPT_getVersion());
  const auto checks = [&arguments]
  {
    if (arguments.input_files.empty())
      throw CLI::RequiredError("a recording (fastlio-import walk.bag -o walk.rawlog)");
    if (!arguments.list && arguments.output.path.empty())
      throw CLI::RequiredError("--output (or --list)");
    if (!(arguments.trajectory + arguments.run).empty() && !isMcapName(arguments.output.path))
      throw CLI::ValidationError("--run, --trajectory", "go with an --output that ends in .mcap");
    if (isMcapName(arguments.output.path) &&
        (arguments.output.split_mib > 0 || arguments.output.split_seconds > 0))
      throw CLI::ValidationError("--split-size, --split-time", "are for rawlogs, not for MCAP");
  };
  if (const auto end =
          endAfterParsing(app, argc, argv, static_cast<int>(ImportStatus::Usage), checks))
    return *end;
  return arguments;
}

}  // namespace fastlio
