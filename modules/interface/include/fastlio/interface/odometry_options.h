// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file odometry_options.h Options of the estimator, with defaults. Names of members equal
 * the YAML keys (group.key); odometry_option_table.h has unit, range and effect of those that a
 * user may set. Constants of the method stand where they are used. */
#pragma once

#include <fastlio/filter/update.h>
#include <fastlio/imu/imu_options.h>
#include <fastlio/lidar/lidar_options.h>
#include <fastlio/math/pose.h>

namespace fastlio
{
/** How the filter gets its first state. */
enum class InitializationMode
{
  Rest,    //!< from a platform at rest
  Motion,  //!< from the first scans, in motion
  Auto     //!< at rest where the scans confirm it, else in motion
};

/** Group `initialization`. */
struct InitializationOptions
{
  InitializationMode mode = InitializationMode::Auto;
  double duration = 2.0;                       //!< resting time that is averaged [s]
  double max_gyro_std = 0.10471975511965978;   //!< above: no rest [rad/s]; 6 deg/s
  double max_accel_std = 1.0;                  //!< above: the platform does not rest [m/s^2]
  double max_gyro_mean = 0.20943951023931956;  //!< above: no rest [rad/s]; 12 deg/s
  double gravity = 9.81;                       //!< |g| [m/s^2]
  double max_gravity_error = 1.0;  //!< largest |mean specific force| - |g| taken as rest [m/s^2]
  double accel_bias_std = 0.1;     //!< prior of the accelerometer bias, zero mean [m/s^2]
  double motion_duration = 1.0;    //!< scans that a start in motion looks at [s]
  double motion_gyro_bias_std =
      0.017453292519943295;        //!< prior of the gyro bias in motion, zero mean [rad/s]
  double pose_position_std = 0.5;  //!< of a start in a given map [m]
  double pose_yaw_std = 0.08726646259971648;  //!< the same [rad]; 5 deg
  bool align_with_gravity = true;  //!< world z axis up; false: world = first IMU frame (paper)
};

/** Group `calibration`: what the filter estimates about the LiDAR along the way. */
struct CalibrationOptions
{
  bool estimate_extrinsic = false;
  double extrinsic_rotation_std = 0.0052359877559829881;  //!< of the given one [rad] (YAML: deg)
  double extrinsic_translation_std = 0.01;                //!< of the given one [m]
  double imu_scale_std = 0.005;                           //!< of gyro and accelerometer
  double imu_misalignment_std = 0.0034906585039886592;    //!< of their axes [rad] (YAML: deg)
  bool estimate_beams = true;  //!< offsets of the beams are taken off the scans
  bool estimate_time_offset = true;
  double time_offset_std = 0.003;  //!< of the given lidar.time_offset [s]
  /** How fast the clocks wander from each other [s/sqrt(s)]. Free quartz clocks drift by up to 50
   * us in a second, which the estimate follows. */
  double time_offset_walk = 5e-5;
};

/** Group `measurement`. */
struct MeasurementOptions
{
  double range_noise = 0.02;          //!< standard deviation of a range [m]
  double min_signal_to_noise = 10.0;  //!< less: a direction is left alone; 0: never
  double max_unaided_time = 3.0;      //!< longer without an update: the pose is not trusted [s]
};

/** Which map the scans are matched with. */
enum class MapType
{
  Planes,  //!< voxels at several scales, each with a ready plane: one lookup per scale
  Knn      //!< exact nearest points and a plane through them (paper), own incremental index
};

/** Group `map`. */
struct MapOptions
{
  MapType type = MapType::Planes;
  bool update = true;           //!< false: a given map stays as it is
  double output_spacing = 0.1;  //!< least distance between the points of the map that is saved [m]
  double radius = 150.0;        //!< points farther from the sensor than this may be dropped [m]
  double min_spacing = 0.4;     //!< knn: nearer points are not added [m]
  double voxel_size = 0.0;      //!< planes: edge of the finest voxels [m]; 0: voxelSize()
};

/** Edge of the finest voxels [m].
 * \param sparse_lines some lasers are several times as far apart as most, and their lines on the
 * ground metres apart: only a wide voxel holds two of them, which make a plane */
[[nodiscard]] inline double voxelSize(const MapOptions& options, bool sparse_lines)
{
  if (options.voxel_size > 0.0) return options.voxel_size;
  return sparse_lines ? 0.8 : 0.4;
}

/** Group `recovery`: the pose is lost, or the inertial data were interrupted. */
struct RecoveryOptions
{
  bool enabled = true;
};

/** Everything that configures an Odometry. */
struct OdometryOptions
{
  InitializationOptions initialization;
  ImuOptions imu;
  LidarOptions lidar;
  CalibrationOptions calibration;
  DownsamplingOptions downsampling;
  FeatureOptions features;
  MeasurementOptions measurement;
  MapOptions map;
  IterationLimits update;
  RestOptions rest;
  RecoveryOptions recovery;
  bool imu_rate = false;  //!< states between scans, at each inertial sample (output.imu_rate)
  GainForm gain = GainForm::Information;
  int threads = 0;  //!< worker threads; 0 = all cores
};

}  // namespace fastlio
