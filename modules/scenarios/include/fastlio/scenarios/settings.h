// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file settings.h Everything about a simulated recording that a user may change. */
#pragma once

#include <fastlio/filter/imu.h>
#include <fastlio/math/pose.h>

#include <cstdint>
#include <string>

namespace fastlio
{
/** Which sensor is simulated. */
enum class LidarKind
{
  Vlp16,  //!< Velodyne VLP-16: raw packets in the recording
  Os64,   //!< spinning, all lines of a column at once
  Livox,  //!< non-repetitive rosette
  Vlp32c  //!< Velodyne VLP-32C: most lines near the horizon, few on the ground
};

/** In which class a recording has the scans. */
enum class LidarCloud
{
  Native,   //!< what the sensor's driver records: raw packets (vlp16) or CPointsMapXYZIRT
  Xyzirt,   //!< CPointsMapXYZIRT: times of 32 bits
  Generic,  //!< CGenericPointsMap: times of 64 bits
  Xyzi      //!< CPointsMapXYZI: no times
};

/** Unit of the times of points in a cloud. */
enum class CloudTimeUnit
{
  Seconds,
  Milliseconds,
  Microseconds,
  Nanoseconds
};

/** The zero of the times of points, and the stamp of the scan. */
enum class CloudTimeReference
{
  Start,    //!< the first shot
  Middle,   //!< half a sweep later
  End,      //!< a sweep later
  Absolute  //!< times count from 1970; the stamp is that of the first shot
};

/** Errors of laser beams, of their returns and of packets; all off. Docs: simulation.md. */
struct BeamSettings
{
  double laser_range_std = 0.0;        //!< scatter of the range offset over laser lines [m]
  double laser_elevation_std = 0.0;    //!< scatter of the elevation offset over lines [rad]
  double laser_azimuth_std = 0.0;      //!< scatter of the azimuth offset over lines [rad]
  double incidence_bias = 0.0;         //!< of a range at 80 deg of incidence, 0 at 0 deg [m]
  double dark_bias = 0.0;              //!< of a range to a surface of reflectivity 0 [m]
  double bright_bias = 0.0;            //!< of a range to a surface of reflectivity 1 [m]
  double divergence_horizontal = 0.0;  //!< full width of the beam [rad]
  double divergence_vertical = 0.0;    //!< full width of the beam [rad]
  double false_returns = 0.0;          //!< fraction of shots that dust or rain sends back
  double packet_loss = 0.0;            //!< fraction of packets that are lost, one by one
  double outage_interval = 0.0;        //!< one outage per so much time; 0: none [s]
  double outage_length = 0.05;         //!< packets of this time are lost then [s]
};

/** Errors that the recording does not contain: config.yaml and sensorPose do not know of them. */
struct HiddenErrors
{
  double clock_error = 0.0;   //!< added to the LiDAR's stamps beside time_offset [s]
  double rotation_std = 0.0;  //!< of the mounting, per axis [rad]
  double position_std = 0.0;  //!< of the mounting, per axis [m]
  double clock_drift = 0.0;   //!< what clock_error grows by in each second
};

/** The LiDAR. */
struct LidarSettings
{
  LidarKind kind = LidarKind::Vlp16;
  double rate = 10.0;           //!< sweeps per second [Hz]
  int lines = 64;               //!< os64: laser lines
  int columns = 1024;           //!< os64: columns per revolution
  double vertical_fov = 0.785;  //!< os64: angle between the outermost lines [rad]
  double elevation = 0.0;       //!< os64: in the middle between the outermost lines [rad]
  double point_rate = 240e3;    //!< livox: shots per second [Hz]
  int stride = 1;               //!< only every so many-th column (firing) is fired
  double min_range = 1.0;       //!< nearer surfaces give no return [m]
  double max_range = 100.0;     //!< farther surfaces give no return [m]
  double range_noise = 0.02;    //!< standard deviation of a range [m]
  double dropout = 0.01;        //!< fraction of returns that are lost
  double time_offset = 0.0;     //!< added to the true stamps (LiDAR clock minus IMU clock) [s]
  Pose T_imu_lidar;             //!< mounting, as the recording says
  LidarCloud cloud = LidarCloud::Native;
  CloudTimeUnit time_unit = CloudTimeUnit::Seconds;
  CloudTimeReference time_reference = CloudTimeReference::Start;
  BeamSettings beam;
  HiddenErrors hidden;
};

/** Errors of the inertial sensor that stay as they are during a recording; all off. */
struct ImuErrorSettings
{
  double gyro_scale_std = 0.0;          //!< of each axis' scale
  double accel_scale_std = 0.0;         //!< of each axis' scale
  double gyro_misalignment_std = 0.0;   //!< of each axis towards each other one [rad]
  double accel_misalignment_std = 0.0;  //!< of each axis towards each other one [rad]
  double g_sensitivity_std = 0.0;       //!< each entry [rad/s per m/s^2]
  int bits = 0;  //!< resolution: the range -limit..limit in so many bits; 0: exact
};

/** The inertial sensor. */
struct ImuSettings
{
  double rate = 200.0;                     //!< [Hz]
  ImuNoise noise{2e-4, 2e-3, 2e-5, 2e-4};  //!< continuous-time densities
  Vec3 gyro_bias = Vec3::Zero();           //!< mean of the initial bias [rad/s]
  Vec3 accel_bias = Vec3::Zero();          //!< mean of the initial bias [m/s^2]
  double gyro_bias_std = 3e-3;             //!< its scatter over seeds [rad/s]
  double accel_bias_std = 0.03;            //!< its scatter over seeds [m/s^2]
  double stamp_jitter = 0.0;               //!< standard deviation of the stamps' error [s]
  double gyro_limit = 34.9;                //!< saturation [rad/s]
  double accel_limit = 157.0;              //!< saturation [m/s^2]
  double dropout = 0.0;                    //!< fraction of samples that are lost, one by one
  double gap_interval = 0.0;               //!< a gap every so often after the rest; 0: none [s]
  double gap_length = 0.05;                //!< length of such a gap [s]
  double vibration_gyro = 0.0;             //!< amplitude [rad/s]
  double vibration_accel = 0.0;            //!< amplitude [m/s^2]
  double vibration_frequency = 83.0;       //!< of the fundamental [Hz]
  bool average = false;  //!< samples are means over the period that they end; else instantaneous
  ImuErrorSettings errors;
};

/** The carrier of the sensors and objects close to them; all off. */
struct CarrierSettings
{
  double vibration_accel = 0.0;  //!< 20 to 200 Hz, root mean square per axis [m/s^2]
  double vibration_gyro = 0.0;   //!< 20 to 200 Hz, root mean square per axis [rad/s]
  bool body = false;             //!< a person stands behind the sensors and moves with them
  int crowd = 0;                 //!< people at arm's length, who walk along
};

/** Surfaces that are not matt; off. */
struct SurfaceSettings
{
  double glass = 0.0;    //!< fraction of flat, upright surfaces that light passes
  double mirrors = 0.0;  //!< fraction of flat, upright surfaces that reflect like a mirror
};

/** A receiver of satellite navigation; off. The world's x axis points east, y north, z up, and its
 * origin is the datum. */
struct GnssSettings
{
  double rate = 0.0;               //!< fixes per second; 0: no receiver [Hz]
  double noise = 1.0;              //!< standard deviation east and north, twice that up [m]
  double correlation_time = 30.0;  //!< of half of the variance; 0: all of it is white [s]
  double outage_interval = 0.0;    //!< one outage per so much time; 0: none [s]
  double outage_length = 20.0;     //!< no position is known for so long then [s]
  double multipath = 0.0;          //!< fraction of fixes that are 5 to 30 m off
  Vec3 lever_arm = Vec3::Zero();   //!< antenna in the IMU frame [m]
  double latitude = 48.1;          //!< of the datum [deg]
  double longitude = 11.6;         //!< of the datum [deg]
  double height = 560.0;           //!< of the datum above the ellipsoid WGS84 [m]
  double geoid = 46.0;             //!< height of the geoid above the ellipsoid [m]
};

/** Encoders of two driven wheels, 1 m apart; off. */
struct WheelSettings
{
  double rate = 0.0;         //!< readings per second; 0: no wheels [Hz]
  double scale_error = 0.0;  //!< distances are measured too long by this fraction
  double noise = 0.01;       //!< of each wheel's distance, standard deviation after 1 m [m/sqrt(m)]
};

/** Objects in the world; for scenarios that have them. */
struct WorldSettings
{
  double length = 1200.0;  //!< town: length of the ride [m]; the town grows with it
  int session = 0;         //!< another day: things that can be moved stand elsewhere; 0: the first
  double changes = 0.3;    //!< fraction of such things that another day changes
};

/** A simulated recording. Defaults per scenario: defaultSettings(). */
struct SimulationSettings
{
  std::string scenario = "office";
  double duration = 0.0;   //!< [s]; 0: as long as the scenario's path takes
  std::uint64_t seed = 1;  //!< of noise, errors and vibration; world and path do not depend on it
  std::int64_t start_ns = 1'700'000'000'000'000'000;  //!< stamp of the first IMU sample [ns]
  double gravity = 9.81;                              //!< [m/s^2]
  double rest = 2.5;                                  //!< time at rest at the start [s]
  double speed = 1.0;                                 //!< factor on the motion's speed
  double path_start = 0.0;  //!< where on the scenario's path to start: time of its motion [s]
  WorldSettings world;
  LidarSettings lidar;
  ImuSettings imu;
  CarrierSettings carrier;
  SurfaceSettings surface;
  GnssSettings gnss;
  WheelSettings wheels;
};

}  // namespace fastlio
