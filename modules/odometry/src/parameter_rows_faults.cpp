// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_rows.h"
#include <fastlio/math/angles.h>

namespace fastlio
{
ParameterRows imuFaultRows()
{
  return {
      {"imu.accel_unit", "",
       enumeration([](auto& p) { return &p.imu.accel_unit; }, {"auto", "m/s^2", "g", "mg"}),
       "unit of the specific force; auto: from the magnitude of the first 0.2 s"},
      {"imu.gyro_unit", "",
       enumeration([](auto& p) { return &p.imu.gyro_unit; }, {"auto", "rad/s", "deg/s"}),
       "unit of the angular rate; auto: rad/s until gravity turns in the sensor's frame as if it "
       "were deg/s, then the run starts anew"},
      {"imu.invert_acceleration", "",
       BooleanValue{[](auto& p) { return &p.imu.invert_acceleration; }},
       "true: the sensor gives the acceleration of gravity (downwards at rest) instead of the "
       "specific force; a sensor mounted upside down needs nothing"},
      {"imu.gyro_range", "deg/s",
       RealValue{[](auto& p) { return &p.imu.gyro_range; }, 0.0, 100000.0, kRadPerDeg},
       "full scale of the gyro, where it clips; 0: found, as the value that repeats at the "
       "extreme"},
      {"imu.accel_range", "m/s^2",
       RealValue{[](auto& p) { return &p.imu.accel_range; }, 0.0, 100000.0},
       "full scale of the accelerometer, where it clips; 0: found, as the value that repeats at "
       "the extreme"},
      {"imu.saturation_std", "",
       RealValue{[](auto& p) { return &p.imu.saturation_std; }, 0.0, 10.0},
       "uncertainty of a clipped sample, as a share of the full scale"},
      {"imu.gap_periods", "", RealValue{[](auto& p) { return &p.imu.gap_periods; }, 1.5, 1000.0},
       "so many sampling periods without a sample are a gap, which is bridged with more noise"},
      {"imu.gap_gyro_std", "deg/s",
       RealValue{[](auto& p) { return &p.imu.gap_gyro_std; }, 0.0, 10000.0, kRadPerDeg},
       "uncertainty of the angular rate in a gap of imu.max_gap; in proportion in shorter ones"},
      {"imu.gap_accel_std", "m/s^2",
       RealValue{[](auto& p) { return &p.imu.gap_accel_std; }, 0.0, 1000.0},
       "uncertainty of the specific force in a gap of imu.max_gap; in proportion in shorter ones"},
      {"imu.spike_gyro", "deg/s",
       RealValue{[](auto& p) { return &p.imu.spike_gyro; }, 1.0, 1e6, kRadPerDeg},
       "a lone sample whose angular rate differs more than this from both neighbours is left out"},
      {"imu.spike_accel", "m/s^2", RealValue{[](auto& p) { return &p.imu.spike_accel; }, 1.0, 1e6},
       "a lone sample whose specific force differs more than this from both neighbours is left "
       "out"},
  };
}

ParameterRows healthRows()
{
  return {
      {"health.min_share", "", RealValue{[](auto& p) { return &p.health.min_share; }, 0.0, 1.0},
       "a scan is in trouble when the share of its points that match the map is smaller than this "
       "part of the share that matched in the fifty scans before"},
      {"health.max_innovation", "",
       RealValue{[](auto& p) { return &p.health.max_innovation; }, 0.1, 1e6},
       "a scan is in trouble when the mean of the squared residuals over their variance is larger; "
       "about 1 when all is well"},
      {"health.min_information", "",
       RealValue{[](auto& p) { return &p.health.min_information; }, 0.0, 1e12},
       "a scan leaves a direction open when the smallest eigenvalue of its information is smaller; "
       "a direction that is found to be open (measurement.min_signal_to_noise) is no trouble by "
       "itself"},
      {"health.max_inflated", "",
       RealValue{[](auto& p) { return &p.health.max_inflated; }, 0.001, 1.0},
       "a scan is in trouble when the inertial data are in inflation (gap, clipping, spike) for a "
       "larger share of the time since the scan before"},
      {"health.max_gyro_bias", "deg/s",
       RealValue{[](auto& p) { return &p.health.max_gyro_bias; }, 0.001, 1000.0, kRadPerDeg},
       "a larger bias of the gyro is trouble"},
      {"health.max_accel_bias", "m/s^2",
       RealValue{[](auto& p) { return &p.health.max_accel_bias; }, 0.001, 1000.0},
       "a larger bias of the accelerometer is trouble"},
      {"health.max_scan_interval", "s",
       RealValue{[](auto& p) { return &p.health.max_scan_interval; }, 0.001, 1e6},
       "a longer time between two scans is trouble"},
      {"health.freeze_map", "", BooleanValue{[](auto& p) { return &p.health.freeze_map; }},
       "true: scans beyond min_share neither join the map nor count as updates, "
       "so that the pose is found to be lost after measurement.max_unaided_time"},
  };
}

ParameterRows recoveryRows()
{
  return {
      {"recovery.enabled", "", BooleanValue{[](auto& p) { return &p.recovery.enabled; }},
       "true: a run that has lost its pose, or its inertial data for longer than imu.max_gap, "
       "starts anew, at rest or in motion, with the pose carried over"},
      {"recovery.patience", "s", RealValue{[](auto& p) { return &p.recovery.patience; }, 0.0, 1e6},
       "a pose that is not trusted any more (measurement.max_unaided_time) is given up when the "
       "scans have seen enough points and matched none for so long"},
      {"recovery.match_time", "s",
       RealValue{[](auto& p) { return &p.recovery.match_time; }, 0.0, 1e6},
       "so long after a new start the scans are matched with the old map; then a new one is begun "
       "at the carried pose"},
      {"recovery.max_heading", "deg",
       RealValue{[](auto& p) { return &p.recovery.max_heading; }, 0.0, 180.0, kRadPerDeg},
       "the old map is looked for with headings up to so far from the carried one, as far as that "
       "is uncertain"},
      {"recovery.min_share", "", RealValue{[](auto& p) { return &p.recovery.min_share; }, 0.0, 1.0},
       "the old map is found again when so large a share of a scan's points match it"},
      {"recovery.accel_std", "m/s^2",
       RealValue{[](auto& p) { return &p.recovery.accel_std; }, 0.0, 1000.0},
       "how the platform may have accelerated while nothing was measured: makes the carried "
       "position uncertain"},
      {"recovery.gyro_std", "deg/s",
       RealValue{[](auto& p) { return &p.recovery.gyro_std; }, 0.0, 10000.0, kRadPerDeg},
       "how the platform may have turned while nothing was measured: makes the carried heading "
       "uncertain"},
  };
}

}  // namespace fastlio
