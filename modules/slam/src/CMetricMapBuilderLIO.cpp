// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/mrpt_compat.h>
#include <fastlio/exporters/pseudo_2d_scan.h>
#include <fastlio/math/columns.h>
#include <fastlio/math/linear_algebra.h>
#include <fastlio/run/mrpt_poses.h>
#include <fastlio/run/scan_in_world.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/slam/CMetricMapBuilderLIO.h>

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/poses/CPosePDF.h>

#include <cmath>

namespace fastlio
{
namespace
{
using mrpt::obs::CObservation;

constexpr std::size_t kMostWaiting = 100;

/** The scan's points as the LiDAR would have seen them from one place: where it was at the stamp.
 */
mrpt::obs::CObservationPointCloud::Ptr compensatedCloud(
    const LidarScan& scan, const PoseTrack& track, const Pose& T_world_lidar)
{
  const OutputPoints around = scanInWorld(scan, track, T_world_lidar.p);
  const Mat3 R_lidar_world = T_world_lidar.R.transpose();
  auto cloud = mrpt::maps::CSimplePointsMap::Create();
  cloud->reserve(around.size());
  for (std::size_t i = 0; i < around.size(); ++i)
  {
    const Vec3 p = R_lidar_world * pointAt(around, i);
    cloud->insertPointFast(
        static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  }
  cloud->mark_as_modified();
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  observation->timestamp = toMrptTime(scan.stamp_ns);
  observation->pointcloud = cloud;
  return observation;
}

mrpt::maps::TSetOfMetricMapInitializers orPoints(
    const mrpt::maps::TSetOfMetricMapInitializers& maps)
{
  if (maps.size() > 0) return maps;
  mrpt::maps::TSetOfMetricMapInitializers points;
  mrpt::maps::CSimplePointsMap::TMapDefinition definition;
  definition.insertionOpts.minDistBetweenLaserPoints = 0.1F;
  points.push_back(definition);
  return points;
}
}  // namespace

CMetricMapBuilderLIO::CMetricMapBuilderLIO(
    const Config& config, const mrpt::maps::TSetOfMetricMapInitializers& maps)
    : config_(config),
      definitions_(orPoints(maps)),
      rule_(config.exporters.keyframe_distance, config.exporters.keyframe_angle)
{
  initialize();
}

CMetricMapBuilderLIO::~CMetricMapBuilderLIO() = default;

void CMetricMapBuilderLIO::initialize(
    const mrpt::maps::CSimpleMap& initialMap, const mrpt::poses::CPosePDF* x0)
{
  const std::lock_guard lock(mutex_);
  // Nothing is changed when the parameters are refused.
  odometry_.initialize(config_);
  rule_ = KeyFrameRule(config_.exporters.keyframe_distance, config_.exporters.keyframe_angle);
  T_map_start_ = x0 == nullptr ? Pose{} : toPose(mrpt::poses::CPose3D(x0->getMeanVal()));
  T_map_world_.reset();
  waiting_.clear();
  views_ = initialMap;
  initial_views_ = views_.size();
  metric_map_.setListOfMaps(definitions_);
  insertInitialViews(metric_map_);
}

void CMetricMapBuilderLIO::insertInitialViews(mrpt::maps::CMultiMetricMap& metric_map) const
{
  for (std::size_t i = 0; i < initial_views_; ++i)
  {
    const KeyFrameView view = keyFrame(views_, i);
    const mrpt::poses::CPose3D pose = view.pose->getMeanVal();
    view.frame->insertObservationsInto(metric_map, pose);
  }
}

void CMetricMapBuilderLIO::processActionObservation(
    mrpt::obs::CActionCollection& /*action*/, mrpt::obs::CSensoryFrame& observations)
{
  for (const auto& observation : observations)
    processObservation(observation);
}

void CMetricMapBuilderLIO::processObservation(const CObservation::Ptr& observation)
{
  if (!observation) return;
  const std::lock_guard lock(mutex_);
  odometry_.onNewObservation(observation);
  placeOrigin();
  if (!options.enableMapUpdating) return;
  if (auto scan = odometry_.decode(*observation))
  {
    waiting_.push_back({observation, std::move(*scan)});
    if (waiting_.size() > kMostWaiting) waiting_.pop_front();  // no pose in sight
  }
  takeKeyFrames();
}

/** The first pose locates the odometry's world: the vehicle starts at T_map_start_. */
void CMetricMapBuilderLIO::placeOrigin()
{
  const auto& poses = odometry_.track().poses();
  if (T_map_world_ || poses.empty()) return;
  const Pose& T_world_vehicle = poses.front().T_world_body;
  Pose T_world_ground = toPose(mrpt::poses::CPose3D(onGround(T_world_vehicle)));
  T_world_ground.p.z() = T_world_vehicle.p.z();
  T_map_world_ = T_map_start_ * T_world_ground.inverse();
}

/** The pose at a scan's stamp is known when the next scan has been processed. */
void CMetricMapBuilderLIO::takeKeyFrames()
{
  const auto& poses = odometry_.track().poses();
  while (!waiting_.empty() && !poses.empty())
  {
    const LidarScan& next = waiting_.front().scan;
    const std::int64_t stamp_ns = odometry_.poseTimeOf(next.stamp_ns);
    if (spanOf(next).end_ns + stamp_ns - next.stamp_ns > poses.back().stamp_ns) return;
    Waiting waiting = std::move(waiting_.front());
    waiting_.pop_front();
    waiting.scan.stamp_ns = stamp_ns;
    const auto pose = odometry_.track().at(waiting.scan.stamp_ns);
    if (pose && rule_.accept(pose->T_world_body)) addKeyFrame(waiting, *pose);
  }
}

void CMetricMapBuilderLIO::addKeyFrame(const Waiting& waiting, const TrackedPose& pose)
{
  const TrackedPose in_map = fromStart(pose);
  insertScan(waiting.scan, pose, in_map.T_world_body, metric_map_);
  auto frame = mrpt::obs::CSensoryFrame::Create();
  frame->insert(waiting.raw);
  insertView(frame, in_map, views_);
}

void CMetricMapBuilderLIO::insertScan(
    const LidarScan& scan, const TrackedPose& pose, const Pose& T_map_vehicle,
    mrpt::maps::CMultiMetricMap& metric_map) const
{
  const PoseTrack& track = odometry_.track();
  const Pose T_vehicle_lidar = mountingOn(track, scan);
  const auto cloud = compensatedCloud(scan, track, pose.T_world_body * T_vehicle_lidar);
  // MRPT 2.5 takes no notice of the robot's pose for this class, so the sensor's says it all.
  cloud->sensorPose = toMrptPose(T_map_vehicle * T_vehicle_lidar);
  // In use, not as given: the preset of the LiDAR may say how far it sees.
  const double max_range = odometry_.parameters().lidar.max_range;
  const auto planar = pseudo2dScan(scan, track, config_.exporters, max_range);
  const mrpt::poses::CPose3D ground(onGround(T_map_vehicle));
  for (auto& map : metric_map.maps)
    if (!map->insertObservation(*cloud, mrpt::poses::CPose3D()) && planar)
      map->insertObservation(*planar, ground);
}

void CMetricMapBuilderLIO::insertView(
    const mrpt::obs::CSensoryFrame::Ptr& frame, const TrackedPose& in_map,
    mrpt::maps::CSimpleMap& views) const
{
  const Vec3& v = in_map.velocity;
  const Vec3& w = in_map.angular_velocity;
  insertKeyFrame(
      views, toMrptPdf(in_map.T_world_body, in_map.covariance), frame,
      {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()});
}

void CMetricMapBuilderLIO::rebuild(
    const Correction& correction, mrpt::maps::CSimpleMap& views,
    mrpt::maps::CMultiMetricMap& metric_map) const
{
  views = views_;
  while (views.size() > initial_views_)
    views.remove(views.size() - 1);
  metric_map.setListOfMaps(definitions_);
  insertInitialViews(metric_map);
  for (std::size_t i = initial_views_; i < views_.size(); ++i)
  {
    const KeyFrameView view = keyFrame(views_, i);
    // Decoded again: with the raw data alone, a key frame needs half the memory.
    const CObservation::Ptr& raw = *view.frame->begin();
    auto scan = odometry_.decode(*raw);
    if (!scan) continue;
    scan->stamp_ns = odometry_.poseTimeOf(scan->stamp_ns);
    const auto pose = odometry_.track().at(scan->stamp_ns);
    if (!pose) continue;
    const TrackedPose in_map = fromStart(correction(*pose));
    insertScan(*scan, *pose, in_map.T_world_body, metric_map);
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(raw);
    insertView(frame, in_map, views);
  }
}

TrackedPose CMetricMapBuilderLIO::fromStart(const TrackedPose& pose) const
{
  TrackedPose moved = pose;
  const Pose T_map_world = T_map_world_.value_or(Pose{});
  moved.T_world_body = T_map_world * pose.T_world_body;
  moved.covariance = withPositionTurned(T_map_world.R, pose.covariance);
  return moved;
}

mrpt::poses::CPose3DPDF::Ptr CMetricMapBuilderLIO::getCurrentPoseEstimation() const
{
  const std::lock_guard lock(mutex_);
  const auto& poses = odometry_.track().poses();
  TrackedPose pose;
  pose.T_world_body = T_map_start_;
  if (!poses.empty()) pose = fromStart(poses.back());
  return mrpt::poses::CPose3DPDFGaussian::Create(toMrptPdf(pose.T_world_body, pose.covariance));
}

void CMetricMapBuilderLIO::getCurrentlyBuiltMap(mrpt::maps::CSimpleMap& out_map) const
{
  const std::lock_guard lock(mutex_);
  out_map = views_;
}

unsigned int CMetricMapBuilderLIO::getCurrentlyBuiltMapSize()
{
  const std::lock_guard lock(mutex_);
  return static_cast<unsigned int>(views_.size());
}

MetricMapOfBuilder CMetricMapBuilderLIO::getCurrentlyBuiltMetricMap() const
{
  return asBuiltMap<MetricMapOfBuilder>(metric_map_);
}

void CMetricMapBuilderLIO::saveCurrentEstimationToImage(
    const std::string& file, bool /*formatEMF_BMP*/)
{
  const std::lock_guard lock(mutex_);
  metric_map_.saveMetricMapRepresentationToFile(file);
}

}  // namespace fastlio
