// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file parameters.h Every number that a user may change, with its default. Names equal the YAML
 * keys (group.key); unit, range and effect stand in the table of parameter_table.cpp. */
#pragma once

#include <fastlio/filter/gravity.h>
#include <fastlio/filter/imu.h>
#include <fastlio/filter/pose.h>
#include <fastlio/filter/update.h>
#include <fastlio/lidar/feature_lines.h>
#include <fastlio/lidar/point_time.h>
#include <fastlio/lidar/sweep_time.h>
#include <fastlio/odometry/imu_buffer.h>
#include <fastlio/odometry/imu_units.h>
#include <fastlio/odometry/robust_kernel.h>

#include <array>
#include <optional>
#include <string>

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
struct InitializationParameters
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
  int motion_points = 10000;          //!< of the reduction, for these scans
  double motion_velocity_std = 10.0;  //!< prior of the velocity in motion, zero mean [m/s]
  double motion_gyro_bias_std =
      0.017453292519943295;              //!< prior of the gyro bias in motion, zero mean [rad/s]
  double motion_max_velocity_std = 0.5;  //!< a start in motion knows its velocity so well [m/s]
  GravityModel gravity_model = GravityModel::Free;
  double pose_position_std = 0.5;               //!< of a start in a given map [m]
  double pose_yaw_std = 0.08726646259971648;    //!< the same [rad]; 5 deg
  double pose_tilt_std = 0.008726646259971648;  //!< of the map's vertical [rad]; 0.5 deg
  double map_share = 0.5;          //!< share of the points that must match a given map at first
  bool align_with_gravity = true;  //!< world z axis up; false: world = first IMU frame (paper)
};

/** Group `imu`. */
struct ImuParameters
{
  ImuNoise noise;
  ImuHold hold = ImuHold::Midpoint;  //!< how samples are held between their stamps
  double max_gap = 0.5;              //!< longer gaps between samples split the run [s]
  AccelUnit accel_unit = AccelUnit::Auto;
  GyroUnit gyro_unit = GyroUnit::Auto;
  bool invert_acceleration = false;          //!< the sensor gives gravity, not specific force
  double gyro_range = 0.0;                   //!< full scale [rad/s]; 0: found
  double accel_range = 0.0;                  //!< full scale [m/s^2]; 0: found
  double saturation_std = 0.5;               //!< of a clipped axis, share of the full scale
  double gap_periods = 4.0;                  //!< so many periods without a sample are a gap
  double gap_gyro_std = 0.5235987755982988;  //!< of the rate in a gap of max_gap [rad/s]; 30 deg/s
  double gap_accel_std = 2.0;                //!< of the force in a gap of max_gap [m/s^2]
  double spike_gyro = 10.471975511965978;    //!< a lone sample off by more is gated [rad/s]
  double spike_accel = 100.0;                //!< a lone sample off by more is gated [m/s^2]
};

/** Group `lidar`. */
struct LidarParameters
{
  double min_range = 0.5;     //!< nearer points are dropped [m]
  double max_range = 150.0;   //!< farther points are dropped [m]
  double max_waiting = 10.0;  //!< scans wait so long for inertial data, in the LiDAR's time [s]
  double time_offset = 0.0;   //!< added to the LiDAR stamps [s]
  bool deskew = true;         //!< motion compensation (eq. 9-10)
};

/** Group `calibration`: what the filter estimates about the LiDAR along the way. */
struct CalibrationParameters
{
  bool estimate_extrinsic = false;
  double extrinsic_rotation_std = 0.017453292519943295;  //!< of the given one [rad] (YAML: deg)
  double extrinsic_translation_std = 0.05;               //!< of the given one [m]
  bool estimate_time_offset = true;
  double time_offset_std = 0.003;      //!< of the given lidar.time_offset [s]
  double time_offset_min_share = 0.3;  //!< of a scan's points that match, to begin with it
};

/** Group `reduction`. */
struct ReductionParameters
{
  int target_points = 1500;  //!< about so many points of a scan are used; 0 = all
  double wide_range = 20.0;  //!< RMS range beyond which more points are used [m]
  int wide_points = 3000;    //!< but not more than so many
};

