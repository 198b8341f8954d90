// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "MolaLidarInertialOdometry.h"

#include <fastlio/files/atomic_file.h>
#include <fastlio/options/number_text.h>
#include <fastlio/run/mrpt_poses.h>
#include <fastlio/run/pose_output.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/core/initializer.h>
#include <mrpt/maps/CSimplePointsMap.h>

IMPLEMENTS_MRPT_OBJECT(MolaLidarInertialOdometry, mola::FrontEndBase, fastlio)

MRPT_INITIALIZER(registerFastlioMolaModule)
{
  fastlio::registerSlamClasses();
  MOLA_REGISTER_MODULE(fastlio::MolaLidarInertialOdometry);
}

namespace fastlio
{
MolaLidarInertialOdometry::MolaLidarInertialOdometry()
{
  setLoggerName("fastlio::MolaLidarInertialOdometry");
  odometry_.setCallback([this](const OdometryEstimate& estimate) { advertise(estimate); });
}

void MolaLidarInertialOdometry::initialize_frontend(const mola::Yaml& cfg)
{
  const mola::Yaml params =
      cfg.has("params") ? mola::Yaml(cfg["params"]) : mola::Yaml(mola::Yaml::Map());
  reference_frame_ = params.getOrDefault<std::string>("reference_frame", reference_frame_);
  map_every_n_scans_ = params.getOrDefault<std::size_t>("map_every_n_scans", map_every_n_scans_);
  output_tum_path_ = params.getOrDefault<std::string>("output_tum_path", output_tum_path_);
  odometry_.initialize(params.has("odometry") ? mola::Yaml(params["odometry"]) : mola::Yaml());
}

void MolaLidarInertialOdometry::onNewObservation(ObservationArgument observation)
{
  const std::lock_guard lock(queue_mutex_);
  queue_.push_back(observation);
}

mrpt::obs::CObservation::ConstPtr MolaLidarInertialOdometry::takeOne()
{
  const std::lock_guard lock(queue_mutex_);
  if (queue_.empty()) return nullptr;
  auto observation = std::move(queue_.front());
  queue_.pop_front();
  return observation;
}

void MolaLidarInertialOdometry::spinOnce()
{
  const mola::ProfilerEntry timing(profiler_, "spinOnce");
  while (const auto observation = takeOne())
  {
    const std::lock_guard lock(odometry_mutex_);
    keyframes_.keep(observation);
    odometry_.onNewObservation(observation);
  }
}

void MolaLidarInertialOdometry::onQuit()
{
  spinOnce();
  const std::lock_guard lock(odometry_mutex_);
  odometry_.finish();
  writeTrajectory(output_tum_path_);
}

void MolaLidarInertialOdometry::writeTrajectory(const std::string& path)
{
  if (path.empty()) return;
  std::string text;
  for (const TrackedPose& pose : odometry_.track().poses())
    text += secondsText(pose.stamp_ns) + " " + poseColumns(pose.T_world_body, ' ') + "\n";
  try
  {
    writeFileAtomically(path, text);
    MRPT_LOG_INFO_STREAM(odometry_.track().poses().size() << " poses written to '" << path << "'");
  }
  catch (const std::exception& e)
  {
    MRPT_LOG_ERROR_STREAM("the trajectory is not written: " << e.what());
  }
}

void MolaLidarInertialOdometry::advertise(const OdometryEstimate& estimate)
{
  note(estimate.result);
  if (!estimate.vehicle) return;
  const TrackedPose& vehicle = *estimate.vehicle;
  LocalizationUpdate update;
  update.timestamp = toMrptTime(vehicle.stamp_ns);
  update.reference_frame = reference_frame_;
  update.method = "lidar_inertial_odometry";
  update.pose = toMrptPose(vehicle.T_world_body).asTPose();
  update.cov = mrptCovariance(vehicle.T_world_body, vehicle.covariance);
  advertiseUpdatedLocalization(update);
  // A subscriber may have loaded another map: the pose is none in it.
  if (!odometry_.latest()) return;
  offerKeyframe(estimate);
  if (map_every_n_scans_ > 0 && scans_++ % map_every_n_scans_ == 0) advertiseMap(vehicle.stamp_ns);
}

void MolaLidarInertialOdometry::advertiseMap(std::int64_t stamp_ns)
{
  MapUpdate update;
  update.timestamp = toMrptTime(stamp_ns);
  update.reference_frame = reference_frame_;
  update.method = "lidar_inertial_odometry";
  update.map = odometry_.map();
  advertiseUpdatedMap(update);
}

#if FASTLIO_MOLA_HAS_KEYFRAME_MAP
void MolaLidarInertialOdometry::offerKeyframe(const OdometryEstimate& estimate)
{
  if (!keyframes_.isDue(estimate.vehicle->T_world_body)) return;
  const auto sinks = findService<mola::SharedKeyframeMap>();
  if (sinks.empty()) return;
  const auto request = keyframes_.take(estimate, odometry_);
  if (!request) return;
  for (const auto& sink : sinks)
    if (!std::dynamic_pointer_cast<mola::SharedKeyframeMap>(sink)->requestInsertKeyframe(*request))
      MRPT_LOG_WARN_STREAM("the mapper rejected a keyframe");
}
#else
void MolaLidarInertialOdometry::offerKeyframe(const OdometryEstimate& /*estimate*/)
{
  // This MOLA has no mapper that takes keyframes.
}
#endif

}  // namespace fastlio
