// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/pseudo_2d_scan.h>
#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/files/gzip_file.h>
#include <fastlio/math/time.h>
#include <fastlio/run/lidar_clock.h>
#include <fastlio/run/mrpt_poses.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <limits>

namespace fastlio
{
namespace
{
using namespace mrpt::obs;

CObservationRobotPose robotPose(const TrackedPose& pose)
{
  CObservationRobotPose observation;
  observation.timestamp = toMrptTime(pose.stamp_ns);
  observation.sensorLabel = "odometry";
  observation.pose = toMrptPdf(pose.T_world_body, pose.covariance);
  return observation;
}

/** Pose and velocity on the ground. */
CObservationOdometry wheelOdometry(const TrackedPose& pose)
{
  CObservationOdometry observation;
  observation.timestamp = toMrptTime(pose.stamp_ns);
  observation.sensorLabel = "odometry_2d";
  observation.odometry = onGround(pose.T_world_body);
  const Mat3& R = pose.T_world_body.R;
  const Vec3 level = expSO3({0.0, 0.0, -observation.odometry.phi()}) * R * pose.velocity;
  observation.hasVelocities = true;
  observation.velocityLocal = {level.x(), level.y(), (R * pose.angular_velocity).z()};
  return observation;
}

CActionRobotMovement2D movement2D(const TrackedPose& from, const TrackedPose& to)
{
  CActionRobotMovement2D action;
  action.timestamp = toMrptTime(to.stamp_ns);
  const auto motion = motionOnGround(from, to);
  action.poseChange = mrpt::poses::CPosePDFGaussian::Create(motion);
  action.rawOdometryIncrementReading = motion.mean;
  // Not emOdometry: consumers would replace the covariance by a model of wheels.
  action.estimationMethod = CActionRobotMovement2D::emScan2DMatching;
  return action;
}

CActionRobotMovement3D movement3D(const TrackedPose& from, const TrackedPose& to)
{
  CActionRobotMovement3D action;
  action.timestamp = toMrptTime(to.stamp_ns);
  const RelativePose motion = relativePose(from, to);
  action.poseChange = toMrptPdf(motion.T_a_b, motion.covariance);
  action.rawOdometryIncrementReading = toMrptPose(motion.T_a_b);
  action.estimationMethod = CActionRobotMovement3D::emVisualOdometry;
  return action;
}

class RawlogExporter : public Exporter
{
 public:
  explicit RawlogExporter(const ExportTarget& options)
      : file_(options.path("odometry.rawlog")),
        recording_(options.recording),
        parameters_(options.parameters),
        clock_(options.time_offset),
        max_range_(options.max_range),
        bridge_(recording_.selection, recording_.bridge),
        track_(options.frame)
  {
  }

  void onScan(const ScanResult& result) override
  {
    track_.add(result);
    clock_.add(result);
  }

  std::vector<OutputFile> finish(const RunEnd& /*end*/) override
  {
    forEachObservation(
        recording_,
        [this](const CObservation::Ptr& observation)
        {
          if (parameters_.rawlog_form == RawlogForm::Actions)
            addToFrames(observation);
          else
            addToStream(observation);
          return passesAll() || !isOver(*observation);
        });
    writePosesBefore(std::numeric_limits<std::int64_t>::max());
    return {file_.commit()};
  }

 private:
  // Beyond: the poses are over. Single stamps may be corrupt, or of another clock.
  static constexpr std::size_t kMostBehind = 1000;

  /** Whether observations are written without any pose. */
  [[nodiscard]] bool passesAll() const
  {
    return parameters_.rawlog_form == RawlogForm::Observations && parameters_.rawlog_pass_through;
  }

  /** Whether nothing of what follows has a pose. */
  [[nodiscard]] bool isOver(const CObservation& observation)
  {
    const auto& poses = track_.poses();
    const std::int64_t stamp_ns = clock_.poseTimeOf(toNanoseconds(observation.timestamp));
    behind_ = poses.empty() || stamp_ns > poses.back().stamp_ns ? behind_ + 1 : 0;
    return behind_ >= kMostBehind;
  }

  void write(const mrpt::serialization::CSerializable& object)
  {
    mrpt::serialization::archiveFrom(file_) << object;
  }

  void writePosesBefore(std::int64_t stamp_ns)
  {
    if (parameters_.rawlog_form == RawlogForm::Actions) return;
    const auto& poses = track_.poses();
    for (; next_pose_ < poses.size() && poses[next_pose_].stamp_ns <= stamp_ns; ++next_pose_)
      write(robotPose(poses[next_pose_]));
  }

  [[nodiscard]] CObservation2DRangeScan::Ptr planarScan(const CObservation& observation)
  {
    if (!parameters_.rawlog_scan_2d) return nullptr;
    BridgeOutput output = bridge_.convert(observation);
    auto* scan = std::get_if<LidarScan>(&output);
    if (scan == nullptr) return nullptr;
    scan->stamp_ns = clock_.poseTimeOf(scan->stamp_ns);
    return pseudo2dScan(*scan, track_, parameters_, max_range_);
  }

  [[nodiscard]] std::optional<TrackedPose> poseOf(const CObservation& observation) const
  {
    if (!isSelectedScan(recording_, observation)) return std::nullopt;
    return track_.at(clock_.poseTimeOf(toNanoseconds(observation.timestamp)));
  }

  /** Everything in order of time; odometry and planar scan go before the scan that they are of. */
  void addToStream(const CObservation::Ptr& observation)
  {
    writePosesBefore(toNanoseconds(observation->timestamp));
    if (const auto pose = poseOf(*observation))
    {
      write(wheelOdometry(*pose));
      if (const auto planar = planarScan(*observation)) write(*planar);
    }
    if (parameters_.rawlog_pass_through) write(*observation);
  }

  /** A pair per scan; what came since the scan before is in its frame. */
  void addToFrames(const CObservation::Ptr& observation)
  {
    if (parameters_.rawlog_pass_through) frame_.insert(observation);
    const auto pose = poseOf(*observation);
    if (!pose)
    {
      // A run that is lost for hours would fill the memory with what nothing is written of.
      if (isSelectedScan(recording_, *observation)) frame_.clear();
      return;
    }
    const TrackedPose& from = last_.value_or(*pose);
    CActionCollection actions;
    actions.insert(movement2D(from, *pose));
    actions.insert(movement3D(from, *pose));
    if (const auto planar = planarScan(*observation)) frame_.insert(planar);
    write(actions);
    write(frame_);
    frame_.clear();
    last_ = *pose;
  }

  GzipFile file_;
  RecordingAccess recording_;
  ExportOptions parameters_;
  LidarClock clock_;
  double max_range_;
  ObservationBridge bridge_;
  PoseTrack track_;
  std::size_t next_pose_ = 0;
  std::optional<TrackedPose> last_;
  CSensoryFrame frame_;
  std::size_t behind_ = 0;  // observations in a row later than the last pose
};
}  // namespace

std::unique_ptr<Exporter> makeRawlogExporter(const ExportTarget& options)
{
  return std::make_unique<RawlogExporter>(options);
}

}  // namespace fastlio
