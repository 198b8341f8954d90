// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file odometry_options.h What configures the estimator, with defaults. Names of members equal
 * the YAML keys (group.key); odometry_option_table.h has unit, range and effect of those that a
 * user may set. The members without a row there are constants of the method, which only tests
 * change. */
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
  InitializationMode mode = InitializationMode::Rest;
  double duration = 2.0;                       //!< resting time that is averaged [s]
  double max_gyro_std = 0.10471975511965978;   //!< above: no rest [rad/s]; 6 deg/s
  double max_accel_std = 1.0;                  //!< above: the platform does not rest [m/s^2]
  double max_gyro_mean = 0.20943951023931956;  //!< above: no rest [rad/s]; 12 deg/s
  double gravity = 9.81;                       //!< |g| [m/s^2]
  double gravity_std = 0.02;                   //!< how well |g| is known [m/s^2]
  double max_gravity_error = 1.0;     //!< largest |mean specific force| - |g| taken as rest [m/s^2]
  double gyro_bias_std = 1e-5;        //!< added to the uncertainty of the averaged bias [rad/s]
  double accel_bias_std = 0.1;        //!< prior of the accelerometer bias, zero mean [m/s^2]
  double velocity_std = 1e-3;         //!< uncertainty of rest [m/s]
  double motion_duration = 1.0;       //!< scans that a start in motion looks at [s]
  int motion_points = 10000;          //!< of the downsampling, for these scans
  double motion_velocity_std = 10.0;  //!< prior of the velocity in motion, zero mean [m/s]
  double motion_gyro_bias_std =
      0.017453292519943295;              //!< prior of the gyro bias in motion, zero mean [rad/s]
  double motion_max_velocity_std = 0.5;  //!< a start in motion knows its velocity so well [m/s]
  double pose_position_std = 0.5;        //!< of a start in a given map [m]
  double pose_yaw_std = 0.08726646259971648;    //!< the same [rad]; 5 deg
  double pose_tilt_std = 0.008726646259971648;  //!< of the map's vertical [rad]; 0.5 deg
  double map_share = 0.5;          //!< fraction of the points that must match a given map at first
  bool align_with_gravity = true;  //!< world z axis up; false: world = first IMU frame (paper)
};

/** Group `calibration`: what the filter estimates about the LiDAR along the way. */
struct CalibrationOptions
{
  bool estimate_extrinsic = false;
  double extrinsic_rotation_std = 0.017453292519943295;  //!< of the given one [rad] (YAML: deg)
  double extrinsic_translation_std = 0.05;               //!< of the given one [m]
  bool estimate_time_offset = true;
  double time_offset_std = 0.003;      //!< of the given lidar.time_offset [s]
  double time_offset_min_share = 0.3;  //!< of a scan's points that match, to begin with it
};

/** Group `measurement`. */
struct MeasurementOptions
{
  double range_noise = 0.02;             //!< standard deviation of a range [m]
  double max_normalized_residual = 3.0;  //!< gate, in standard deviations of residual and prior
  int min_effective_points = 20;         //!< fewer matches: the scan is not used
  int association_iterations = 2;        //!< iterations that search the map anew
  double min_signal_to_noise = 10.0;     //!< less: a direction is left alone; 0: never
  double max_unaided_time = 3.0;         //!< longer without an update: the pose is not trusted [s]
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
  double max_insertion_std = 0.2;  //!< a scan without matches joins below this position error [m]
  double min_spacing = 0.4;        //!< knn: nearer points are not added [m]
  double voxel_size = 0.4;         //!< planes: edge of the finest voxels [m]
  double min_incidence = 0.1;      //!< planes: least cosine between normal and mean beam
  double max_thickness = 0.1;      //!< planes: largest standard deviation across a plane [m]
};

/** Group `health`: limits beyond which a scan is in trouble. */
struct HealthOptions
{
  double min_share = 0.2;        //!< of the fraction of the points that matched the map before
  double max_innovation = 3.0;   //!< mean of z^2/r
  double min_information = 100;  //!< smallest eigenvalue of H^T R^-1 H
  double max_inflated = 0.25;    //!< fraction of the time that the inertial data are in doubt
  double max_gyro_bias = 0.17453292519943295;  //!< [rad/s]; 10 deg/s
  double max_accel_bias = 2.0;                 //!< [m/s^2]
  double max_scan_interval = 0.5;              //!< from scan to scan [s]
  bool freeze_map = true;  //!< scans that match too badly do not join the map, nor count as updates
};

/** Group `recovery`: the pose is lost, or the inertial data were interrupted. */
struct RecoveryOptions
{
  bool enabled = true;
  double patience = 1.0;    //!< scans that match nothing for so long after max_unaided_time [s]
  double match_time = 1.5;  //!< after a new start the old map is looked for so long [s]
  double max_heading = 1.5707963267948966;  //!< headings are tried up to here [rad]; 90 deg
  double min_share = 0.3;                //!< of the points match, when the old map is found again
  double accel_std = 1.0;                //!< of the motion while nothing was measured [m/s^2]
  double gyro_std = 0.3490658503988659;  //!< of the rotation meanwhile [rad/s]; 20 deg/s
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
  HealthOptions health;
  RecoveryOptions recovery;
  bool imu_rate = false;  //!< states between scans, at each inertial sample (output.imu_rate)
  GainForm gain = GainForm::Information;
  int threads = 0;  //!< worker threads; 0 = all cores
};

}  // namespace fastlio
