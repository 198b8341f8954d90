// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/mrpt_compat.h>
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/files/gzip_file.h>
#include <fastlio/math/time.h>
#include <fastlio/options/number_text.h>
#include <fastlio/run/lidar_clock.h>
#include <fastlio/run/mrpt_poses.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/obs/CObservationComment.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>

namespace fastlio
{
namespace
{
/** Velocities in the body frame as YAML, for versions of MRPT whose maps have no place for them. */
mrpt::obs::CObservationComment::Ptr twistComment(const TrackedPose& pose)
{
  auto comment = mrpt::obs::CObservationComment::Create();
  comment->timestamp = toMrptTime(pose.stamp_ns);
  comment->sensorLabel = "metadata";
  const auto list = [](const Vec3& v)
  {
    return "[" + roundTripText(v.x()) + ", " + roundTripText(v.y()) + ", " + roundTripText(v.z()) +
           "]";
  };
  comment->text = "# Of the vehicle, its own frame.\nlinear_velocity: " + list(pose.velocity) +
                  "  # [m/s]\nangular_velocity: " + list(pose.angular_velocity) + "  # [rad/s]\n";
  return comment;
}

class SimpleMapExporter : public Exporter
{
 public:
  explicit SimpleMapExporter(const ExportTarget& options)
      : file_(options.path("keyframes.simplemap")),
        recording_(options.recording),
        clock_(options.time_offset),
        track_(options.frame),
        rule_(options.parameters.keyframe_distance, options.parameters.keyframe_angle)
  {
  }

  void onScan(const ScanResult& result) override
  {
    track_.add(result);
    clock_.add(result);
  }

  std::vector<OutputFile> finish(const RunEnd& /*end*/) override
  {
    mrpt::maps::CSimpleMap map;
    forEachObservation(
        recording_,
        [&](const mrpt::obs::CObservation::Ptr& observation)
        {
          if (isSelectedScan(recording_, *observation)) consider(observation, map);
          return true;
        });
    mrpt::serialization::archiveFrom(file_) << map;
    return {file_.commit()};
  }

 private:
  /** The pose is that of the scan's own stamp, to which the times of its points refer. */
  void consider(const mrpt::obs::CObservation::Ptr& scan, mrpt::maps::CSimpleMap& map)
  {
    const auto pose = track_.at(clock_.poseTimeOf(toNanoseconds(scan->timestamp)));
    if (!pose || !rule_.accept(pose->T_world_body)) return;
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(scan);
    frame->insert(twistComment(*pose));
    const Vec3& v = pose->velocity;
    const Vec3& w = pose->angular_velocity;
    insertKeyFrame(
        map, toMrptPdf(pose->T_world_body, pose->covariance), frame,
        {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()});
  }

  GzipFile file_;
  RecordingAccess recording_;
  LidarClock clock_;
  PoseTrack track_;
  KeyFrameRule rule_;
};
}  // namespace

std::unique_ptr<Exporter> makeSimpleMapExporter(const ExportTarget& options)
{
  return std::make_unique<SimpleMapExporter>(options);
}

}  // namespace fastlio
