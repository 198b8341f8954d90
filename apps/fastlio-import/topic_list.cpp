// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "topic_list.h"

#include <fastlio/options/printable.h>
#include <fastlio/rawlog/recording_formats.h>
#include <fastlio/recordings/recording_reader.h>
#include <fastlio/survey/sensor_selection.h>

namespace fastlio
{
namespace
{
std::string listReader(RecordingReader& reader)
{
  std::string text;
  for (;;)
  {
    const NextRecorded next = reader.next();
    if (std::holds_alternative<EndOfRecording>(next)) break;
    if (const auto* problem = std::get_if<ReadProblem>(&next))
      text += "  trouble: " + problem->message + "\n";
  }
  for (const TopicReport& topic : reader.topics())
    text += "  " + printable(topic.name) + "  " + printable(topic.type) + ": " +
            std::to_string(topic.messages) + " messages, " + std::to_string(topic.taken) +
            " taken: " + topic.reason + "\n";
  return text;
}

std::string listInput(const std::string& file)
{
  const RecordingFormat* format = recordingFormatOf(file);
  if (format != nullptr)
    return file + ": " + format->content + "\n" + listReader(*format->open(file));
  std::string text = file + ": MRPT rawlog\n";
  const SensorSurvey survey = surveySensors({file}, {});
  for (const ReadProblem& problem : survey.problems)
    text += "  trouble: " + problem.message + "\n";
  for (const SensorSummary& sensor : survey.sensors)
    text += "  " + describe(sensor) + "\n";
  return text;
}
}  // namespace

ImportPlan planImport(const ImportArguments& arguments)
{
  ImportPlan plan;
  plan.survey = surveySensors(arguments.input_files, {arguments.lidar_topic, arguments.imu_topic});
  SensorOptions options;
  options.point_time_unit = arguments.point_times.unit;
  options.point_time_reference = arguments.point_times.reference;
  options.missing_point_times = MissingPointTimes::None;
  for (const SensorSummary& sensor : plan.survey.sensors)
    if (sensor.kind == SensorKind::Lidar && !sensor.times_by_sensor)
      plan.lidars[sensor.label] = planLidar(sensor, options);
  return plan;
}

std::string listTopics(const ImportArguments& arguments, const ImportPlan& plan)
{
  std::string text;
  for (const std::string& file : arguments.input_files)
    text += listInput(file);
  return text + describeTimes(plan);
}

std::string describeTimes(const ImportPlan& plan)
{
  std::string text;
  for (const auto& [label, lidar] : plan.lidars)
  {
    text += "LiDAR '" + printable(label) + "': " + lidar.finding.evidence;
    text += lidar.finding.verdict == PointTimeVerdict::Found
                ? "; written in seconds after the stamp.\n"
                : "; written as recorded.\n";
  }
  return text;
}

}  // namespace fastlio
