// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file submap.h A stretch of a run as planes in the frame of its first scan: what a pose graph
 * moves as a whole. */
#pragma once

#include <fastlio/interface/scan_result.h>
#include <fastlio/map/surface_map.h>
#include <fastlio/run/pose_track.h>
#include <fastlio/submaps/gravity_reading.h>
#include <fastlio/submaps/submap_store.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace fastlio
{
class VoxelPlaneMap;

/** The surfaces that the scans of a stretch saw. */
struct Submap
{
  std::size_t session = 0;  //!< which run
  /** Of the IMU at the first scan, as the odometry has it; covariances without what a wrong
   * calibration makes of all poses alike. */
  TrackedPose reference;
  /** How far the reference is off as seen from the surfaces: attitude and position in its frame.
   * The first scan by itself is known less well than the surfaces of all scans, above all while a
   * run begins. */
  Matrix6 reference_covariance = Matrix6::Zero();
  std::optional<GravityReading> gravity;  //!< over the stretch, in the frame of the reference
  std::int64_t last_ns = 0;               //!< end of the last scan
  double travel = 0.0;                    //!< of the run, up to the reference [m]
  double range = 0.0;                     //!< median, of the first scan [m]
  std::size_t scans = 0;
  PoseByCalibrationErrors pose_by_calibration = PoseByCalibrationErrors::Zero();  //!< reference
  /** Second moment of the errors of the calibration, as known by the last scan. */
  CalibrationMoment calibration_moment = CalibrationMoment::Zero();
  StoredSurfaces surfaces;  //!< in the frame of the reference
};

/** When a submap ends. */
struct SubmapRule
{
  /** After so much travel [m]; 0: half of the median range of its first scan, 3 to 12 m. */
  double length = 0.0;
  double turn = 1.5707963267948966;  //!< or when the sensor has turned so much [rad]
  std::size_t least_scans = 5;       //!< but not with fewer scans
};

/** Cuts a run into submaps. */
class SubmapBuilder
{
 public:
  /** \param store holds the surfaces of the submaps */
  explicit SubmapBuilder(
      std::size_t session, SubmapRule rule = {},
      std::shared_ptr<SubmapStore> store = std::make_shared<SubmapStore>());
  ~SubmapBuilder();
  SubmapBuilder(SubmapBuilder&&) noexcept;
  SubmapBuilder& operator=(SubmapBuilder&&) noexcept;

  /** Takes a sample of the IMU, in time order; they measure gravity. */
  void addImu(const ImuSample& sample) { gravity_.addImu(sample); }

  /** Takes one scan, in time order; those without a pose are left out.
   * \param registered its points in the world, counted from \a origin
   * \return a submap that has ended before this scan */
  [[nodiscard]] std::optional<Submap> add(
      const ScanResult& result, const WorldPoints& registered, const Vec3& origin);

  /** The last one. */
  [[nodiscard]] std::optional<Submap> finish();

 private:
  void begin(const TrackedPose& pose, const WorldPoints& registered, const Vec3& origin);
  void addToReference(const TrackedPose& pose);

  std::size_t session_;
  SubmapRule rule_;
  std::shared_ptr<SubmapStore> store_;
  double length_ = 0.0;  //!< of the current one [m]
  double travel_ = 0.0;  //!< of the run [m]
  Submap current_;
  TrackedPose last_;
  std::unique_ptr<VoxelPlaneMap> surfaces_;  //!< of the current one
  WorldPoints local_;
  GravityMeter gravity_;
};

/** The pose of a scan with covariances that hold for a map of the LiDAR: without what a wrong
 * calibration makes of all poses alike. */
[[nodiscard]] TrackedPose mappingPoseOf(const ScanResult& result);

/** Points that count from an origin, after a motion: single precision only in the end. */
void moved(const WorldPoints& points, const Vec3& origin, const Pose& motion, WorldPoints& result);

}  // namespace fastlio
