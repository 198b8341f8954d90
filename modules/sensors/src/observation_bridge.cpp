// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/columns.h>
#include <fastlio/math/time.h>
#include <fastlio/sensors/conversions.h>
#include <fastlio/sensors/imu_conversion.h>
#include <fastlio/sensors/observation_bridge.h>
#include <fastlio/sensors/point_cloud_conversion.h>
#include <fastlio/sensors/rotating_scan.h>
#include <fastlio/sensors/velodyne_decoder.h>

#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/rtti/CObject.h>

#include <new>
#include <stdexcept>

namespace
{
using namespace fastlio;
using mrpt::obs::CObservation;
using mrpt::obs::CObservationPointCloud;
using mrpt::obs::CObservationVelodyneScan;

bool isFrom(const CObservation& observation, const SensorSummary& sensor)
{
  return observation.sensorLabel == sensor.label &&
         observation.GetRuntimeClass()->className == sensor.class_name;
}

// Some recorders drop the packets and keep the points that MRPT made of them.
CloudColumns cachedPoints(const CObservationVelodyneScan& observation)
{
  const auto& cached = observation.point_cloud;
  const std::size_t n = cached.size();
  CloudColumns columns{cached.x, cached.y, cached.z, {}, {}, {}, false};
  if (cached.y.size() != n || cached.z.size() != n)
    throw std::runtime_error("the cached points of the observation are corrupt");
  if (cached.intensity.size() == n)
    columns.intensity.assign(cached.intensity.begin(), cached.intensity.end());
  if (cached.laser_id.size() == n)
    columns.ring.assign(cached.laser_id.begin(), cached.laser_id.end());
  if (cached.timestamp.size() != n) return columns;
  const std::int64_t stamp_ns = toNanoseconds(observation.timestamp);
  for (const auto& time : cached.timestamp)
    columns.time.push_back(toSeconds(toNanoseconds(time) - stamp_ns));
  return columns;
}

LidarScan fromPackets(const CObservationVelodyneScan& observation, BridgeStatistics& statistics)
{
  VelodyneSweep sweep = decodeVelodyne(observation);
  const VelodyneDecodeCounts& counts = sweep.counts;
  statistics.points_no_return += counts.no_return;
  statistics.points_out_of_range += counts.out_of_range;
  statistics.points_duplicate += counts.duplicate;
  statistics.packet_blocks_corrupt += counts.bad_blocks;
  statistics.packet_times_corrupt += counts.bad_packet_times;
  LidarScan scan;
  scan.points = std::move(sweep.points);
  scan.dropped_invalid = counts.no_return + counts.out_of_range;
  return scan;
}

LidarScan fromCloud(
    CloudColumns columns, std::int64_t stamp_ns, const CloudTiming& timing,
    BridgeStatistics& statistics)
{
  CloudConversion cloud = toTimedPoints(std::move(columns), stamp_ns, timing);
  statistics.points_invalid += cloud.dropped_invalid;
  LidarScan scan;
  scan.has_point_times =
      cloud.times == PointTimes::PerPoint || cloud.times == PointTimes::Synthetic;
  if (cloud.times == PointTimes::Synthetic) ++statistics.scans_synthetic_point_times;
  if (!scan.has_point_times) ++statistics.scans_without_point_times;
  if (cloud.times == PointTimes::Unusable) ++statistics.scans_unusable_point_times;
  scan.points = std::move(cloud.points);
  scan.dropped_invalid = cloud.dropped_invalid;
  return scan;
}

LidarScan fromRotatingScan(
    const mrpt::obs::CObservationRotatingScan& observation, const CloudTiming& timing,
    BridgeStatistics& statistics)
{
  RotatingScanPoints rotating = pointsOf(observation);
  statistics.points_no_return += rotating.no_return;
  statistics.points_out_of_range += rotating.out_of_range;
  if (!rotating.has_point_times && timing.sweep)
  {
    assignSweepTimes(rotating.points, *timing.sweep);
    rotating.has_point_times = true;
    ++statistics.scans_synthetic_point_times;
  }
  if (!rotating.has_point_times) ++statistics.scans_without_point_times;
  LidarScan scan;
  scan.points = std::move(rotating.points);
  scan.dropped_invalid = rotating.no_return + rotating.out_of_range;
  scan.has_point_times = rotating.has_point_times;
  return scan;
}

LidarScan toScan(
    const CObservation& observation, const CloudTiming& timing, BridgeStatistics& statistics)
{
  const std::int64_t stamp_ns = toNanoseconds(observation.timestamp);
  if (const auto* velodyne = dynamic_cast<const CObservationVelodyneScan*>(&observation))
  {
    if (!velodyne->scan_packets.empty()) return fromPackets(*velodyne, statistics);
    // Its stamps are dates already, whatever the clouds of a recording have.
    const CloudTiming own{PointTimeReading{}, timing.sweep};
    return fromCloud(cachedPoints(*velodyne), stamp_ns, own, statistics);
  }
  if (const auto* rotating = dynamic_cast<const mrpt::obs::CObservationRotatingScan*>(&observation))
    return fromRotatingScan(*rotating, timing, statistics);
  const auto* cloud = dynamic_cast<const CObservationPointCloud*>(&observation);
  if (cloud == nullptr)
    throw std::runtime_error(
        std::string("class ") + observation.GetRuntimeClass()->className +
        " is not supported as a LiDAR");
  if (!cloud->pointcloud) throw std::runtime_error("the observation holds no point cloud");
  return fromCloud(readColumns(*cloud->pointcloud), stamp_ns, timing, statistics);
}

void dropNear(LidarScan& scan, double min_range)
{
  const PointColumns all = std::move(scan.points);
  scan.points = {};
  scan.points.reserve(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    if (pointAt(all, i).norm() >= min_range)
      scan.points.push_back(
          all.x[i], all.y[i], all.z[i], all.intensity[i], all.time_offset_ns[i], all.ring[i]);
}

}  // namespace

namespace fastlio
{
ObservationBridge::ObservationBridge(SensorSelection selection, const BridgeOptions& options)
    : selection_(std::move(selection)),
      lidars_(options.lidars),
      further_min_range_(options.further_min_range),
      T_vehicle_imu_(options.T_vehicle_imu.value_or(selection_.imu.T_vehicle_sensor))
{
  lidars_.resize(1 + selection_.further_lidars.size());
}

std::optional<std::size_t> ObservationBridge::lidarOf(const CObservation& observation) const
{
  if (isFrom(observation, selection_.lidar)) return 0;
  for (std::size_t i = 0; i < selection_.further_lidars.size(); ++i)
    if (isFrom(observation, selection_.further_lidars[i])) return i + 1;
  return std::nullopt;
}

BridgeOutput ObservationBridge::convert(const CObservation& observation)
{
  if (isFrom(observation, selection_.imu)) return convertImu(observation);
  if (const auto lidar = lidarOf(observation)) return convertScan(observation, *lidar);
  ++statistics_.other_sensors;
  return std::monostate{};
}

BridgeOutput ObservationBridge::convertImu(const CObservation& observation)
{
  const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation);
  const ImuConversion conversion = imu == nullptr ? ImuConversion{} : toImuSample(*imu);
  switch (conversion.defect)
  {
    case ImuDefect::None:
      break;
    case ImuDefect::NoAcceleration:
      ++statistics_.imu_no_acceleration;
      break;
    case ImuDefect::NoAngularRate:
      ++statistics_.imu_no_angular_rate;
      break;
    case ImuDefect::NotFinite:
      ++statistics_.imu_not_finite;
      break;
    case ImuDefect::NoStamp:
      ++statistics_.imu_no_stamp;
      break;
  }
  if (!conversion.sample) return std::monostate{};
  ++statistics_.imu_converted;
  return *conversion.sample;
}

BridgeOutput ObservationBridge::convertScan(const CObservation& observation, std::size_t lidar)
{
  const LidarConversion& options = lidars_[lidar];
  if (observation.timestamp == INVALID_TIMESTAMP)
  {
    ++statistics_.scans_no_stamp;
    return std::monostate{};
  }
  try
  {
    const Pose T_imu_lidar = extrinsicOf(observation, options);
    LidarScan scan = toScan(observation, options.timing, statistics_);
    scan.stamp_ns = toNanoseconds(observation.timestamp) + options.stamp_shift_ns;
    scan.T_imu_lidar = T_imu_lidar;
    // In a merged scan distances are those to the first LiDAR.
    if (lidar > 0) dropNear(scan, further_min_range_);
    ++statistics_.scans_converted;
    statistics_.points_converted += scan.points.size();
    if (lidar > 0) statistics_.points_of_further += scan.points.size();
    return scan;
  }
  catch (const std::bad_alloc&)
  {
    throw;  // no fault of the scan: it must not go missing in silence
  }
  catch (const std::exception& e)
  {
    ++statistics_.scans_unreadable;
    statistics_.last_error = e.what();
    return std::monostate{};
  }
}

Pose ObservationBridge::extrinsicOf(
    const CObservation& observation, const LidarConversion& lidar) const
{
  if (lidar.T_imu_lidar) return *lidar.T_imu_lidar;
  mrpt::poses::CPose3D T_vehicle_lidar;
  observation.getSensorPose(T_vehicle_lidar);
  Pose T_imu_lidar = T_vehicle_imu_.inverse() * toPose(T_vehicle_lidar);
  if (!T_imu_lidar.R.allFinite() || !T_imu_lidar.p.allFinite())
    throw std::runtime_error(
        "the pose of the LiDAR or of the IMU holds numbers that are not finite");
  return T_imu_lidar;
}

}  // namespace fastlio
