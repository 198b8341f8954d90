// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

// What MOLA asks of the map: save it, load another one, find the vehicle in it.

#include "MolaLidarInertialOdometry.h"
#include <fastlio/files/gzip_file.h>
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/math/angles.h>
#include <fastlio/savedmaps/saved_map_file.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fastlio
{
#if FASTLIO_MOLA_HAS_MAP_SERVER
mola::MapServer::ReturnStatus MolaLidarInertialOdometry::map_save(const std::string& path)
{
  ReturnStatus status;
  try
  {
    SavedMap map;
    mrpt::maps::CSimplePointsMap::Ptr points;
    {
      const std::lock_guard lock(odometry_mutex_);
      map = odometry_.savedMap();
      if (!map.planes) points = odometry_.map();
    }
    if (map.empty()) throw std::runtime_error("there is no map yet");
    GzipFile file(path + ".metricmap");
    if (map.planes)
      mrpt::serialization::archiveFrom(file) << CVoxelPlanesMap(*map.planes);
    else
      mrpt::serialization::archiveFrom(file) << *points;
    file.commit();
    if (!map.origin.isZero())
      MRPT_LOG_WARN_STREAM(
          "the map in '" << path << ".metricmap' counts from " << map.origin.transpose() << " m");
    status.success = true;
  }
  catch (const std::exception& e)
  {
    status.error_message = e.what();
    MRPT_LOG_ERROR_STREAM("the map is not saved: " << e.what());
  }
  return status;
}

mola::MapServer::ReturnStatus MolaLidarInertialOdometry::map_load(const std::string& path)
{
  ReturnStatus status;
  try
  {
    SavedMap map = loadSavedMap(path + ".metricmap");
    const std::lock_guard lock(odometry_mutex_);
    VehicleGuess begin;
    begin.T_map_vehicle = map.T_map_imu;
    // Poses in the map of before are another trajectory, which is not lost.
    const std::string before = earlierTrajectoryPath();
    if (!odometry_.track().poses().empty()) writeTrajectory(before);
    odometry_.startIn(std::move(map), begin);
    ++loaded_maps_;
    keyframes_.beginFrame(loaded_maps_);
    status.success = true;
    MRPT_LOG_INFO_STREAM("goes on in the map '" << path << "'");
  }
  catch (const std::exception& e)
  {
    status.error_message = e.what();
    MRPT_LOG_ERROR_STREAM("the map is not loaded: " << e.what());
  }
  return status;
}

std::string MolaLidarInertialOdometry::earlierTrajectoryPath() const
{
  if (output_tum_path_.empty()) return {};
  const std::size_t name = output_tum_path_.find_last_of('/') + 1;  // 0 where there is no folder
  const std::size_t dot = output_tum_path_.find_last_of('.');
  const std::size_t end = dot == std::string::npos || dot <= name ? output_tum_path_.size() : dot;
  return output_tum_path_.substr(0, end) + "_" + std::to_string(loaded_maps_ + 1) +
         output_tum_path_.substr(end);
}
#endif

#if FASTLIO_MOLA_HAS_RELOCALIZATION
void MolaLidarInertialOdometry::relocalize_near_pose_pdf(
    const mrpt::poses::CPose3DPDFGaussian& pose)
{
  // Who points at a map does not do it better, and a search farther than that finds nothing.
  constexpr double kLeastPosition = 0.1, kMostPosition = 100.0;                  // [m]
  constexpr double kLeastYaw = 1.0 * kRadPerDeg, kMostYaw = 180.0 * kRadPerDeg;  // [rad]
  try
  {
    VehicleGuess guess;
    guess.T_map_vehicle = toPose(pose.mean);
    const double variance = std::max(pose.cov(0, 0), pose.cov(1, 1));
    guess.position_std = std::clamp(std::sqrt(variance), kLeastPosition, kMostPosition);
    guess.yaw_std = std::clamp(std::sqrt(pose.cov(3, 3)), kLeastYaw, kMostYaw);
    const std::lock_guard lock(odometry_mutex_);
    if (odometry_.relocalize(guess))
      MRPT_LOG_INFO_STREAM(
          "searches the vehicle near " << pose.mean << ", within " << guess.position_std << " m");
    else
      MRPT_LOG_ERROR_STREAM("nothing to search the vehicle in: there is no map yet");
  }
  catch (const std::exception& e)
  {
    MRPT_LOG_ERROR_STREAM("the vehicle is not searched: " << e.what());
  }
}

void MolaLidarInertialOdometry::relocalize_from_gnss()
{
  MRPT_LOG_ERROR_STREAM(
      "the odometry does not use GNSS: give it a pose instead (relocalize_near_pose_pdf)");
}
#endif

}  // namespace fastlio
