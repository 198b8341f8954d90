// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "replay_run.h"

#include "../shared/interruption.h"
#include "run_counts.h"
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/files/failure_text.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>

#include <mrpt/core/format.h>
#include <mrpt/system/CTicTac.h>

#include <algorithm>
#include <filesystem>

namespace fastlio
{
namespace
{
using namespace mrpt::system;

std::vector<InputFile> inputFiles(const std::vector<std::string>& paths)
{
  std::vector<InputFile> files;
  for (const auto& path : paths)
  {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path, error);
    files.push_back({path, error ? 0 : bytes});
  }
  return files;
}

std::vector<std::string> sentences(const std::vector<ReadProblem>& problems)
{
  std::vector<std::string> texts;
  texts.reserve(problems.size());
  for (const auto& problem : problems)
    texts.push_back(sentenceOf(problem));
  return texts;
}

/** The sensors in use, and how their points get their times. */
std::vector<std::string> sensorTexts(const RunSetup& setup)
{
  std::vector<std::string> texts{describe(setup.selection.lidar)};
  for (const auto& lidar : setup.selection.further_lidars)
    texts.push_back(describe(lidar));
  texts.push_back(describe(setup.selection.imu));
  for (const auto* sentences : {&setup.plan.notes, &setup.plan.warnings})
    texts.insert(texts.end(), sentences->begin(), sentences->end());
  return texts;
}

OutputMapOptions outputMapOptions(const RunSetup& setup)
{
  OutputMapOptions options = outputMapOptions(
      setup.config.exporters, setup.config.odometry.map.output_spacing,
      setup.arguments.output_directory);
  if (setup.saved_map) options.origin = setup.saved_map->origin;
  return options;
}

/** A map that grows on is saved as a whole. */
OutputPoints withoutFields(const WorldPoints& points)
{
  OutputPoints output{points, {}};
  output.resize(points.size());
  return output;
}

ExportTarget outputOptions(const RunSetup& setup)
{
  return {
      setup.arguments.output_directory,
      setup.arguments.output_tum_path,
      setup.frame,
      setup.config.exporters,
      {setup.arguments.input_files, setup.selection, setup.plan.bridge},
      setup.config.odometry.lidar.time_offset,
      setup.config.odometry.imu_rate,
      referenceFor(setup.arguments.reference, setup.arguments.input_files),
      setup.config.odometry.lidar.max_range};
}
}  // namespace

ReplayRun::ReplayRun(RunSetup setup, COutputLogger& logger)
    : setup_(std::move(setup)),
      logger_(logger),
      places_(setup_.outputs),
      odometry_(setup_.config.odometry),
      exporters_(makeExporters(outputOptions(setup_))),
      output_map_(outputMapOptions(setup_)),
      progress_(logger)
{
  if (!setup_.saved_map) return;
  odometry_.startIn(*setup_.saved_map);
  if (const Vec3& origin = odometry_.mapOrigin(); !origin.isZero())
    logger_.logFmt(
        LVL_INFO,
        "the map lies far from the origin of its coordinates: map.metricmap and map.planes, which "
        "hold single precision, count from (%.0f, %.0f, %.0f) m",
        origin.x(), origin.y(), origin.z());
  if (setup_.config.odometry.map.update && exporters_.needMap())
    output_map_.insert(withoutFields(setup_.saved_map->points));
  setup_.saved_map.reset();  // the odometry has taken it
}

RunSummary ReplayRun::execute()
{
  const CTicTac stopwatch;
  DecodeAheadSource source(
      RawlogSource(setup_.arguments.input_files),
      ObservationBridge(setup_.selection, setup_.plan.bridge));
  try
  {
    consume(source);
  }
  catch (const std::exception& e)
  {
    failure_ = "the run ended early: " + failureText(e);
  }
  source.stop();
  progress_.clear();
  RunSummary summary = summarize(source);
  summary.wall_seconds = stopwatch.Tac();
  summary = exporters_.finish(std::move(summary), output_map_, &odometry_.map());
  places_.removeLeftovers(summary);
  return summary;
}

void ReplayRun::consume(DecodeAheadSource& source)
{
  while (!interrupted())
  {
    auto input = source.next();
    if (!input || !feed(std::move(*input))) break;
    drain();
    progress_.update({input_share_, statistics_.duration()});
  }
  drain();
  if (interrupted()) return;
  while (const auto result = odometry_.flush())
    take(*result);
  checkEnd();
}

/** The recording may go on where the trajectory ends. */
void ReplayRun::checkEnd()
{
  constexpr std::size_t kFewScans = 10;  // sensors do not stop at the same moment
  constexpr double kShortTime = 1.0;     // [s]
  if (statistics_.poses() == 0) return;
  const InputStatistics& in = odometry_.inputStatistics();
  const std::int64_t until_ns = std::max(in.newest_imu_ns, statistics_.endNs());
  const double rest_s = toSeconds(until_ns - statistics_.endNs());
  if (in.scans_after_result > kFewScans)
    statistics_.addLostEnd(until_ns, in.scans_after_result, lostEndText(in));
  else if (rest_s > kShortTime)
    end_diagnostic_ = Diagnostic{
        statistics_.endNs(), mrpt::format(
                                 "no scans follow, but %.1f s of inertial data do: the trajectory "
                                 "ends here",
                                 rest_s)};
  if (end_diagnostic_)
    logger_.logStr(
        LVL_WARN, "at " + secondsText(end_diagnostic_->stamp_ns) + ": " + end_diagnostic_->text);
}