/** Which points of a scan are measurements. */
enum class FeatureMode
{
  None,          //!< direct: any point that finds a plane
  Planar,        //!< planar features
  PlanarAndEdge  //!< planar features, and edge features on lines (paper)
};

/** Group `features`. */
struct FeatureParameters
{
  FeatureMode mode = FeatureMode::None;
  ScanLineOrder scan_lines = ScanLineOrder::Automatic;  //!< what makes points neighbours
  double half_width = 0.25;                   //!< neighbours reach so far to each side [m]
  int min_neighbors = 3;                      //!< at least so many on each side
  double max_planar_smoothness = 0.2;         //!< planar below
  double min_edge_smoothness = 0.4;           //!< edge above
  double min_incidence = 0.3490658503988659;  //!< between surface and beam [rad] (YAML: deg)
  double max_beam_turn = 0.1;                 //!< largest smoothness of the line of unit beams
  double max_beam_gap = 0.03490658503988659;  //!< between neighbours [rad] (YAML: deg)
  double max_spacing = 1.0;                   //!< between neighbours [m]
  double range_jump = 0.1;                    //!< between neighbours, beyond min_incidence [m]
  int target_edges = 300;                     //!< about so many edge points are used; 0 = all
  double edge_spacing = 0.2;       //!< nearer points are not added to the map of edges [m]
  double max_edge_distance = 2.0;  //!< farthest neighbour on a line [m]
  double max_edge_scatter = 0.15;  //!< farthest neighbour from the line [m]
};

/** Group `measurement`. */
struct MeasurementParameters
{
  double range_noise = 0.02;             //!< standard deviation of a range [m]
  double max_normalized_residual = 3.0;  //!< gate, in standard deviations of residual and prior
  RobustKernel robust_kernel = RobustKernel::None;
  double robust_scale = 2.0;          //!< of the kernel, in standard deviations of the residual
  int min_effective_points = 20;      //!< fewer matches: the scan is not used
  int association_iterations = 2;     //!< iterations that search the map anew
  double min_signal_to_noise = 10.0;  //!< less: a direction is left alone; 0: never
  double max_unaided_time = 3.0;      //!< longer without an update: the pose is not trusted [s]
};

/** Which map the scans are matched with. */
enum class MapType
{
  Planes,  //!< voxels at several scales, each with a ready plane: one lookup per scale
  Knn,     //!< exact nearest points and a plane through them (paper), own incremental index
  KdTree   //!< the same through nanoflann, rebuilt for each scan: the reference, slow
};

/** Group `map`. */
struct MapParameters
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

/** Group `input`: which sensors of a recording are used, and where they are mounted. Not used by
 * Odometry itself but by whoever feeds it. */
struct InputParameters
{
  std::string lidar_sensor_label;       //!< regular expression; empty: found automatically
  std::string imu_sensor_label;         //!< regular expression; empty: found automatically
  std::optional<Pose> T_vehicle_imu;    //!< IMU in the vehicle frame, instead of the recording's
  std::optional<Pose> T_vehicle_lidar;  //!< LiDAR in the vehicle frame, instead of the recording's
  PointTimeUnit point_time_unit = PointTimeUnit::Auto;
  PointTimeReference point_time_reference = PointTimeReference::Auto;
  MissingPointTimes missing_point_times = MissingPointTimes::Auto;
  double sweep_start = 3.14159265358979323846;  //!< azimuth where a revolution begins [rad]
};

/** Groups `lidar_2`, `lidar_3`, `lidar_4`: LiDARs beside the first one; their points join its
 * scans.
 */
struct FurtherLidarParameters
{
  std::string sensor_label;             //!< regular expression; empty: there is none
  std::optional<Pose> T_vehicle_lidar;  //!< LiDAR in the vehicle frame, instead of the recording's
  double time_offset = 0.0;             //!< added to its stamps [s]
};

/** How many of them there may be. */
constexpr std::size_t kMostFurtherLidars = 3;

