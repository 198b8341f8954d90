// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "survey_pass.h"

#include <fastlio/filter/backward_propagation.h>
#include <fastlio/math/columns.h>
#include <fastlio/math/time.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/imu_conversion.h>

#include <mrpt/rtti/CObject.h>

#include <algorithm>
#include <utility>

namespace fastlio
{
namespace
{

void report(const SurveyProgress& progress, const ReadProgress& read)
{
  if (progress) progress(read.share());
}

/** Takes observations in the order of the files. */
class Gatherer
{
 public:
  void add(const mrpt::obs::CObservation& observation)
  {
    const auto noted = noteObservation(pass_.survey, observation);
    if (!noted) return;
    const std::size_t sensor = *noted;
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
        if (newest_imu_ns_) pass_.leads[sensor].push_back(toSeconds(stamp_ns - *newest_imu_ns_));
        break;
      case SensorKind::Other:
        break;
    }
  }

  FirstPass take() { return std::move(pass_); }

 private:
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

/** A scan whose points can be brought to its middle, as far as its motion is known. */
struct TimedScan
{
  LidarScan scan;
  std::int64_t middle_ns = 0;
};

TimedScan timed(const LidarScan& scan)
{
  const ScanSpan span = spanOf(scan);
  return {scan, span.begin_ns + (span.end_ns - span.begin_ns) / 2};
}

/** Motion that takes so many seconds, as a steady one: rate and velocity, in the LiDAR's axes. */
MotionKnot steadyMotion(const Pose& moved, double seconds)
{
  MotionKnot motion;
  motion.w = logSO3(moved.R) / seconds;
  motion.v = moved.p / seconds;
  return motion;
}

MotionKnot meanOf(const MotionKnot& a, const MotionKnot& b)
{
  MotionKnot mean;
  mean.w = 0.5 * (a.w + b.w);
  mean.v = 0.5 * (a.v + b.v);
  return mean;
}

/** The points as seen from the pose at the scan's middle, under a steady motion. */
PointColumns seenFromMiddle(const TimedScan& timed_scan, const MotionKnot& motion)
{
  const LidarScan& scan = timed_scan.scan;
  PointColumns points = scan.points;
  if (!scan.has_point_times) return points;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::int64_t stamp_ns = scan.stamp_ns + points.time_offset_ns[i];
    const double dt = toSeconds(stamp_ns - timed_scan.middle_ns);
    const Vec3 q = poseAfter(motion, dt) * pointAt(points, i);
    points.x[i] = static_cast<float>(q.x());
    points.y[i] = static_cast<float>(q.y());
    points.z[i] = static_cast<float>(q.z());
  }
  return points;
}

/** Rotations between scans that follow each other. A scan's points are brought to its middle by the
 * mean of the motions before and after it, so that a pair is only known with the scan after it. */
class TurnFinder
{
 public:
  void add(const LidarScan& scan)
  {
    TimedScan newest = timed(scan);
    if (last_) follow(newest);
    before_last_ = std::exchange(last_, std::move(newest));
  }

  std::vector<ScanTurn> take() { return std::move(turns_); }

 private:
  /** A motion from the last scan to the newest, which sharpens the one that led to the last. */
  void follow(const TimedScan& newest)
  {
    const auto next = matched(*last_, newest, motion_, motion_, motion_);
    std::optional<MotionKnot> sharp;
    if (before_last_ && next)
      sharp = matched(
          *before_last_, *last_, meanOf(motion_before_, motion_), meanOf(motion_, *next), motion_);
    if (sharp)
      turns_.push_back(
          {before_last_->middle_ns, last_->middle_ns, sharp->w * secondsOf(*before_last_, *last_)});
    motion_before_ = std::exchange(motion_, next.value_or(MotionKnot{}));
  }

  static double secondsOf(const TimedScan& earlier, const TimedScan& later)
  {
    return toSeconds(later.middle_ns - earlier.middle_ns);
  }

  /** The motion between two scans' middles.
   * \param in_earlier, in_later motions within the scans
   * \param guess of the result */
  static std::optional<MotionKnot> matched(
      const TimedScan& earlier, const TimedScan& later, const MotionKnot& in_earlier,
      const MotionKnot& in_later, const MotionKnot& guess)
  {
    const double seconds = secondsOf(earlier, later);
    if (!(seconds > 0)) return std::nullopt;
    const auto moved = matchScans(
        seenFromMiddle(earlier, in_earlier), seenFromMiddle(later, in_later),
        poseAfter(guess, seconds));
    if (!moved) return std::nullopt;
    return steadyMotion(*moved, seconds);
  }

  std::optional<TimedScan> before_last_, last_;
  MotionKnot motion_before_, motion_;  // that led to these
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
    report(progress, source.progress());
  }
  FirstPass pass = gatherer.take();
  pass.survey.problems = source.problems();
  return pass;
}

SecondPass readSecond(
    const std::vector<std::string>& files, ObservationBridge bridge, const ScanSpan& lively,
    const SurveyProgress& progress)
{
  constexpr std::size_t kLooks = 20;  // scans of each LiDAR
  RawlogSource source(files);
  SecondPass pass;
  pass.looks.resize(1 + bridge.selection().further_lidars.size());
  TurnFinder turns;
  while (const auto observation = source.next())
  {
    report(progress, source.progress());
    const auto lidar = bridge.lidarOf(*observation);
    if (!lidar) continue;
    const std::int64_t stamp_ns = toNanoseconds(observation->timestamp);
    const bool in_window = *lidar == 0 && stamp_ns >= lively.begin_ns && stamp_ns <= lively.end_ns;
    const bool to_look = pass.looks[*lidar].scans() < kLooks;
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
