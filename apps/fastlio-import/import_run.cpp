// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "import_run.h"

#include "../shared/failure.h"
#include "../shared/interruption.h"
#include "../shared/readable_recordings.h"
#include "../shared/terminal_line.h"
#include "import_inputs.h"
#include "mcap_output.h"
#include "topic_list.h"
#include <fastlio/files/same_file.h>
#include <fastlio/math/time.h>
#include <fastlio/options/label_pattern.h>
#include <fastlio/options/printable.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/point_cloud_conversion.h>
#include <fastlio/survey/recording_parts.h>

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRotatingScan.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservation;
using mrpt::obs::CObservationPointCloud;

/** Counts of written observations, by label. */
struct Written
{
  std::size_t observations = 0;
  std::int64_t first_ns = 0, last_ns = 0;
};

RunResults resultsOf(const ImportArguments& arguments)
{
  if (!arguments.run.empty()) return readRunFolder(arguments.run);
  if (!arguments.trajectory.empty()) return readRunTrajectory(arguments.trajectory);
  return {};
}

std::unique_ptr<ImportOutput> outputOf(const ImportArguments& arguments)
{
  if (isMcapName(arguments.output.path))
    return std::make_unique<McapOutput>(arguments.output.path, resultsOf(arguments));
  return std::make_unique<RawlogParts>(arguments.output);
}

class Import
{
 public:
  Import(const ImportArguments& arguments, const ImportPlan& plan)
      : arguments_(arguments),
        plan_(plan),
        lidars_("--lidar-topic", arguments.lidar_topic),
        imus_("--imu-topic", arguments.imu_topic),
        output_(outputOf(arguments))
  {
  }

  void run(ImportInputs& source)
  {
    TerminalLine line(!arguments_.quiet);
    while (const auto observation = interrupted() ? nullptr : source.next())
    {
      if (isWanted(*observation)) write(converted(observation));
      if (line.isShown()) line.showShare("importing", source.progress().share());
    }
    line.clear();
    if (interrupted()) throw Failure(ImportStatus::Interrupted, "interrupted; nothing was written");
    files_ = output_->finish();
  }

  [[nodiscard]] const std::map<std::string, Written>& written() const { return written_; }
  [[nodiscard]] const std::vector<OutputFile>& files() const { return files_; }

 private:
  [[nodiscard]] bool isWanted(const CObservation& observation) const
  {
    if (dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation) != nullptr)
      return imus_.matches(observation.sensorLabel);
    const bool lidar =
        dynamic_cast<const CObservationPointCloud*>(&observation) != nullptr ||
        dynamic_cast<const mrpt::obs::CObservationVelodyneScan*>(&observation) != nullptr ||
        dynamic_cast<const mrpt::obs::CObservationRotatingScan*>(&observation) != nullptr;
    return !lidar || lidars_.matches(observation.sensorLabel);
  }

  // A cloud whose times are understood gets MRPT's: seconds after the stamp. A cloud that does not
  // keep to what was found stays as it is.
  [[nodiscard]] CObservation::Ptr converted(const CObservation::Ptr& observation) const
  {
    const auto cloud = std::dynamic_pointer_cast<CObservationPointCloud>(observation);
    const auto plan = plan_.lidars.find(observation->sensorLabel);
    if (!cloud || !cloud->pointcloud || plan == plan_.lidars.end() ||
        plan->second.finding.verdict != PointTimeVerdict::Found)
      return observation;
    const CloudConversion conversion = toTimedPoints(
        readColumns(*cloud->pointcloud), toNanoseconds(cloud->timestamp), plan->second.timing);
    if (conversion.times == PointTimes::PerPoint) cloud->pointcloud = makeXyzirt(conversion.points);
    return cloud;
  }

  void write(const CObservation::Ptr& observation)
  {
    if (!output_->write(*observation)) return;
    Written& written = written_[observation->sensorLabel];
    const std::int64_t stamp_ns = toNanoseconds(observation->timestamp);
    if (written.observations++ == 0) written.first_ns = stamp_ns;
    written.last_ns = stamp_ns;
  }

  const ImportArguments& arguments_;
  const ImportPlan& plan_;
  LabelPattern lidars_, imus_;
  std::unique_ptr<ImportOutput> output_;
  std::map<std::string, Written> written_;
  std::vector<OutputFile> files_;
};

