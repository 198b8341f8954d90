// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "survey_pass.h"

#include <fastlio/mrpt_bridge/conversions.h>
#include <fastlio/mrpt_bridge/imu_conversion.h>

#include <mrpt/rtti/CObject.h>

#include <algorithm>

namespace fastlio
{
namespace
{
constexpr double kSecondsPerNanosecond = 1e-9;

void tell(const SurveyProgress& progress, const ReadProgress& read)
{
  if (progress && read.bytes_total > 0)
    progress(static_cast<double>(read.bytes_read) / static_cast<double>(read.bytes_total));
}

/** Takes observations in the order of the files. */
class Gatherer
{
 public:
  void add(const mrpt::obs::CObservation& observation)
  {
    if (observation.timestamp == INVALID_TIMESTAMP) return;
    noteObservation(pass_.survey, observation);
    const std::size_t sensor = sensorOf(observation);
    pass_.stamps.resize(pass_.survey.sensors.size());
    pass_.samples.resize(pass_.survey.sensors.size());
    pass_.leads.resize(pass_.survey.sensors.size());
    const std::int64_t stamp_ns = toNanoseconds(observation.timestamp);
    pass_.stamps[sensor].push_back(stamp_ns);
    switch (pass_.survey.sensors[sensor].kind)
    {
      case SensorKind::Imu:
        addSample(pass_.samples[sensor], observation);
        newest_imu_ns_ = stamp_ns;
        break;
      case SensorKind::Lidar:
        if (newest_imu_ns_)
          pass_.leads[sensor].push_back(
              static_cast<double>(stamp_ns - *newest_imu_ns_) * kSecondsPerNanosecond);
        break;
      case SensorKind::Other:
        break;
    }
  }

  FirstPass take() { return std::move(pass_); }

 private:
  [[nodiscard]] std::size_t sensorOf(const mrpt::obs::CObservation& observation) const
  {
    const auto& sensors = pass_.survey.sensors;
    const auto found = std::find_if(
        sensors.begin(), sensors.end(),
        [&](const SensorSummary& s)
        {
          return s.label == observation.sensorLabel &&
                 s.class_name == observation.GetRuntimeClass()->className;
        });
    return static_cast<std::size_t>(found - sensors.begin());
  }

  static void addSample(std::vector<ImuSample>& samples, const mrpt::obs::CObservation& observation)
  {
    const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation);
    const auto sample = imu != nullptr ? toImuSample(*imu).sample : std::nullopt;
    if (sample && (samples.empty() || sample->stamp_ns > samples.back().stamp_ns))
      samples.push_back(*sample);
  }

  FirstPass pass_;
  std::optional<std::int64_t> newest_imu_ns_;
};

/** Rotations between scans that follow each other. */
class TurnFinder
{
 public:
  void add(const LidarScan& scan)
  {
    const ScanSpan span = spanOf(scan);
    const std::int64_t middle_ns = span.begin_ns + (span.end_ns - span.begin_ns) / 2;
    if (earlier_.size() > 0) match(scan.points, middle_ns);
    earlier_ = scan.points;
    earlier_ns_ = middle_ns;
  }

  std::vector<ScanTurn> take() { return std::move(turns_); }

 private:
  void match(const PointColumns& points, std::int64_t middle_ns)
  {
    const auto motion = matchScans(earlier_, points, guess_);
    guess_ = motion.value_or(Pose{});
    if (motion) turns_.push_back({earlier_ns_, middle_ns, logSO3(motion->R)});
  }

  PointColumns earlier_;
  std::int64_t earlier_ns_ = 0;
  Pose guess_;
  std::vector<ScanTurn> turns_;
};
}  // namespace

FirstPass readFirst(const std::vector<std::string>& files, const SurveyProgress& progress)
{
  RawlogSourceOptions as_recorded;
  as_recorded.sorting_window = 0.0;
  RawlogSource source(files, as_recorded);
  Gatherer gatherer;
  while (const auto observation = source.next())
  {
    gatherer.add(*observation);
    tell(progress, source.progress());
  }
  FirstPass pass = gatherer.take();
  pass.survey.problems = source.problems();
  return pass;
}

SecondPass readSecond(
    const std::vector<std::string>& files, ObservationBridge bridge,
    const SecondPassRequest& request, const SurveyProgress& progress)
{
  RawlogSource source(files);
  SecondPass pass;
  pass.looks.resize(1 + bridge.selection().further_lidars.size());
  TurnFinder turns;
  while (const auto observation = source.next())
  {
    tell(progress, source.progress());
    const auto lidar = bridge.lidarOf(*observation);
    if (!lidar) continue;
    const std::int64_t stamp_ns = toNanoseconds(observation->timestamp);
    const bool in_window =
        *lidar == 0 && stamp_ns >= request.turns.begin_ns && stamp_ns <= request.turns.end_ns;
    const bool to_look = pass.looks[*lidar].scans() < request.looks;
    if (!in_window && !to_look) continue;
    const BridgeOutput output = bridge.convert(*observation);
    const auto* scan = std::get_if<LidarScan>(&output);
    if (scan == nullptr) continue;
    if (to_look) pass.looks[*lidar].add(scan->points);
    if (in_window) turns.add(*scan);
    if (*lidar == 0) pass.T_imu_lidar = scan->T_imu_lidar;
  }
  pass.turns = turns.take();
  return pass;
}

}  // namespace fastlio
