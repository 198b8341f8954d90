// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "command_line.h"

#include "../shared/parsing.h"

#include <cmath>
#include <map>

namespace fastlio
{
namespace
{
constexpr const char* kFooter = R"(Formats, recognised by content:
  TUM             time[s] x y z[m] qx qy qz qw
  KITTI           12 numbers, the 3x4 pose matrix; needs --kitti-times or --kitti-rate
  states.csv      as written by fastlio-replay
  covariance.csv  as written by fastlio-replay; as the estimate it adds NEES to the report

Exit status:
  0  evaluated, all limits kept
  1  wrong usage, unreadable or unusable input, output not written
  2  a limit (--max-*, --min-*) is not kept)";

const std::map<std::string, Alignment>& alignmentNames()
{
  static const std::map<std::string, Alignment> kNames{
      {"none", Alignment::None},
      {"first", Alignment::First},
      {"yaw", Alignment::Yaw},
      {"se3", Alignment::Se3},
      {"sim3", Alignment::Sim3}};
  return kNames;
}

const std::map<std::string, NeesAlignment>& neesAlignmentNames()
{
  static const std::map<std::string, NeesAlignment> kNames{
      {"first", NeesAlignment::First}, {"none", NeesAlignment::None}};
  return kNames;
}

void addInputOptions(CLI::App& app, EvalCommand& c)
{
  app.add_option("reference,-r,--reference", c.reference, "Trajectory taken as the truth")
      ->type_name("FILE");
  const char* estimates =
      "Trajectory to be evaluated, or the folder of a run; several: one row each";
  app.add_option("estimates", c.estimates, estimates)->type_name("FILE|DIR ...");
  // Takes one only, so that the reference may follow it.
  app.add_option_function<std::vector<std::filesystem::path>>(
         "-e,--estimate",
         [&c](const auto& given)
         { c.estimates.insert(c.estimates.end(), given.begin(), given.end()); },
         estimates)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("FILE|DIR");
  app.final_callback(
      [&c]
      {
        if (c.reference.empty())
          throw CLI::RequiredError("a reference (fastlio-eval truth.tum trajectory.tum)");
        if (c.estimates.empty())
          throw CLI::RequiredError("an estimate (fastlio-eval truth.tum trajectory.tum)");
      });
  auto* times =
      app.add_option(
             "--kitti-times", c.kitti.times_file, "File with one time [s] per line for KITTI poses")
          ->type_name("FILE");
  app.add_option("--kitti-rate", c.kitti.rate, "Poses per second [Hz] of KITTI poses")
      ->excludes(times);
  app.add_option(
         "--max-gap", c.evaluation.association.max_gap,
         "Do not interpolate the reference across longer gaps [s]")
      ->capture_default_str();
  app.add_option(
         "--time-offset", c.evaluation.association.time_offset,
         "Added to the times of the estimate [s]")
      ->capture_default_str();
}

/** An option that takes one of some names. */
template <typename T>
void addChoice(
    CLI::App& app, const char* name, const char* text, const std::map<std::string, T>& choices,
    T& value, const char* default_name)
{
  app.add_option_function<std::string>(
         name, [&](const std::string& choice) { value = choices.at(choice); }, text)
      ->check(CLI::IsMember(&choices))
      ->type_name("NAME")
      ->default_str(default_name);
}

void addMeasureOptions(CLI::App& app, EvaluationOptions& e)
{
  addChoice(
      app, "-a,--align", "What aligns both world frames ('yaw': yaw and position)",
      alignmentNames(), e.alignment, "se3");
  addChoice(
      app, "--nees-align",
      "NEES relative to the first pose ('first'), or with one common world frame ('none')",
      neesAlignmentNames(), e.nees_alignment, "first");
  app.add_option("--rpe-seconds", e.rpe_seconds, "Span of the RPE per second [s]")
      ->capture_default_str();
  app.add_option("--rpe-metres", e.rpe_metres, "Span of the RPE per metre [m]")
      ->capture_default_str();
  app.add_option(
         "--segment-lengths", e.segment_lengths, "Lengths of segments [m], separated by commas")
      ->delimiter(',')
      ->default_str("5,10,25,50,100,200,...,800");
}

void addOutputOptions(CLI::App& app, EvalCommand& c)
{
  app.add_flag("-q,--quiet", c.quiet, "Print nothing but errors");
  app.add_option(
         "--json", c.json_path,
         "Write the report as JSON to FILE, or with '-' instead of the table")
      ->type_name("FILE");
  app.add_option(
         "--plot", c.svg_path,
         "Write a picture (.svg or .png): top view, height and errors over time")
      ->type_name("FILE");
}

/** Empty when the text is a limit; CLI::Range would let a NaN pass. */
std::string limitNumber(const std::string& text)
{
  double value = 0.0;
  const bool is_number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
  return is_number && value >= 0.0 ? ""
                                   : "a limit must be a number, 0 or above, saw '" + text + "'";
}

void addGateOptions(CLI::App& app, GateLimits& limits)
{
  for (const GateKind& kind : gateKinds())
    app.add_option_function<double>(
           std::string("--") + kind.name,
           [&limits, name = kind.name](double limit) { limits[name] = limit; }, kind.text)
        ->check(limitNumber)
        ->group("Limits");
}
}  // namespace

void addOptions(CLI::App& app, EvalCommand& command)
{
  addVersion(app, MRPT_FASTLIO_VERSION);
  app.footer(kFooter);
  addInputOptions(app, command);
  addMeasureOptions(app, command.evaluation);
  addOutputOptions(app, command);
  addGateOptions(app, command.gates);
}

}  // namespace fastlio