/** \exception Failure a pattern of topics finds nothing; lists what there is */
void requireFound(
    const ImportPlan& plan, SensorKind kind, const std::string& option, const std::string& topic,
    const std::vector<std::string>& new_labels)
{
  if (topic.empty()) return;
  const LabelPattern pattern(option, topic);
  for (const std::string& label : new_labels)
    if (pattern.matches(label)) return;
  const char* const name = kind == SensorKind::Imu ? "IMU" : "LiDAR";
  std::string others;
  for (const SensorSummary& sensor : plan.survey.sensors)
  {
    if (sensor.kind != kind) continue;
    if (pattern.matches(sensor.label)) return;
    others += "\n  found: " + describe(sensor);
  }
  throw Failure(
      ImportStatus::Unusable, option + " '" + printable(topic) + "' matches no " + name + ". " +
                                  (others.empty() ? std::string("There is none.")
                                                  : "The whole topic must match:" + others));
}

/** The parts that are there already, in order. */
std::vector<std::string> partsThere(const RawlogParts::Options& output)
{
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(output.path).parent_path();
  std::set<std::size_t> parts;
  std::error_code error;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, error);
       !error && at != fs::directory_iterator(); at.increment(error))
    if (const auto part = RawlogParts::partOf(output, at->path().filename().string()))
      parts.insert(*part);
  std::vector<std::string> there;
  there.reserve(parts.size());
  for (const std::size_t part : parts)
    there.push_back(RawlogParts::pathOfPart(output, part));
  return there;
}

void requireHarmlessOutput(const ImportArguments& arguments)
{
  std::vector<FileUse> inputs;
  for (const std::string& file : arguments.input_files)
    inputs.push_back({file, "input"});
  inputs.push_back({arguments.trajectory, "--trajectory"});
  const std::string first = RawlogParts::pathOfPart(arguments.output, 0);
  for (const char* name : {"covariance.csv", "trajectory.tum", "map.ply", "timing.csv"})
    if (!arguments.run.empty()) inputs.push_back({arguments.run + "/" + name, "--run"});
  std::vector<FileUse> outputs{{first, "--output"}};
  const std::vector<std::string> there = partsThere(arguments.output);
  for (const std::string& part : there)
    if (part != first) outputs.push_back({part, "--output"});
  requireDistinctFiles(inputs, outputs);
  for (const std::string& input : arguments.input_files)
    if (std::filesystem::is_directory(input) && isBelow(first, input))
      throw std::invalid_argument(
          "--output '" + first + "' is inside of the input '" + input + "'; choose another place");
  if (!there.empty() && !arguments.overwrite)
    throw std::invalid_argument(
        "the file '" + there.front() +
        "' is there already; choose another name, or give --overwrite");
}

void report(const ImportArguments& arguments, const ImportPlan& plan, const Import& import)
{
  if (arguments.quiet) return;
  for (const auto& [label, written] : import.written())
    std::cout << printable(label) << ": " << written.observations << " observations in "
              << toSeconds(written.last_ns - written.first_ns) << " s\n";
  std::cout << describeTimes(plan);
  for (const OutputFile& file : import.files())
    std::cout << file.path << ": " << file.bytes << " bytes\n";
}

void warn(const std::vector<ReadProblem>& problems)
{
  for (const ReadProblem& problem : problems)
    std::cerr << "fastlio-import: " << sentenceOf(problem) << '\n';
}
}  // namespace

ImportStatus runImport(const ImportArguments& arguments)
{
  requireGivenOnce(arguments.input_files);
  failingWith(ImportStatus::Unusable, [&] { requireReadableRecordings(arguments.input_files); });
  if (!arguments.list) requireHarmlessOutput(arguments);
  if (!arguments.merge) requireInOrder(arguments.input_files);
  const ImportPlan plan = planImport(arguments);
  if (arguments.list)
  {
    std::cout << listTopics(arguments, plan) << std::flush;
    return plan.survey.sensors.empty() ? ImportStatus::Unusable : ImportStatus::Ok;
  }
  ImportInputs source(arguments.input_files, arguments.merge);
  const auto require = [&](SensorKind kind, const char* option, const std::string& topic)
  { requireFound(plan, kind, option, topic, source.newLabels(kind)); };
  require(SensorKind::Lidar, "--lidar-topic", arguments.lidar_topic);
  require(SensorKind::Imu, "--imu-topic", arguments.imu_topic);
  Import import(arguments, plan);
  for (const std::string& note : source.notes())
    std::cerr << "fastlio-import: " << note << '\n';
  import.run(source);
  const std::vector<ReadProblem> problems = source.problems();
  warn(problems);
  report(arguments, plan, import);
  if (import.files().empty())
  {
    std::cerr << "fastlio-import: nothing to write: no input has an observation that is wanted; "
                 "--list shows what there is\n";
    return ImportStatus::Unusable;
  }
  return problems.empty() ? ImportStatus::Ok : ImportStatus::Incomplete;
}

}  // namespace fastlio
