// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file run_summary.h The summary of a run after its end. */
#pragma once

#include <fastlio/files/atomic_file.h>
#include <fastlio/imu/imu_report.h>
#include <fastlio/interface/odometry_options.h>
#include <fastlio/options/option_table.h>
#include <fastlio/run/run_statistics.h>
#include <fastlio/survey/input_plan.h>

#include <string>
#include <string_view>
#include <vector>

namespace fastlio
{
/** A number with its name, e.g. {"imu_out_of_order", 3}. */
struct NamedCount
{
  std::string name;
  std::size_t count = 0;
};

/** A file that was read. */
struct InputFile
{
  std::string path;
  std::uintmax_t bytes = 0;
};

/** A run, as summary.json describes it. */
struct RunSummary
{
  std::string program, version;          //!< who computed it
  std::vector<InputFile> inputs;         //!< in reading order
  std::string configuration;             //!< the YAML file, or which defaults were used
  std::string frame;                     //!< body frame of the exported poses: "vehicle" or "imu"
  Vec3 map_origin = Vec3::Zero();        //!< Odometry::mapOrigin() [m]
  std::vector<std::string> sensors;      //!< one line per sensor in use
  std::vector<SensorPlace> places;       //!< where they are mounted
  OdometryOptions odometry;              //!< as used
  std::vector<OptionText> options;       //!< everything that is configured, as used
  std::vector<OptionText> defaults;      //!< of the options; empty: not known
  std::vector<NamedCount> input_counts;  //!< observations read and dropped, by reason
  RunStatistics statistics;
  ImuReport imu;                            //!< units, rate and faults of the inertial sensor
  std::vector<Diagnostic> diagnostics;      //!< what the user should know, in order
  double wall_seconds = 0;                  //!< of the whole run, reading included
  bool interrupted = false;                 //!< stopped by a signal
  std::vector<std::string> input_problems;  //!< truncated or corrupt input, in sentences
  std::string failure;                      //!< unexpected error that ended the run early, or empty
  std::vector<std::string> output_problems;  //!< files that could not be written
  std::vector<OutputFile> outputs;           //!< files that are complete
};

/** The count of the input by its name; 0: there is none. */
[[nodiscard]] std::size_t inputCount(const RunSummary& run, std::string_view name);

/** Counts of dropped data, by the input and by the limits of range; without zeros. */
[[nodiscard]] std::vector<NamedCount> losses(const RunSummary& run);

/** Of a sensor that lost more than half of its data for one reason, a sentence with that reason. */
[[nodiscard]] std::vector<std::string> lossSentences(const RunSummary& run);

/** There is no pose, the pose was lost, or there is no map. */
[[nodiscard]] bool isLost(const RunStatistics& statistics);

/** Exit status of the programs; part of their interface, do not renumber. */
enum class ExitStatus : int
{
  Ok = 0,
  Usage = 1,           //!< command line or configuration: nothing was run
  InputUnusable = 2,   //!< unreadable input or no usable sensors: nothing was computed
  InputBroken = 3,     //!< truncated or corrupt input: results up to there
  OdometryFailed = 4,  //!< diverged or never initialised: results written
  OutputFailed = 5,    //!< an output file could not be written; the others are complete
  Degraded = 6,        //!< stretches of the run cannot be trusted: results written
  Interrupted = 130    //!< a signal: results up to there
};

/** Exit status of a run that computed something; when several apply, the first of interrupted,
 * output failed, input broken, odometry failed, degraded. */
[[nodiscard]] ExitStatus exitStatusOf(const RunSummary& summary);

/** "ok", "input_broken", ... */
[[nodiscard]] const char* toString(ExitStatus status);

/** "ok (exit status 0)". */
[[nodiscard]] std::string statusText(ExitStatus status);

/** In a word or two, for a table of runs: "ok", "input damaged", ... */
[[nodiscard]] const char* wordsOf(ExitStatus status);

/** Of several runs, from the gravest: interrupted, output failed, usage, input unusable, input
 * broken, odometry failed, degraded, ok. \return the one that comes first */
[[nodiscard]] ExitStatus graver(ExitStatus a, ExitStatus b);

/** Seconds of recording per second of wall clock; 0 when nothing was processed. */
[[nodiscard]] double realTimeFactor(const RunSummary& summary);

}  // namespace fastlio
