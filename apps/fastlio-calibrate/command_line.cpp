// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "command_line.h"

#include "../shared/common_options.h"
#include "../shared/parsing.h"

#include <CLI/CLI.hpp>
#include <mrpt/system/os.h>

namespace fastlio
{
namespace
{
constexpr const char* kDescription =
    "Finds how the sensors of a rig sit and measure, from its recordings: pose of the LiDAR in the "
    "IMU frame, time offset, scales and axes of gyro and accelerometer, offsets of the LiDAR's "
    "beams. Each value comes with its standard deviation, and with the motion that would improve "
    "it. A trial on data that the values were not fitted to says whether to use them.";
constexpr const char* kFooter = R"(Exit status:
  0  the calibration is written
  1  wrong usage or configuration
  2  a recording cannot be used: the message says why
  5  the calibration could not be written
  6  it is written, but on data that it was not fitted to it is not better

Example:
  fastlio-calibrate walk_1.rawlog walk_2.rawlog -o rig.yaml
  fastlio-replay -c rig.yaml --input-rawlog walk_3.rawlog --output-dir out)";
}  // namespace

std::variant<CalibrateArguments, int> parseCommandLine(int argc, const char* const* argv)
{
  CLI::App app(kDescription, "fastlio-calibrate");
  app.footer(kFooter);
  CalibrateArguments arguments;
  app.add_option("input,--input-rawlog", arguments.recordings, "Recordings of the same rig")
      ->type_name("FILE");
  addJoinOptions(app, arguments.joining);
  addParameterOptions(
      app, arguments.parameters,
      "Parameters of the rig (YAML), to begin with; calibration.*_std are what is known before");
  app.add_option(
         "-o,--output", arguments.output,
         "Where the parameters with the calibration are written, for fastlio-replay -c")
      ->type_name("FILE.yaml")
      ->capture_default_str();
  app.add_flag(
      "--overwrite", arguments.overwrite,
      "Replace FILE.yaml also where fastlio-calibrate did not write it");
  app.add_option(
         "--json", arguments.json,
         "Also write values and standard deviations as JSON to FILE, or with '-' instead of the "
         "table")
      ->type_name("FILE");
  app.add_option("--passes", arguments.passes, "Runs of each recording")
      ->check(CLI::Range(2, 100))
      ->capture_default_str();
  app.add_flag_callback(
      "--no-trial", [&arguments] { arguments.trial = false; },
      "Do not try the calibration on data that it was not fitted to (saves half of the time)");
  app.add_flag("-q,--quiet", arguments.quiet, "Print nothing but errors");
  addVersion(app, MRPT_FASTLIO_VERSION, mrpt::system::MRPT_getVersion());
  const auto checks = [&arguments]
  {
    if (arguments.recordings.empty())
      throw CLI::RequiredError("a recording (fastlio-calibrate walk.rawlog)");
  };
  if (const auto end =
          endAfterParsing(app, argc, argv, static_cast<int>(CalibrateStatus::Usage), checks))
    return *end;
  return arguments;
}

}  // namespace fastlio