/** Group `rest`: standing still in the middle of a run. */
struct RestParameters
{
  bool at_start = true;                           //!< a start at rest goes on resting
  bool enabled = false;                           //!< detect rest, and then keep still
  double duration = 2.0;                          //!< quiet for so long is rest [s]
  double max_speed = 0.01;                        //!< trend of the positions since then [m/s]
  double max_velocity = 0.1;                      //!< of the filter, after a scan [m/s]
  double max_displacement = 0.03;                 //!< from where the quiet time began [m]
  double max_rotation = 0.008726646259971648;     //!< since then [rad]; 0.5 deg
  double max_rate_change = 0.008726646259971648;  //!< of the angular rate [rad/s]; 0.5 deg/s
  double max_accel_change = 0.1;                  //!< of the specific force [m/s^2]
  double velocity_std = 0.01;                     //!< of the pseudo-measurement v = 0 [m/s]
  double rate_std = 0.0008726646259971648;        //!< of w = gyro bias [rad/s]; 0.05 deg/s
  double map_time = 3.0;  //!< at rest for longer than this, scans do not join the map [s]
};

/** Group `health`: limits beyond which a scan is in trouble. */
struct HealthParameters
{
  double min_share = 0.2;        //!< of the share of the points that matched the map before
  double max_innovation = 3.0;   //!< mean of z^2/r
  double min_information = 100;  //!< smallest eigenvalue of H^T R^-1 H
  double max_doubtful = 0.25;    //!< share of the time that the inertial data are in doubt
  double max_gyro_bias = 0.17453292519943295;  //!< [rad/s]; 10 deg/s
  double max_accel_bias = 2.0;                 //!< [m/s^2]
  double max_scan_interval = 0.5;              //!< from scan to scan [s]
  bool freeze_map = true;  //!< scans that match too badly do not join the map, nor count as updates
};

/** Group `recovery`: the pose is lost, or the inertial data were interrupted. */
struct RecoveryParameters
{
  bool enabled = true;
  double patience = 1.0;    //!< scans that match nothing for so long after max_unaided_time [s]
  double match_time = 1.5;  //!< after a new start the old map is looked for so long [s]
  double max_heading = 1.5707963267948966;  //!< headings are tried up to here [rad]; 90 deg
  double min_share = 0.3;                //!< of the points match, when the old map is found again
  double accel_std = 1.0;                //!< of the motion while nothing was measured [m/s^2]
  double gyro_std = 0.3490658503988659;  //!< of the rotation meanwhile [rad/s]; 20 deg/s
};

/** How an odometry rawlog is built. */
enum class RawlogForm
{
  Observations,  //!< single observations in order of time
  Actions        //!< pairs of actions (motion) and sensory frames
};

/** Group `output`. Only imu_rate is used by Odometry itself, the others by who writes files. */
struct OutputParameters
{
  bool imu_rate = false;           //!< states between scans, at each inertial sample
  std::string exporters;           //!< names, separated by commas; empty: the standard ones
  double tile_size = 50.0;         //!< edge of the pieces that a map is kept in [m]
  double map_memory = 5.0;         //!< so many points of the map stay in memory [million]
  double keyframe_distance = 1.0;  //!< a key frame after so much travel [m]
  double keyframe_angle = 0.3490658503988659;  //!< or so much rotation [rad] (YAML: deg)
  RawlogForm rawlog_form = RawlogForm::Observations;
  bool rawlog_pass_through = true;  //!< also the input's observations
  bool rawlog_scan_2d = true;       //!< also a levelled planar scan
  int scan_2d_rays = 720;           //!< of the levelled planar scan
  double scan_2d_height = 0.0;      //!< of its plane above the LiDAR [m]
  double scan_2d_thickness = 0.2;   //!< of the slice that it is cut from [m]
};

/** Everything that configures an Odometry. */
struct Parameters
{
  InputParameters input;
  std::array<FurtherLidarParameters, kMostFurtherLidars> further_lidars;
  InitializationParameters initialization;
  ImuParameters imu;
  LidarParameters lidar;
  CalibrationParameters calibration;
  ReductionParameters reduction;
  FeatureParameters features;
  MeasurementParameters measurement;
  MapParameters map;
  IterationLimits update;
  RestParameters rest;
  HealthParameters health;
  RecoveryParameters recovery;
  OutputParameters output;
  GainForm gain = GainForm::Information;
  int threads = 0;  //!< worker threads; 0 = all cores
};

}  // namespace fastlio
