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
    "Looks at a recording without running the odometry on it: sensors, rates, gaps, what the times "
    "of points mean, units and noise of the IMU at rest, time offset and rotation of the LiDAR by "
    "the motion that both see, and what fastlio-replay would do.";
constexpr const char* kFooter = R"(Exit status:
  0  fastlio-replay can run on the recording; the last line says whether it is damaged
  1  wrong usage or configuration, or a file that cannot be written
  2  it cannot: the last line says why

Example:
  fastlio-info walk.rawlog --write-config my.yaml
  fastlio-replay walk.rawlog -c my.yaml)";
}  // namespace

std::variant<InfoArguments, int> parseCommandLine(int argc, const char* const* argv)
{
  CLI::App app(kDescription, "fastlio-info");
  app.footer(kFooter);
  InfoArguments arguments;
  app.add_option(
         "input,--input-rawlog", arguments.input_files,
         "Recording; several are parts of one, in this order")
      ->type_name("FILE");
  addParameterOptions(
      app, arguments.parameters,
      "YAML parameters that fastlio-replay would get (labels, times of points, poses)");
  app.add_option(
         "--json", arguments.json_path,
         "Write everything as JSON to FILE, or with '-' instead of the table")
      ->type_name("FILE");
  app.add_option(
         "--write-config", arguments.new_config,
         "Write the parameters that follow from the recording, each with its reason, to be edited; "
         "a file that is there already is left alone")
      ->type_name("FILE.yaml");
  app.add_flag_callback(
      "--no-motion", [&arguments] { arguments.check_motion = false; },
      "Do not compare the motions that LiDAR and IMU see (the part that takes longest)");
  app.add_flag("-q,--quiet", arguments.quiet, "Print nothing but errors");
  addVersion(app, FASTLIO_VERSION, mrpt::system::MRPT_getVersion());
  const auto checks = [&arguments]
  {
    if (arguments.input_files.empty())
      throw CLI::RequiredError("a recording (fastlio-info walk.rawlog)");
  };
  if (const auto end =
          endAfterParsing(app, argc, argv, static_cast<int>(InfoStatus::Usage), checks))
    return *end;
  return arguments;
}

}  // namespace fastlio
