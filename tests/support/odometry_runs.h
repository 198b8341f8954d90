// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file odometry_runs.h Runs of the odometry over recordings, and comparisons of their results. */
#pragma once

#include "room_recording.h"
#include <fastlio/odometry/odometry.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace fastlio::testing
{
using Results = std::vector<ScanResult>;

inline void drain(Odometry& odometry, Results& results)
{
  while (auto result = odometry.next())
    results.push_back(std::move(*result));
}

inline void finish(Odometry& odometry, Results& results)
{
  while (auto result = odometry.flush())
    results.push_back(std::move(*result));
}

/** Feeds a recording in the order of time, a scan when its last point has been measured. The scans
 * go to the odometry. */
inline Results runInOrder(Odometry& odometry, RoomRecording&& recording)
{
  Results results;
  std::size_t next_sample = 0;
  for (LidarScan& scan : recording.scans)
  {
    const std::int64_t end_ns = spanOf(scan).end_ns;
    for (; next_sample < recording.imu.size() && recording.imu[next_sample].stamp_ns <= end_ns;
         ++next_sample)
      odometry.addImu(recording.imu[next_sample]);
    odometry.addScan(std::move(scan));
    drain(odometry, results);
  }
  for (; next_sample < recording.imu.size(); ++next_sample)
    odometry.addImu(recording.imu[next_sample]);
  finish(odometry, results);
  return results;
}

inline Results runInOrder(Odometry& odometry, const RoomRecording& recording)
{
  return runInOrder(odometry, RoomRecording(recording));
}

inline Results runInOrder(const OdometryOptions& parameters, const RoomRecording& recording)
{
  Odometry odometry(parameters);
  return runInOrder(odometry, recording);
}

inline bool sameBits(const FilterState& a, const FilterState& b)
{
  return a.x.R == b.x.R && a.x.p == b.x.p && a.x.v == b.x.v && a.x.gyro_bias == b.x.gyro_bias &&
         a.x.accel_bias == b.x.accel_bias && a.x.g == b.x.g && a.P == b.P;
}

/** Equal in all but the timings. */
inline bool sameBits(const ScanResult& a, const ScanResult& b)
{
  const ScanStatistics &s = a.statistics, &t = b.statistics;
  return a.stamp_ns == b.stamp_ns && a.begin_ns == b.begin_ns && a.status == b.status &&
         a.message == b.message && sameBits(a.filter, b.filter) &&
         s.points_effective == t.points_effective && s.points_downsampled == t.points_downsampled &&
         s.iterations == t.iterations && s.imu_samples == t.imu_samples &&
         s.map_points == t.map_points && s.residual_rms == t.residual_rms;
}

inline bool sameBits(const Results& a, const Results& b)
{
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(),
      [](const ScanResult& r, const ScanResult& s) { return sameBits(r, s); });
}

/** Pose minus truth of a result. The accelerometer's bias tilts the odometry's world by a few
 * milliradians, from the start on and for good; that is no error of its poses in that world, so
 * that the truth is taken relative to the first one. */
struct PoseError
{
  Vec3 position = Vec3::Zero();  //!< [m]
  Vec3 attitude = Vec3::Zero();  //!< [rad]
};

inline std::vector<PoseError> poseErrors(const Results& results, const RoomRecording& recording)
{
  std::vector<PoseError> errors;
  Pose T_world_truth;
  for (const ScanResult& r : results)
  {
    if (r.status == ScanStatus::Initializing) continue;
    const Pose truth = recording.truthAt(r.stamp_ns);
    if (errors.empty()) T_world_truth = r.filter.x.pose() * truth.inverse();
    const Pose expected = T_world_truth * truth;
    errors.push_back({r.filter.x.p - expected.p, logSO3(expected.R.transpose() * r.filter.x.R)});
  }
  return errors;
}

struct WorstPoseErrors
{
  double position = 0.0;  //!< [m]
  double attitude = 0.0;  //!< [rad]
};

inline WorstPoseErrors worstPoseErrors(const Results& results, const RoomRecording& recording)
{
  WorstPoseErrors worst;
  for (const PoseError& e : poseErrors(results, recording))
  {
    worst.position = std::max(worst.position, e.position.norm());
    worst.attitude = std::max(worst.attitude, e.attitude.norm());
  }
  return worst;
}

inline std::size_t countOf(const Results& results, ScanStatus status)
{
  return static_cast<std::size_t>(std::count_if(
      results.begin(), results.end(), [&](const ScanResult& r) { return r.status == status; }));
}

/** Every scan that went in came out as a result or was counted as dropped. */
inline std::size_t accountedScans(const Odometry& odometry, const Results& results)
{
  const InputStatistics& s = odometry.inputStatistics();
  return results.size() + s.scans_empty + s.scans_out_of_order + s.scans_without_imu;
}

}  // namespace fastlio::testing
