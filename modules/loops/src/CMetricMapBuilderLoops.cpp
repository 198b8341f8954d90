// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/loops/CMetricMapBuilderLoops.h>
#include <fastlio/odometry/odometry.h>
#include <fastlio/run/mrpt_poses.h>
#include <fastlio/run/pose_output.h>

namespace fastlio
{
CMetricMapBuilderLoops::CMetricMapBuilderLoops(
    const Config& config, const mrpt::maps::TSetOfMetricMapInitializers& maps,
    const ClosureLimits& limits)
    : CMetricMapBuilderLIO(config, maps), limits_(limits), submaps_(0), mapper_(limits)
{
  driver().setCallback([this](const OdometryEstimate& estimate) { takeScan(estimate); });
  driver().setSampleCallback(
      [this](const ImuSample& sample)
      {
        if (options.enableMapUpdating) submaps_->addImu(sample);
      });
}

CMetricMapBuilderLoops::~CMetricMapBuilderLoops() = default;

void CMetricMapBuilderLoops::initialize(
    const mrpt::maps::CSimpleMap& initialMap, const mrpt::poses::CPosePDF* x0)
{
  const std::lock_guard lock(mutex());
  CMetricMapBuilderLIO::initialize(initialMap, x0);
  submaps_.emplace(0);
  mapper_.emplace(limits_);
  corrected_ = {};
}

void CMetricMapBuilderLoops::takeScan(const OdometryEstimate& estimate)
{
  if (!options.enableMapUpdating) return;
  const ScanResult& scan = estimate.result;
  const Odometry& odometry = driver().estimator();
  if (auto submap = submaps_->add(scan, odometry.registeredPoints(), odometry.mapOrigin()))
    mapper_->add(std::move(*submap));
}

/** The trajectory with all closures up to now; null: there are none. */
const CorrectedTrajectory* CMetricMapBuilderLoops::updatedTrajectory() const
{
  if (mapper_->accepted() == 0) return nullptr;
  const std::size_t submaps = mapper_->submaps().size();
  if (!corrected_.trajectory || corrected_.submaps != submaps)
  {
    corrected_.trajectory.emplace(mapper_->result(), 0);
    corrected_.submaps = submaps;
    corrected_.scans = 0;
  }
  return &*corrected_.trajectory;
}

TrackedPose CMetricMapBuilderLoops::correctedPose(
    const CorrectedTrajectory& trajectory, const TrackedPose& vehicle) const
{
  const Pose T_imu_vehicle = odometry().track().frame().T_imu_body;
  const Pose T_vehicle_imu = T_imu_vehicle.inverse();
  const auto ofImu = [&](const Matrix6& covariance)
  { return poseEstimateOf(vehicle.T_world_body, covariance, T_vehicle_imu).covariance; };
  ScanResult imu;
  imu.status = ScanStatus::Tracking;
  imu.stamp_ns = vehicle.stamp_ns;
  const Pose T_world_imu = vehicle.T_world_body * T_vehicle_imu;
  imu.filter.x.R = T_world_imu.R;
  imu.filter.x.p = T_world_imu.p;
  imu.filter.P.topLeftCorner<6, 6>() = ofImu(vehicle.covariance);
  imu.map_covariance = ofImu(vehicle.map_covariance);
  imu.ambiguity_covariance = ofImu(vehicle.ambiguity_covariance);
  imu.pose_by_beams = ofOtherBody(vehicle.pose_by_beams, vehicle.T_world_body, T_world_imu);
  const PoseEstimate estimate = poseEstimateOf(trajectory.corrected(imu).filter, T_imu_vehicle);
  TrackedPose corrected = vehicle;
  corrected.T_world_body = estimate.T_world_body;
  corrected.covariance = corrected.map_covariance = estimate.covariance;
  corrected.pose_by_beams.setZero();
  corrected.ambiguity_covariance.setZero();
  return corrected;
}

/** Makes the corrected maps. \return false: nothing is corrected */
bool CMetricMapBuilderLoops::updateMaps() const
{
  const CorrectedTrajectory* trajectory = updatedTrajectory();
  if (trajectory == nullptr) return false;
  const std::size_t scans = keyFrames();
  if (corrected_.scans == scans) return true;
  rebuild(
      [&](const TrackedPose& pose) { return correctedPose(*trajectory, pose); }, corrected_.views,
      corrected_.metric_map);
  corrected_.scans = scans;
  return true;
}

mrpt::poses::CPose3DPDF::Ptr CMetricMapBuilderLoops::getCurrentPoseEstimation() const
{
  const std::lock_guard lock(mutex());
  const auto& poses = odometry().track().poses();
  const CorrectedTrajectory* trajectory = poses.empty() ? nullptr : updatedTrajectory();
  if (trajectory == nullptr) return CMetricMapBuilderLIO::getCurrentPoseEstimation();
  const TrackedPose pose = fromStart(correctedPose(*trajectory, poses.back()));
  return mrpt::poses::CPose3DPDFGaussian::Create(toMrptPdf(pose.T_world_body, pose.covariance));
}

void CMetricMapBuilderLoops::getCurrentlyBuiltMap(mrpt::maps::CSimpleMap& out_map) const
{
  const std::lock_guard lock(mutex());
  if (updateMaps())
    out_map = corrected_.views;
  else
    CMetricMapBuilderLIO::getCurrentlyBuiltMap(out_map);
}

MetricMapOfBuilder CMetricMapBuilderLoops::getCurrentlyBuiltMetricMap() const
{
  const std::lock_guard lock(mutex());
  if (updateMaps()) return asBuiltMap<MetricMapOfBuilder>(corrected_.metric_map);
  return CMetricMapBuilderLIO::getCurrentlyBuiltMetricMap();
}

void CMetricMapBuilderLoops::saveCurrentEstimationToImage(
    const std::string& file, bool formatEMF_BMP)
{
  const std::lock_guard lock(mutex());
  if (updateMaps())
    corrected_.metric_map.saveMetricMapRepresentationToFile(file);
  else
    CMetricMapBuilderLIO::saveCurrentEstimationToImage(file, formatEMF_BMP);
}

MappingResult CMetricMapBuilderLoops::mapping() const
{
  const std::lock_guard lock(mutex());
  return mapper_->result();
}

std::size_t CMetricMapBuilderLoops::closures() const
{
  const std::lock_guard lock(mutex());
  return mapper_->accepted();
}

}  // namespace fastlio