bool ReplayRun::feed(DecodedInput input)
{
  input_share_ = input.progress.share();
  if (auto* scan = std::get_if<LidarScan>(&input.data)) return feedScan(std::move(*scan));
  const bool skipping = scans_seen_ < setup_.arguments.skip_first_n;
  if (!skipping) odometry_.addImu(std::get<ImuSample>(input.data));
  return true;
}

bool ReplayRun::feedScan(LidarScan scan)
{
  const auto& arguments = setup_.arguments;
  const std::size_t index = scans_seen_++;
  if (index < arguments.skip_first_n) return true;
  const std::size_t used_before = index - arguments.skip_first_n;
  if (arguments.only_first_n > 0 && used_before >= arguments.only_first_n) return false;
  odometry_.addScan(std::move(scan));
  return true;
}

void ReplayRun::drain()
{
  while (const auto result = odometry_.next())
    take(*result);
}

void ReplayRun::take(const ScanResult& result)
{
  statistics_.add(result);
  extendOutputMap();
  exporters_.onScan(result, odometry_.imuRateStates());
  reportRemarks();
  reportChange(result);
  reportExporters();
}

/** The map for the user is denser than what the odometry matches with. */
void ReplayRun::extendOutputMap()
{
  if (!exporters_.needMap()) return;
  try
  {
    output_map_.insert({odometry_.registeredPoints(), odometry_.registeredFields()});
  }
  catch (const std::exception& e)
  {
    exporters_.giveUpMap(failureText(e));  // the rest of the run does not depend on it
  }
}

/** Reports when scans start to fare differently; every scan at DEBUG. */
void ReplayRun::reportChange(const ScanResult& result)
{
  const bool changed = !last_status_ || *last_status_ != result.status;
  last_status_ = result.status;
  const bool bad =
      result.status == ScanStatus::PredictionOnly || result.status == ScanStatus::Diverged;
  const auto level = !changed ? LVL_DEBUG : bad ? LVL_WARN : LVL_INFO;
  if (level < logger_.getMinLoggingLevel()) return;
  progress_.clear();
  std::string text = "scan " + std::to_string(statistics_.scans() - 1) + " at " +
                     secondsText(result.stamp_ns) + ": " + toString(result.status);
  if (!result.message.empty()) text += ": " + result.message;
  logger_.logStr(level, text);
}

void ReplayRun::reportRemarks()
{
  const std::vector<Diagnostic>& diagnostics = odometry_.diagnostics();
  for (; diagnostics_reported_ < diagnostics.size(); ++diagnostics_reported_)
  {
    progress_.clear();
    const Diagnostic& diagnostic = diagnostics[diagnostics_reported_];
    logger_.logStr(LVL_WARN, "at " + secondsText(diagnostic.stamp_ns) + ": " + diagnostic.text);
  }
}

void ReplayRun::reportExporters()
{
  for (; exporter_problems_told_ < exporters_.problems().size(); ++exporter_problems_told_)
  {
    progress_.clear();
    logger_.logStr(LVL_ERROR, exporters_.problems()[exporter_problems_told_]);
  }
}

RunSummary ReplayRun::summarize(const DecodeAheadSource& source) const
{
  RunSummary summary;
  summary.program = "fastlio-replay";
  summary.version = FASTLIO_VERSION;
  summary.inputs = inputFiles(setup_.arguments.input_files);
  summary.configuration = setup_.configuration;
  summary.frame = setup_.frame.name;
  summary.map_origin = odometry_.mapOrigin();
  summary.sensors = sensorTexts(setup_);
  summary.places = setup_.plan.places;
  summary.odometry = setup_.config.odometry;
  summary.options = textsOf(configTable(), setup_.config);
  summary.defaults = textsOf(configTable(), Config{});
  summary.input_counts = inputCounts(source.statistics(), odometry_.inputStatistics());
  summary.input_counts.push_back(
      {"scans_skipped", std::min(scans_seen_, setup_.arguments.skip_first_n)});
  summary.statistics = statistics_;
  summary.imu = odometry_.imuReport();
  summary.diagnostics = odometry_.diagnostics();
  if (end_diagnostic_) summary.diagnostics.push_back(*end_diagnostic_);
  if (const auto left_out = leftOutText(source.statistics()))
    summary.diagnostics.push_back({statistics_.endNs(), *left_out});
  summary.interrupted = interrupted();
  summary.input_problems = sentences(source.problems());
  summary.failure = failure_;
  return summary;
}

}  // namespace fastlio
